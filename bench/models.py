#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes all models of a folder by quality alone, checks the meshes, and compares them with TetGen's.

For every model: `pgdr mesh MODEL --radius-edge-ratio 2 --ignore-region-sizes`, `pgdr check --plc MODEL`, and, unless told
otherwise, TetGen 1.5 on the PLC that pgdr understood (`pgdr info --write-plc`, near-coplanar facets fused): `tetgen -pMq2.0/0`.
Models that a run does not finish within the limit are reported as such; invalid ones are counted apart. Prints a table in
Markdown, and how many ended and passed.

usage: bench/models.py FOLDER [NAME...] [--pgdr PROGRAM] [--limit SECONDS] [--threads N] [--no-tetgen] [--tolerance T] [--known NAME,...]
       NAME: only models whose names begin with it
       --known: models that may fail without the whole run failing
Needs: cmake --build build/release --target pgdr-app; Debian's package tetgen, but for --no-tetgen.
"""

import argparse
import json
import math
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

from measure import ROOT, attempt, median, note, number, table

BOUND = 2.0
INVALID = 3  # exit code for input that cannot be meshed
SUFFIXES = (".off", ".stl", ".obj", ".ply", ".poly", ".smesh")


class Result(NamedTuple):
    tetrahedra: int
    over: int  # above the bound: ours are all exempt, or the check fails
    seconds: float
    remark: str


def ours(pgdr, model, limit, threads, tolerance, folder):
    stats = folder / "stats.json"
    code, seconds, text = attempt([pgdr, "mesh", model, "--radius-edge-ratio", BOUND, "--ignore-region-sizes", "--threads",
                                   threads, "--quiet", "--stats", stats, "-o", folder / "out.mesh", *tolerance], limit, folder)
    if code is None:
        return Result(0, 0, seconds, "no end")
    if code == INVALID:
        return None
    if code != 0:
        return Result(0, 0, seconds, f"exit code {code}: {text.strip().splitlines()[-1] if text.strip() else ''}")
    numbers = json.loads(stats.read_text(encoding="utf-8"))
    # The checker makes the Delaunay triangulation again, on one thread: that takes longer than the mesh did.
    code, _, _ = attempt([pgdr, "check", folder / "out.mesh", "--plc", model, *tolerance], 5 * limit, folder)
    return Result(numbers["tetrahedra"], numbers["exempt_tetrahedra"], seconds, "" if code == 0 else "check fails")


def ratio(p):
    """Radius-edge ratio of a tetrahedron."""
    a, b, c = ([x - y for x, y in zip(v, p[3])] for v in p[:3])
    def dot(u, v):
        return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
    def cross(u, v):
        return u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]
    bc, ca, ab = cross(b, c), cross(c, a), cross(a, b)
    volume = abs(dot(a, bc))
    o = [dot(a, a) * x + dot(b, b) * y + dot(c, c) * z for x, y, z in zip(bc, ca, ab)]
    shortest = min(math.dist(u, v) for i, u in enumerate(p) for v in p[:i])
    return math.inf if volume == 0 else math.sqrt(dot(o, o)) / (2 * volume) / shortest


def rows_of(path):
    with open(path, encoding="ascii") as lines:
        for line in lines:
            words = line.split("#")[0].split()
            if words:
                yield words


def tetgens(tetgen, plc, limit, folder):
    code, seconds, text = attempt([tetgen, "-pMQq2.0/0", plc], limit, folder)
    name = str(plc)[: -len(".poly")] + ".1"
    if code is None:
        return Result(0, 0, seconds, "no end")
    if code != 0 or not Path(name + ".ele").exists():
        return Result(0, 0, seconds, f"exit code {code}")
    nodes = rows_of(name + ".node")
    next(nodes)
    points = {words[0]: tuple(map(float, words[1:4])) for words in nodes}
    elements = rows_of(name + ".ele")
    next(elements)
    ratios = [ratio([points[v] for v in words[1:5]]) for words in elements]
    return Result(len(ratios), sum(r > BOUND * (1 + 1e-9) for r in ratios), seconds, "")


def corners(pgdr, model, plc, tolerance, folder):
    """Writes the PLC as understood; plane corners below 14.48 degrees and the smallest angles."""
    _, _, text = attempt([pgdr, "info", model, "--write-plc", plc, *tolerance], 600, folder)
    def labelled(label):
        return number(text, label + r"\s+([\d.,]+)", 0.0)
    return int(labelled("plane angles < 14.48")), labelled("smallest dihedral angle"), labelled("smallest plane angle")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("names", nargs="*")
    parser.add_argument("--pgdr", type=lambda p: Path(p).resolve(), default=ROOT / "build" / "release" / "pgdr")
    parser.add_argument("--limit", type=float, default=60)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--no-tetgen", action="store_true")
    parser.add_argument("--tolerance", help="as `pgdr mesh` takes it")
    parser.add_argument("--known", type=lambda names: names.split(","), default=[], metavar="NAME,...", help="models that may fail")
    arguments = parser.parse_args()
    tolerance = ["--tolerance", arguments.tolerance] if arguments.tolerance else []
    tetgen = None if arguments.no_tetgen else shutil.which("tetgen")
    if not tetgen and not arguments.no_tetgen:
        sys.exit("tetgen is not installed")
    models = sorted(p.resolve() for p in arguments.folder.iterdir()
                    if p.suffix in SUFFIXES and (not arguments.names or any(p.name.startswith(n) for n in arguments.names)))
    rows, ratios, seconds, failed, invalid = [], [], [], [], []
    for model in models:
        with tempfile.TemporaryDirectory(prefix="pgdr-models-") as scratch:
            folder = Path(scratch)
            our = ours(arguments.pgdr, model, arguments.limit, arguments.threads, tolerance, folder)
            if our is None:
                invalid.append(model.stem)
                continue
            low_corners, dihedral, plane = corners(arguments.pgdr, model, folder / "fused.poly", tolerance, folder)
            their = tetgens(tetgen, folder / "fused.poly", arguments.limit, folder) if tetgen else Result(0, 0, 0, "")
        allowed = 0 if min(dihedral, plane) >= 60 else max(their.over // 2, 2 * low_corners)
        more = our.tetrahedra / their.tetrahedra if their.tetrahedra and our.tetrahedra else 0
        remarks = [r for r in (our.remark, their.remark and "TetGen: " + their.remark) if r]
        if our.over > allowed and tetgen:
            remarks.append("too many exempt")
        if more:
            ratios.append(more)
        if our.remark:
            failed.append(model.stem)
        seconds.append(our.seconds)
        rows.append([model.stem, f"{dihedral:.3g}", f"{plane:.3g}", f"{our.tetrahedra:,}", f"{their.tetrahedra:,}",
                     f"{more:.2f}" if more else "", f"{our.over:,}", f"{allowed:,}", f"{their.over:,}",
                     f"{our.seconds:.1f}", f"{their.seconds:.1f}", "; ".join(remarks)])
        note(" | ".join(rows[-1]))
    print(table(["model", "dihedral", "plane angle", "pgdr", "TetGen", "ratio", "exempt", "allowed", "TetGen over",
                 "pgdr, s", "TetGen, s", "remarks"], rows))
    print(f"\n{len(rows) - len(failed)} of {len(rows)} ended with a mesh that passes; {len(invalid)} are invalid")
    if seconds:
        print(f"Median seconds: {median(seconds):.2f}, the slowest {max(seconds):.1f}")
    if ratios:
        print(f"Median ratio of tetrahedra to TetGen's over {len(ratios)} models: {median(ratios):.2f}")
    return 1 if set(failed) - set(arguments.known) else 0


if __name__ == "__main__":
    sys.exit(main())
