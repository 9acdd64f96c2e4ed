// SPDX-License-Identifier: GPL-3.0-or-later
import * as Plot from "@observablehq/plot";

/** A histogram; bars are stacked by region where there are several. {bins: [[from, to, count, region]...], unit, regions, log} */
export function bars(h) {
  return Plot.plot({
    width: 460,
    height: 260,
    marginLeft: 60,
    x: { label: h.unit, type: h.log ? "log" : "linear", tickFormat: h.log ? "~g" : undefined },
    y: { label: "tetrahedra" + (h.of ? ` (${h.of})` : ""), tickFormat: "~s", grid: true },
    color: { legend: h.regions.length > 1, domain: h.regions },
    marks: [
      Plot.rectY(h.bins, { x1: "0", x2: "1", y: "2", fill: "3", insetLeft: 0.5, title: (b) => `${b[0]} to ${b[1]}: ${b[2]} (${b[3]})` }),
      h.bound === undefined ? null : Plot.ruleX([h.bound], { stroke: "#c00", strokeDasharray: "4 3" }),
      Plot.ruleY([0]),
    ],
  });
}

/** [[seconds, vertices, phase]...] */
export function speed(samples) {
  return Plot.plot({
    width: 940,
    height: 220,
    marginLeft: 60,
    x: { label: "seconds" },
    y: { label: "vertices", tickFormat: "~s", grid: true },
    color: { legend: true },
    marks: [Plot.lineY(samples, { x: "0", y: "1", stroke: "2", strokeWidth: 2 }), Plot.ruleY([0])],
  });
}

/** [[thread, from, to, kind]...] in seconds */
export function timeline(tasks) {
  const threads = new Set(tasks.map((t) => t[0]));
  return Plot.plot({
    width: 940,
    height: 60 + 24 * threads.size,
    marginLeft: 60,
    x: { label: "seconds" },
    y: { label: "thread", type: "band" },
    color: { legend: true },
    marks: [Plot.barX(tasks, { x1: "1", x2: "2", y: "0", fill: "3", title: (t) => `${t[3]}: ${(1e3 * (t[2] - t[1])).toFixed(2)} ms` })],
  });
}
