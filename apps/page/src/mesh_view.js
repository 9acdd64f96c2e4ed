// SPDX-License-Identifier: GPL-3.0-or-later
// The mesh in three dimensions, cut open by a plane: tetrahedra on the viewer's side of it are left out, the others coloured by their smallest
// dihedral angle. Only faces without a neighbor that is drawn are made, anew for each place of the plane.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

/** Typed arrays travel as base64. */
function decode(text, Type) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  return new Type(bytes.buffer);
}

/** From red (0 degrees) over yellow and green to blue (70). */
function color_of(degrees) {
  return new THREE.Color().setHSL(0.62 * Math.min(1, degrees / 60), 0.75, 0.5);
}

// Observable Plot's colours, so that regions look the same in the histograms.
const REGIONS = ["#4269d0", "#efb118", "#ff725c", "#6cc5b0", "#3ca951", "#ff8ab7", "#a463f2", "#97bbf5", "#9c6b4e"];

// From where the mesh is seen at first, and on which side of a plane across x, y or z what is behind it lies from there.
const SEEN_FROM = new THREE.Vector3(-1.0, -1.7, 0.95).normalize();
const BEHIND = [1, 1, -1];

const FACES = [[1, 3, 2], [0, 2, 3], [0, 3, 1], [0, 1, 2]];

export class MeshView {
  /** `start`: what `cut` ("x:0.3") and `colour` ("region") are at first; `is_picture`: fills the window. */
  constructor(holder, mesh, status, start, is_picture) {
    this.points = decode(mesh.points, Float32Array);
    this.tetrahedra = decode(mesh.tetrahedra, Uint32Array);
    this.angles = decode(mesh.angles, Uint8Array);
    this.regions = decode(mesh.regions, Uint8Array);
    this.status = status;
    this.note = mesh.note;
    this.count = this.tetrahedra.length / 4;
    this.by_angle = Array.from({ length: 256 }, (_, i) => color_of(i / 2));
    this.by_region = Array.from({ length: 256 }, (_, i) => new THREE.Color(REGIONS[i % REGIONS.length]));
    this.find_neighbors();
    this.find_centers();

    this.renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    this.scene = new THREE.Scene();
    this.scene.background = new THREE.Color(0xf4f5f7);
    this.camera = new THREE.PerspectiveCamera(35, 1, 0.01, 100);
    this.camera.up.set(0, 0, 1);
    this.scene.add(this.camera, new THREE.AmbientLight(0xffffff, 1.2));
    const lamp = new THREE.DirectionalLight(0xffffff, 2.2);
    lamp.position.set(0.4, 0.6, 1);
    this.camera.add(lamp);
    this.surface = new THREE.Mesh(new THREE.BufferGeometry(), new THREE.MeshLambertMaterial({ vertexColors: true, flatShading: true, side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }));
    this.lines = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: 0x202428, transparent: true, opacity: 0.35 }));
    this.marked = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({ color: 0xd0006f, depthTest: false }));
    this.scene.add(this.surface, this.lines, this.marked);

    holder.append(this.renderer.domElement);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.addEventListener("change", () => this.draw());
    this.is_moved = false;
    this.controls.addEventListener("start", () => { this.is_moved = true; });
    this.add_panel(holder);
    this.set_panel(start);
    const fit = () => {
      const width = holder.clientWidth, height = is_picture ? holder.clientHeight : Math.min(560, 0.62 * width);
      this.renderer.setPixelRatio(window.devicePixelRatio);
      this.renderer.setSize(width, height);
      this.camera.aspect = width / height;
      this.camera.updateProjectionMatrix();
      if (!this.is_moved) this.frame();
      this.draw();
    };
    new ResizeObserver(fit).observe(holder);
    this.cut();
    fit();
  }

  add_panel(holder) {
    const panel = document.createElement("div");
    panel.className = "panel";
    panel.innerHTML = `<label>cut <select><option value="0">x</option><option value="1" selected>y</option><option value="2">z</option></select></label>
      <label class="wide"><input type="range" min="0" max="1" step="0.005" value="0.5"></label>
      <label>colour <select><option value="angle">angle</option><option value="region">region</option></select></label>
      <label>angles below <input type="number" min="0" max="71" step="1" value="71"></label>
      <label><input type="checkbox" checked> edges</label><span class="scale"><i>0°</i><b></b><i>60°</i></span>`;
    holder.append(panel);
    [this.axis, this.color] = panel.getElementsByTagName("select");
    [this.place, this.most, this.edges] = panel.getElementsByTagName("input");
    for (const input of [this.axis, this.color, this.place, this.most]) input.addEventListener("input", () => this.cut());
    this.edges.addEventListener("input", () => {
      this.lines.visible = this.edges.checked;
      this.draw();
    });
  }

  set_panel(start) {
    const [axis, place] = (start.get("cut") ?? "").split(":");
    if ("xyz".includes(axis) && axis) this.axis.value = "xyz".indexOf(axis);
    if (place) this.place.value = place;
    if (start.get("colour") === "region") this.color.value = "region";
  }

  /** Puts the camera where what is drawn just fits into the picture. */
  frame() {
    this.surface.geometry.computeBoundingBox();
    const box = this.surface.geometry.boundingBox;
    if (box.isEmpty()) return;
    const center = box.getCenter(new THREE.Vector3());
    const right = new THREE.Vector3().crossVectors(this.camera.up, SEEN_FROM).normalize();
    const above = new THREE.Vector3().crossVectors(SEEN_FROM, right);
    const steep = 0.94 * Math.tan((this.camera.fov / 360) * Math.PI);  // a margin
    let distance = 0;
    for (let corner = 0; corner < 8; ++corner) {
      const p = new THREE.Vector3(...[0, 1, 2].map((d) => (corner & (1 << d) ? box.max : box.min).getComponent(d))).sub(center);
      const need = Math.max(Math.abs(p.dot(right)) / this.camera.aspect, Math.abs(p.dot(above))) / steep;
      distance = Math.max(distance, p.dot(SEEN_FROM) + need);
    }
    this.controls.target.copy(center);
    this.camera.position.copy(center).addScaledVector(SEEN_FROM, distance);
    this.controls.update();
  }

  /** neighbors[4 t + k] is the tetrahedron behind the face opposite to corner k, or -1. By a hash table with open addressing, of faces that wait
   * for their other side. */
  find_neighbors() {
    const faces = 4 * this.count;
    this.neighbors = new Int32Array(faces).fill(-1);
    const bits = Math.max(4, Math.ceil(Math.log2(faces)) + 1), mask = 2 ** bits - 1;
    const table = new Int32Array(2 ** bits).fill(-1);
    const sorted = new Uint32Array(3 * faces);
    for (let f = 0; f < faces; ++f) {
      const first = f & ~3;
      let [a, b, c] = FACES[f & 3];
      a = this.tetrahedra[first + a];
      b = this.tetrahedra[first + b];
      c = this.tetrahedra[first + c];
      if (a > b) [a, b] = [b, a];
      if (b > c) [b, c] = [c, b];
      if (a > b) [a, b] = [b, a];
      sorted.set([a, b, c], 3 * f);
      let slot = (Math.imul(a, 73856093) ^ Math.imul(b, 19349663) ^ Math.imul(c, 83492791)) & mask;
      for (; table[slot] >= 0; slot = (slot + 1) & mask) {
        const o = table[slot];
        if (sorted[3 * o] !== a || sorted[3 * o + 1] !== b || sorted[3 * o + 2] !== c) continue;
        this.neighbors[f] = o >> 2;
        this.neighbors[o] = f >> 2;
        break;
      }
      if (this.neighbors[f] < 0) table[slot] = f;
    }
  }

  find_centers() {
    this.centers = new Float32Array(3 * this.count);
    this.lower = [1e30, 1e30, 1e30];
    this.upper = [-1e30, -1e30, -1e30];
    for (let t = 0; t < this.count; ++t)
      for (let d = 0; d < 3; ++d) {
        let sum = 0;
        for (let k = 0; k < 4; ++k) {
          const x = this.points[3 * this.tetrahedra[4 * t + k] + d];
          sum += x;
          this.lower[d] = Math.min(this.lower[d], x);
          this.upper[d] = Math.max(this.upper[d], x);
        }
        this.centers[3 * t + d] = sum / 4;
      }
  }

  cut() {
    const axis = Number(this.axis.value), most = Number(this.most.value) * 2;
    const removed = BEHIND[axis] > 0 ? Number(this.place.value) : 1 - Number(this.place.value);
    const plane = this.lower[axis] + removed * (this.upper[axis] - this.lower[axis]);
    const is_by_region = this.color.value === "region";
    const is_drawn = (t) => BEHIND[axis] * (this.centers[3 * t + axis] - plane) >= 0 && this.angles[t] <= most;
    const corners = [], colors = [], lines = [];
    let drawn = 0;
    for (let t = 0; t < this.count; ++t) {
      if (!is_drawn(t)) continue;
      ++drawn;
      const c = is_by_region ? this.by_region[this.regions[t]] : this.by_angle[this.angles[t]];
      for (let k = 0; k < 4; ++k) {
        const n = this.neighbors[4 * t + k];
        if (n >= 0 && is_drawn(n)) continue;
        const face = FACES[k].map((i) => 3 * this.tetrahedra[4 * t + i]);
        for (const v of face) {
          corners.push(this.points[v], this.points[v + 1], this.points[v + 2]);
          colors.push(c.r, c.g, c.b);
        }
        for (let i = 0; i < 3; ++i)
          for (const v of [face[i], face[(i + 1) % 3]]) lines.push(this.points[v], this.points[v + 1], this.points[v + 2]);
      }
    }
    const attribute = (values) => new THREE.BufferAttribute(new Float32Array(values), 3);
    const replace = (object, attributes) => {
      object.geometry.dispose();
      object.geometry = new THREE.BufferGeometry();
      for (const [name, values] of Object.entries(attributes)) object.geometry.setAttribute(name, attribute(values));
    };
    replace(this.surface, { position: corners, color: colors });
    replace(this.lines, { position: lines });
    this.lines.material.opacity = Math.min(0.4, 4e3 / (corners.length / 9 + 1));  // many of them would cover what is between
    this.status.textContent = `${drawn.toLocaleString("en")} of ${this.count.toLocaleString("en")} tetrahedra are drawn, coloured by their ${is_by_region ? "region" : "smallest dihedral angle"}. ${this.note}`;
    this.draw();
  }

  /** Frames one tetrahedron. */
  show(t) {
    const p = t.corners;
    const lines = [];
    for (let i = 0; i < 4; ++i) for (let j = 0; j < i; ++j) lines.push(...p[i], ...p[j]);
    this.marked.geometry.dispose();
    this.marked.geometry = new THREE.BufferGeometry();
    this.marked.geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(lines), 3));
    const center = new THREE.Vector3();
    for (const q of p) center.add(new THREE.Vector3(...q));
    center.divideScalar(4);
    let radius = 1e-6;
    for (const q of p) radius = Math.max(radius, center.distanceTo(new THREE.Vector3(...q)));
    const direction = this.camera.position.clone().sub(this.controls.target).normalize();
    this.is_moved = true;
    this.controls.target.copy(center);
    this.camera.near = radius / 100;
    this.camera.position.copy(center).addScaledVector(direction, 12 * radius);
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.draw();
  }

  draw() {
    this.renderer.render(this.scene, this.camera);
  }

  test() {
    const opened = performance.now();
    const counts = [];
    for (const place of [0, 0.5, 0.9]) {
      this.place.value = place;
      this.cut();
      counts.push(this.surface.geometry.getAttribute("position").count / 3);
    }
    this.place.value = 0.5;
    this.cut();
    const gl = this.renderer.getContext();
    const pixels = new Uint8Array(4 * gl.drawingBufferWidth * gl.drawingBufferHeight);
    gl.readPixels(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    const background = pixels.slice(0, 3).join();
    let others = 0;
    for (let i = 0; i < pixels.length; i += 4) others += pixels.slice(i, i + 3).join() !== background;
    document.body.setAttribute("data-test", JSON.stringify({ triangles: counts, drawn: others / (pixels.length / 4), opened }));
  }
}
