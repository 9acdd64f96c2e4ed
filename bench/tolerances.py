#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What `--tolerance` does to models: a table in Markdown, exact and with three tolerances.

For every model and tolerance: facets of the PLC that is meshed, tetrahedra, exempt ones, the smallest dihedral angle of the mesh, seconds in all, and
the distance of what is meshed from the input as `pgdr check` measures it, in parts of the bounding box's diagonal.

usage: bench/tolerances.py MODEL... [--pgdr PROGRAM] [--limit SECONDS] [--threads N]
Needs: cmake --build build/release --target pgdr-app
"""

import argparse
import json
import math
import re
import sys
import tempfile
from pathlib import Path

from measure import ROOT, attempt, note, number, table

TOLERANCES = ("0", "1e-5d", "1e-4d", "1e-3d")


def diagonal(text):
    box = re.search(r"bounding box\s+(.*)", text)
    if not box:
        return math.nan
    corners = [float(x) for x in re.findall(r"[-+.\de]+", box.group(1))]
    return math.dist(corners[:3], corners[3:6])


def row(pgdr, model, tolerance, limit, threads, folder):
    how = ["--tolerance", tolerance]
    _, _, info = attempt([pgdr, "info", model, *how], limit, folder)
    facets = number(info, r"facets\s+([\d,]+)", math.nan)
    name = [model.stem, "exact" if tolerance == "0" else tolerance, "" if math.isnan(facets) else f"{facets:,.0f}"]
    stats, mesh = folder / "stats.json", folder / "out.mesh"
    code, seconds, _ = attempt([pgdr, "mesh", model, "--quiet", "--threads", threads, "--stats", stats, "-o", mesh, *how], limit, folder)
    if code != 0:
        return name + ["no end" if code is None else f"exit code {code}", "", "", f"{seconds:.1f}", ""]
    numbers = json.loads(stats.read_text(encoding="utf-8"))
    code, _, check = attempt([pgdr, "check", mesh, "--plc", model, *how], 5 * limit, folder)
    distance = number(check, r"distance met is ([\d.e+-]+)", math.nan) / diagonal(info)
    return name + [f"{numbers['tetrahedra']:,}" + ("" if code == 0 else ", check fails"), f"{numbers['exempt_tetrahedra']:,}",
                   f"{numbers['min_dihedral_deg']:.2g}", f"{seconds:.1f}", "" if math.isnan(distance) else f"{distance:.1e}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", nargs="+", type=lambda p: Path(p).resolve())
    parser.add_argument("--pgdr", type=lambda p: Path(p).resolve(), default=ROOT / "build" / "release" / "pgdr")
    parser.add_argument("--limit", type=float, default=60)
    parser.add_argument("--threads", type=int, default=2)
    arguments = parser.parse_args()
    rows = []
    for model in arguments.models:
        for tolerance in TOLERANCES:
            with tempfile.TemporaryDirectory(prefix="pgdr-tolerances-") as scratch:
                rows.append(row(arguments.pgdr, model, tolerance, arguments.limit, arguments.threads, Path(scratch)))
            note(" | ".join(rows[-1]))
    print(table(["model", "tolerance", "facets", "tetrahedra", "exempt", "smallest dihedral", "seconds", "distance"], rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
