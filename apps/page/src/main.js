// SPDX-License-Identifier: GPL-3.0-or-later
// The page of `pgdr mesh --report` and `pgdr view`: what the program says of a mesh (JSON in the element #data), for people.
import { bars, speed, timeline } from "./charts.js";
import { MeshView } from "./mesh_view.js";

const data = JSON.parse(document.getElementById("data").textContent);

function element(tag, text, attributes = {}) {
  const e = document.createElement(tag);
  if (text !== undefined) e.textContent = text;
  for (const [name, value] of Object.entries(attributes)) e.setAttribute(name, value);
  return e;
}

function section(title, ...children) {
  const s = element("section");
  s.append(element("h2", title), ...children.filter(Boolean));
  document.body.append(s);
  return s;
}

/** Two columns: what, and how much. */
function table(rows) {
  const t = element("table");
  for (const [name, value] of rows) {
    const row = element("tr");
    row.append(element("th", name), element("td", value));
    t.append(row);
  }
  return t;
}

function figure(node, caption) {
  const f = element("figure");
  f.append(node, element("figcaption", caption));
  return f;
}

document.title = data.title;
document.body.append(element("h1", data.title));
document.body.append(element("p", data.subtitle, { class: "subtitle" }));

const holder = element("div", undefined, { class: "view" });
// For pictures, #picture: the mesh alone.
const start = new URLSearchParams(location.hash.slice(1));
const is_picture = start.has("picture");
if (is_picture) document.body.classList.add("picture");
const status = element("p", "", { id: "status" });
section("The mesh", holder, status);
let view = null;
try {
  view = new MeshView(holder, data.mesh, status, start, is_picture);
} catch (error) {
  holder.remove();
  status.textContent = `No picture: ${error.message}`;
}

if (data.input) section("What went in", table(data.input));
section("What came out", table(data.output));

const charts = element("div", undefined, { class: "charts" });
for (const h of data.histograms) charts.append(figure(bars(h), h.title));
section("Quality", charts);

if (data.worst.length > 0) {
  const worst = element("table", undefined, { class: "worst" });
  const head = element("tr");
  for (const title of ["tetrahedron", "smallest dihedral angle", "radius-edge ratio", "region", "at", ""]) head.append(element("th", title));
  worst.append(head);
  for (const t of data.worst) {
    const row = element("tr");
    for (const value of [t.number, `${t.dihedral}°`, t.ratio, t.region, t.at.map((x) => Number(x.toPrecision(5))).join(", ")]) row.append(element("td", value));
    const cell = element("td");
    if (view) {
      const button = element("button", "show");
      button.addEventListener("click", () => {
        view.show(t);
        holder.scrollIntoView({ behavior: "smooth" });
      });
      cell.append(button);
    }
    row.append(cell);
    worst.append(row);
  }
  section("The worst tetrahedra", worst);
}

if (data.phases && data.phases.length > 0)
  section(
    "Time",
    table(data.phases),
    data.progress.length > 2 && figure(speed(data.progress), "vertices over seconds"),
    data.tasks.length > 0 && figure(timeline(data.tasks), data.tasks_caption),
  );
document.body.append(element("footer", data.footer));

// For tests: a page opened with #test moves its plane by itself, and says in its status what it drew.
if (view && start.has("test")) view.test();
