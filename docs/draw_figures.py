#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the figures of docs/theory.md from meshes that pgdr makes, as SVG.

usage: docs/draw_figures.py [--pgdr PROGRAM] [--output FOLDER]

Needs nothing but Python and the program; the pictures are the same every time, for the meshes are.
"""
import argparse
import itertools
import json
import math
import pathlib
import random
import re
import subprocess
import tempfile

here = pathlib.Path(__file__).resolve().parent
INK, LEAF, CAVITY, ZONE, ZONE_2, CAVITY_2 = "#8a8f98", "#1f4e9c", "#d9622b", "#f6cfa8", "#bcd8ee", "#2b83ba"


class Mesh:
    """Points (x, y, z), tetrahedra as index quadruples, and their circumballs."""

    def __init__(self, points, tetrahedra):
        self.points, self.tetrahedra = points, tetrahedra
        self.around = {}
        for t, corners in enumerate(tetrahedra):
            for v in corners:
                self.around.setdefault(v, []).append(t)

    @staticmethod
    def read(path):
        """A .mesh file."""
        words = path.read_text().split()
        i = words.index("Vertices")
        n = int(words[i + 1])
        rows = words[i + 2 : i + 2 + 4 * n]
        points = [tuple(map(float, rows[4 * k : 4 * k + 3])) for k in range(n)]
        i = words.index("Tetrahedra")
        n = int(words[i + 1])
        rows = words[i + 2 : i + 2 + 5 * n]
        return Mesh(points, [tuple(int(x) - 1 for x in rows[5 * k : 5 * k + 4]) for k in range(n)])

    def cavity(self, p, near):
        """Of the tetrahedra `near`, those whose circumball contains p."""
        balls = ((t, circumball([self.points[v] for v in self.tetrahedra[t]])) for t in near)
        return [t for t, ball in balls if ball and is_inside(ball, p)]

    def zone(self, cavity):
        return sorted({t for c in cavity for v in self.tetrahedra[c] for t in self.around[v]})

    def section(self, t, z):
        """The polygon in which a tetrahedron meets the plane at height z."""
        corners = [self.points[v] for v in self.tetrahedra[t]]
        cut = []
        for a, b in itertools.combinations(corners, 2):
            if (a[2] > z) != (b[2] > z):
                s = (z - a[2]) / (b[2] - a[2])
                cut.append((a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])))
        if len(cut) < 3:
            return []
        middle = [sum(x[k] for x in cut) / len(cut) for k in (0, 1)]
        return sorted(cut, key=lambda x: math.atan2(x[1] - middle[1], x[0] - middle[0]))


def circumball(corners):
    """Center and squared radius; None for a flat tetrahedron."""
    (a, b, c), d = ([x - y for x, y in zip(p, corners[3])] for p in corners[:3]), corners[3]
    bc, ca, ab = cross(b, c), cross(c, a), cross(a, b)
    volume = dot(a, bc)
    if volume == 0:
        return None
    o = [(dot(a, a) * x + dot(b, b) * y + dot(c, c) * z) / (2 * volume) for x, y, z in zip(bc, ca, ab)]
    return [x + y for x, y in zip(o, d)], dot(o, o)


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def is_inside(ball, p):
    d = [x - y for x, y in zip(p, ball[0])]
    return dot(d, d) < ball[1] * (1 - 1e-9)


class Picture:
    """What lies in a window, y upwards, as wide as `width` pixels."""

    def __init__(self, lower, upper, width=760):
        self.lower, self.scale = lower, width / (upper[0] - lower[0])
        self.size = (width, round((upper[1] - lower[1]) * self.scale))
        self.lines = []

    def at(self, p):
        return (p[0] - self.lower[0]) * self.scale, self.size[1] - (p[1] - self.lower[1]) * self.scale

    def polygons(self, polygons, **style):
        parts = []
        for polygon in polygons:
            where = [self.at(p) for p in polygon]
            if not where or not any(-50 < x < self.size[0] + 50 and -50 < y < self.size[1] + 50 for x, y in where):
                continue
            parts.append("M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in where) + "z")
        self.lines.append(f'<path d="{"".join(parts)}"{attributes(style)}/>')

    def box(self, lower, upper, by=0.0, **style):
        a, b = self.at((lower[0] - by, upper[1] + by)), self.at((upper[0] + by, lower[1] - by))
        self.lines.append(f'<rect x="{a[0]:.1f}" y="{a[1]:.1f}" width="{b[0] - a[0]:.1f}" height="{b[1] - a[1]:.1f}"'
                          f'{attributes({"fill": "none", **style})}/>')

    def dot(self, p, color="black"):
        x, y = self.at(p)
        self.lines.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="{color}"/>')

    def text(self, p, words, anchor="start", color="black"):
        x, y = self.at(p)
        self.lines.append(f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{color}" font-size="15" '
                          f'font-family="sans-serif">{words}</text>')

    def write(self, path):
        w, h = self.size
        path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {w} {h}" width="{w}" height="{h}">\n'
                        f'<rect width="{w}" height="{h}" fill="white"/>\n' + "\n".join(self.lines) + "\n</svg>\n")


def attributes(style):
    return "".join(f' {k.replace("_", "-")}="{v}"' for k, v in style.items())


def octree_leaves(trace):
    """(level, x, y, z) of the leaves at the end, from the nodes that had tasks."""
    split = {(0, 0, 0, 0)}
    for event in trace["traceEvents"]:
        if event["cat"] == "leaf":
            a = event["args"]
            level, at = a["level"], (a["x"], a["y"], a["z"])
            split |= {(level - k, *(x >> k for x in at)) for k in range(1, level + 1)}
    children = {(n[0] + 1, *(2 * x + b for x, b in zip(n[1:], bits))) for n in split
                for bits in itertools.product((0, 1), repeat=3)}
    return sorted(children - split)


def around_the_body(program, folder):
    """A mesh around the winged body, with its trace."""
    subprocess.run([program, "mesh", here.parent / "data" / "winged_body_in_box.poly", "--size", "0.9", "--refine-box",
                    "-19.89,-5.65,-5.61,6.50,8.05,5.61:0.8", "--quiet", "--trace", folder / "trace.json", "-o",
                    folder / "out.mesh"], check=True)
    return Mesh.read(folder / "out.mesh"), json.loads((folder / "trace.json").read_text())


def leaf_boxes(trace):
    root, edge = trace["otherData"]["root_lower"], trace["otherData"]["root_edge"]
    for level, *at in octree_leaves(trace):
        h = edge / 2**level
        lower = [r + h * x for r, x in zip(root, at)]
        yield level, lower, [x + h for x in lower]


def draw_octree(mesh, trace, path):
    """A section of the mesh, and the leaves that it meets."""
    z = 0.6
    picture = Picture((-25.5, -15.5), (25.5, 15.5))
    picture.polygons((mesh.section(t, z) for t in range(len(mesh.tetrahedra))), fill="#fbfbf8", stroke=INK,
                     stroke_width=0.4)
    for _, lower, upper in leaf_boxes(trace):
        if lower[2] <= z < upper[2]:
            picture.box(lower, upper, stroke=LEAF, stroke_width=1.8)
    picture.write(path)


def draw_zones(mesh, trace, path):
    """Cavities and zones of points in two leaves that do not touch."""
    boxes = [(lower, upper) for level, lower, upper in leaf_boxes(trace) if level == 3]
    z = 3.0
    row = [b for b in boxes if b[0][2] <= z < b[1][2]]
    one = next(b for b in row if b[0][0] == -17 and b[0][1] == -7)
    two = next(b for b in row if b[0][0] == -1 and b[0][1] == -7)
    edge = one[1][0] - one[0][0]
    picture = Picture((one[0][0] - edge / 2, one[0][1] - edge / 2), (two[1][0] + edge / 2, two[1][1] + edge / 2))
    picture.polygons((mesh.section(t, z) for t in range(len(mesh.tetrahedra))), fill="none", stroke=INK,
                     stroke_width=0.5)
    random.seed(3)
    for (lower, upper), zone_color, cavity_color in ((one, ZONE, CAVITY), (two, ZONE_2, CAVITY_2)):
        def near(p):
            """Circumradii are 0.9 at most."""
            return [t for t, c in enumerate(mesh.tetrahedra) if math.dist(mesh.points[c[0]], p) < 1.81]

        # On the faces, where cavities reach farthest out, and one inside.
        points = [(lower[0] + 0.01, random.uniform(lower[1], upper[1])), (upper[0] - 0.01, random.uniform(lower[1], upper[1])),
                  (random.uniform(lower[0], upper[0]), upper[1] - 0.01), (random.uniform(lower[0], upper[0]), lower[1] + 0.01),
                  (random.uniform(lower[0], upper[0]), (lower[1] + upper[1]) / 2)]
        cavities = [mesh.cavity((*p, z), near((*p, z))) for p in points]
        zones = sorted({t for c in cavities for t in mesh.zone(c)})
        picture.polygons((mesh.section(t, z) for t in zones), fill=zone_color, stroke=INK, stroke_width=0.5)
        picture.polygons((mesh.section(t, z) for c in cavities for t in c), fill=cavity_color, stroke="white",
                         stroke_width=0.5)
        for p in points:
            picture.dot(p)
        picture.box(lower, upper, stroke=LEAF, stroke_width=2.4)
        picture.box(lower, upper, edge / 4, stroke=LEAF, stroke_width=1.2, stroke_dasharray="2 3")
        picture.box(lower, upper, edge / 2, stroke=LEAF, stroke_width=1.2, stroke_dasharray="8 4")
    picture.write(path)


def draw_buffer_counterexample(path):
    """The mesh of test/independence/buffer_counterexamples.cpp in which zones overlap."""
    source = (here.parent / "test/independence/buffer_counterexamples.cpp").read_text()
    source = source[source.index("may overlap") :]
    number = r"(-?[\d.]+)"
    triple = number + r",\s*" + number + r",\s*" + number
    p, q = (tuple(map(float, re.search(rf"\b{name}\({triple}\)", source).groups())) for name in "pq")
    points = [tuple(map(float, row)) for row in re.findall(r"\{" + triple + r"\}", source)]
    cells = []
    for corners in itertools.combinations(range(len(points)), 4):
        ball = circumball([points[v] for v in corners])
        if ball and not any(is_inside(ball, x) for x in points):
            cells.append(corners)
    mesh = Mesh(points, cells)
    z = 0.5
    picture = Picture((7, -0.1), (11.4, 3.1))
    everything = range(len(cells))
    a, b = (mesh.cavity(x, everything) for x in (p, q))
    zone_a, zone_b = mesh.zone(a), mesh.zone(b)
    picture.polygons((mesh.section(t, z) for t in everything), fill="#fbfbf8", stroke=INK, stroke_width=0.6)
    for cells_of, color in ((zone_a, ZONE), (zone_b, ZONE_2), (sorted(set(zone_a) & set(zone_b)), "#9b59b6"), (a, CAVITY),
                            (b, CAVITY_2)):
        picture.polygons((mesh.section(t, z) for t in cells_of), fill=color, stroke=INK, stroke_width=0.6)
    for y in range(3):
        picture.box((7, y), (8, (y + 1)), stroke=LEAF, stroke_width=2)
    picture.box((8, -1), (16, 7), stroke=LEAF, stroke_width=2)
    picture.dot(p)
    picture.dot(q)
    picture.text((7.08, 0.06), "L", color=LEAF)
    picture.text((7.08, 2.06), "M", color=LEAF)
    picture.write(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--pgdr", default=here.parent / "build" / "release" / "pgdr")
    parser.add_argument("--output", type=pathlib.Path, default=here / "figures")
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        mesh, trace = around_the_body(options.pgdr, pathlib.Path(folder))
    draw_octree(mesh, trace, options.output / "octree.svg")
    draw_zones(mesh, trace, options.output / "zones.svg")
    draw_buffer_counterexample(options.output / "buffer_condition.svg")


main()
