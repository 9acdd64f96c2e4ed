#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes random CAD parts with OpenSCAD, for `bench/models.py`.

Part k is `FOLDER/KIND_kkkk.stl`, a function of k alone (and of OpenSCAD's version): brackets with bores and pockets, cones and spheres united, cut or intersected, gears,
cases with rounded corners, threads. OpenSCAD computes exactly and writes six digits: vertices lie on edges but for rounding, so that there are needles down to no area at
all, and now and then facets that intersect. Parts that take OpenSCAD longer than 25 seconds are left out.

usage: bench/openscad_parts.py FOLDER [--first N] [--count N] [--openscad PROGRAM]
Needs: OpenSCAD (Debian: `openscad`).
"""

import argparse
import math
import os
import random
import subprocess
from pathlib import Path

LIMIT_S = 25


def _number(rng, low, high):
    return round(rng.uniform(low, high), 2)


def _cylinder(rng, radius, height, extra=""):
    return f"cylinder(r={radius},h={height},$fn={rng.choice([12, 16, 20, 24, 32, 40, 48, 64, 100])}{extra})"


def _teardrop(rng, radius, height):
    corners = rng.choice([24, 32, 48])
    return f"rotate([90,0,0]) linear_extrude(height={height},center=true) union() {{ circle(r={radius},$fn={corners}); rotate(45) square({radius}); }}"


def bracket(rng):
    thick, wide, deep, high = _number(rng, 2, 6), _number(rng, 20, 60), _number(rng, 20, 60), _number(rng, 15, 50)
    over = rng.choice([0.01, 0.05, 0.001, 1])
    lines = ["difference(){ union(){", f"cube([{wide},{deep},{thick}]);", f"cube([{wide},{thick},{high}]);"]
    if rng.random() < 0.6:
        lines.append(f"cube([{thick},{deep},{high}]);")
    if rng.random() < 0.5:
        rib = f"polygon([[0,0],[{deep - thick:.3f},0],[0,{high - thick:.3f}]])"
        lines.append(f"translate([{thick},{thick},{thick}]) rotate([90,0,90]) linear_extrude(height={thick}) {rib};")
    for _ in range(rng.randint(0, 3)):
        x, y, radius = _number(rng, 0, wide), _number(rng, 0, deep), _number(rng, 3, 9)
        lines.append(f"translate([{x},{y},0]) {_cylinder(rng, radius, _number(rng, thick, high))};")
    if rng.random() < 0.4:
        lines.append(
            f"translate([{wide / 2},{deep / 2},0]) hull(){{ cylinder(r={_number(rng, 4, 8)},h={thick}); "
            f"translate([{_number(rng, 5, 20)},{_number(rng, -10, 10)},0]) cylinder(r={_number(rng, 3, 6)},h={thick}); }}")
    lines.append("}")
    for _ in range(rng.randint(1, 6)):
        x, y, radius = _number(rng, 3, wide - 3), _number(rng, 3, deep - 3), rng.choice([1.5, 1.65, 2.2, 2.7, 4.3])
        sides = max(3, round(2 * radius)) if rng.random() < 0.3 else None
        turn = rng.choice(["", "rotate([90,0,0])", "rotate([0,90,0])", f"rotate([{rng.choice([10, 15, 30, 45])},0,{rng.choice([0, 22.5, 30])}])"])
        shape = rng.random()
        if shape < 0.4 and sides is None:
            bore = _cylinder(rng, radius, 200, ",center=true")
        elif shape < 0.4:
            bore = f"cylinder(r={radius}/cos(180/{sides}),h=200,$fn={sides},center=true)"
        elif shape < 0.6:
            bore = _teardrop(rng, radius, 200)
        elif shape < 0.8:
            bore = f"cylinder(r1={radius},r2={radius * 2},h={thick + 2 * over},$fn={rng.choice([20, 32])})"
        else:
            bore = f"cylinder(r={radius * 1.8:.3f},h={_number(rng, 2, 30)},$fn=6,center=true)"
        lines.append(f"translate([{x},{y},{rng.choice([0, -over, thick / 2, high / 2])}]) {turn} {bore};")
    if rng.random() < 0.5:
        lines.append(f"translate([{-over},{deep / 2},{high / 2}]) cube([{thick + 2 * over},{_number(rng, 2, deep)},{_number(rng, 2, high)}]);")
    return lines + ["}"]


def cones(rng):
    count, operation = rng.randint(2, 4), rng.choice(["union", "difference", "intersection"])
    lines = [f"{operation}(){{"]
    for _ in range(count):
        turn = f"rotate([{_number(rng, 0, 180)},{rng.choice([0, 90, _number(rng, 0, 90)])},{rng.choice([0, 45, _number(rng, 0, 90)])}])"
        move = f"translate([{_number(rng, -3, 3)},{_number(rng, -3, 3)},{_number(rng, -6, 0)}])"
        lines.append(
            f"{turn} {move} cylinder(r1={_number(rng, 2, 8)},r2={rng.choice([0, _number(rng, 0, 6)])},h={_number(rng, 8, 16)},"
            f"$fn={rng.choice([24, 36, 48, 64, 96])});")
    return lines + ["}"]


def spheres(rng):
    lines = [rng.choice(["union(){", "difference(){"])]
    for _ in range(rng.randint(2, 5)):
        shape = rng.random()
        if shape < 0.5:
            solid = f"sphere(r={_number(rng, 3, 9)},$fn={rng.choice([16, 24, 32, 48])})"
        elif shape < 0.8:
            solid = f"cylinder(r={_number(rng, 2, 6)},h={_number(rng, 5, 20)},$fn={rng.choice([16, 30, 60])},center=true)"
        else:
            solid = (f"rotate_extrude($fn={rng.choice([24, 36])}) translate([{_number(rng, 6, 9)},0]) "
                     f"circle(r={_number(rng, 1, 3)},$fn={rng.choice([12, 20])})")
        move = f"translate([{_number(rng, -4, 4)},{_number(rng, -4, 4)},{_number(rng, -4, 4)}])"
        lines.append(f"{move} rotate([{_number(rng, 0, 90)},{_number(rng, 0, 90)},0]) {solid};")
    return lines + ["}"]


def gear(rng):
    teeth, radius, thick, depth = rng.randint(8, 40), _number(rng, 8, 25), _number(rng, 3, 12), _number(rng, 1, 3)
    corners = []
    for i in range(teeth):
        for part, r in ((0, radius), (0.2, radius + depth), (0.45, radius + depth), (0.65, radius)):
            angle = 2 * math.pi * i / teeth + part * (2 * math.pi / teeth)
            corners.append(f"[{r * math.cos(angle):.5f},{r * math.sin(angle):.5f}]")
    twist = rng.choice([0, 0, 10, 30])
    lines = [f"difference(){{ union(){{ linear_extrude(height={thick},twist={twist},slices={rng.randint(4, 12)}) polygon([{','.join(corners)}]);"]
    if rng.random() < 0.6:
        lines.append(f"cylinder(r={radius * 0.4:.2f},h={thick * 1.8:.2f},$fn={rng.choice([24, 48])});")
    lines += ["}", f"translate([0,0,-1]) {_cylinder(rng, _number(rng, 1.5, radius * 0.3), thick * 3)};"]
    for i in range(rng.randint(0, 6)):
        z = rng.choice([-1, thick * 0.5])
        lines.append(f"rotate({i * 60}) translate([{radius * 0.65:.2f},0,{z}]) {_cylinder(rng, _number(rng, 0.8, radius * 0.2), thick * 3)};")
    if rng.random() < 0.5:
        lines.append(f"translate([0,{-radius * 0.35:.2f},{thick * 1.4:.2f}]) rotate([90,0,0]) cylinder(r=1.5,h={radius},$fn={rng.choice([8, 16, 24])});")
    if rng.random() < 0.4:
        ring = f"translate([{radius * 0.7:.2f},0]) circle(r={thick * 0.35:.2f},$fn=24)"
        lines.append(f"translate([0,0,{thick * 0.7:.2f}]) rotate_extrude($fn={rng.choice([40, 60])}) {ring};")
    return lines + ["}"]


def case(rng):
    wide, deep, high = _number(rng, 20, 60), _number(rng, 20, 50), _number(rng, 8, 30)
    corner, thick, sides, kind = _number(rng, 1, 5), _number(rng, 1, 2.5), rng.choice([16, 24, 32]), rng.random()

    def rounded(w, d, h, r):
        if kind < 0.6:
            column = f"cylinder(r={r},h={h},$fn={sides});"
        else:
            column = f"{{ translate([0,0,{r}]) sphere(r={r},$fn={sides}); translate([0,0,{h}-1]) cylinder(r={r},h=1,$fn={sides}); }}"
        return f"hull(){{ for(x=[{r},{w}-{r}],y=[{r},{d}-{r}]) translate([x,y,0]) {column}}}"

    lines = ["difference(){ union(){ difference(){", rounded(wide, deep, high, corner), f"translate([{thick},{thick},{thick}])"]
    lines += [rounded(wide - 2 * thick, deep - 2 * thick, high + 5, max(0.5, corner - thick * 0.5)), "}"]
    for _ in range(rng.randint(1, 4)):
        move = f"translate([{_number(rng, 5, wide - 5)},{_number(rng, 5, deep - 5)},{thick * rng.choice([0, 0.5, 1]):.3f}])"
        lines.append(f"{move} difference(){{ {_cylinder(rng, _number(rng, 2.5, 4), high * 0.6)}; {_cylinder(rng, 1.2, high)}; }}")
    lines.append("}")
    for _ in range(rng.randint(0, 8)):
        move = f"translate([{_number(rng, 5, wide - 5)},{_number(rng, 5, deep - 5)},-1])"
        lines.append(f"{move} {rng.choice([_cylinder(rng, _number(rng, 0.8, 3), 10), 'cube([1.2,8,10])'])};")
    if rng.random() < 0.5:
        text = rng.choice(["pgd", "A7", "x&y", "42"])
        lines.append(
            f"translate([{wide / 2},{deep / 2},-0.01]) linear_extrude(height=0.6) "
            f'text("{text}",size={_number(rng, 4, 9)},halign="center",valign="center");')
    if rng.random() < 0.5:
        lines.append(f"translate([-1,{deep / 2},{high * 0.6:.2f}]) rotate([0,90,0]) {_cylinder(rng, _number(rng, 1.5, high * 0.3), thick + 3)};")
    return lines + ["}"]


def screw(rng):
    radius, high, sides = _number(rng, 2.5, 8), _number(rng, 8, 25), rng.choice([16, 24, 36])
    thread = f"linear_extrude(height={high},twist={-360 * _number(rng, 2, 6)},slices={rng.randint(40, 120)}) translate([{radius * 0.1:.3f},0])"
    head = f"translate([0,0,{high * rng.choice([0.95, 0.98, 1])}]) cylinder(r={radius * 1.8:.3f},h={radius},$fn=6);"
    lines = ["union(){", f"{thread} circle(r={radius},$fn={sides});", head, "}"]
    if rng.random() < 0.5:
        lines = ["difference(){", *lines, f"translate([0,0,{high + radius * 0.4:.3f}]) cylinder(r={radius * 0.7:.3f},h={radius * 2},$fn=6);", "}"]
    return lines


KINDS = (bracket, bracket, cones, cones, spheres, gear, case, case, screw)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--count", type=int, default=360)
    parser.add_argument("--openscad", default="openscad")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    for number in range(arguments.first, arguments.first + arguments.count):
        kind = KINDS[number % len(KINDS)]
        part = arguments.folder / f"{kind.__name__}_{number:04d}.stl"
        source = part.with_suffix(".scad")
        source.write_text("\n".join(kind(random.Random(number))) + "\n")
        try:
            subprocess.run([arguments.openscad, "-o", part, source], timeout=LIMIT_S, capture_output=True, check=True, env={**os.environ, "QT_QPA_PLATFORM": "offscreen"})
        except (subprocess.TimeoutExpired, subprocess.CalledProcessError) as error:
            part.unlink(missing_ok=True)
            print(f"{part.name}: {error}", flush=True)


if __name__ == "__main__":
    main()
