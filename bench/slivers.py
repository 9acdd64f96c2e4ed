#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What `--min-dihedral` does to models: a table in Markdown, without and with it.

For every model: tetrahedra, the smallest dihedral angle, how many tetrahedra have one below 1, 5, 10 and 14 degrees, exempt ones, both before and after;
the vertices that were moved and added, and the time of the refinement and of removing slivers. Every mesh is checked against its model.

usage: bench/slivers.py MODEL... [--angle A] [--pgdr PROGRAM] [--limit SECONDS] [--threads N] [--size R]
Needs: cmake --build build/release --target pgdr-app
"""

import argparse
import json
import sys
import tempfile
from pathlib import Path

from measure import ROOT, attempt, note, table

ANGLES = ("1", "5", "10", "14")


def run(pgdr, model, how, limit, folder):
    """The statistics of a run, or what went wrong."""
    stats, mesh = folder / "stats.json", folder / "out.mesh"
    code, _, _ = attempt([pgdr, "mesh", model, "--quiet", "--stats", stats, "-o", mesh, *how], limit, folder)
    if code != 0:
        return None, "no end" if code is None else f"exit code {code}"
    code, _, _ = attempt([pgdr, "check", mesh, "--plc", model], 5 * limit, folder)
    return json.loads(stats.read_text(encoding="utf-8")), "" if code == 0 else ", check fails"


def row(pgdr, model, angle, how, limit, folder):
    before, trouble = run(pgdr, model, [*how, "--min-dihedral", "0"], limit, folder)
    if before is None:
        return [model.stem, trouble] + [""] * 6
    after, trouble = run(pgdr, model, [*how, "--min-dihedral", angle], limit, folder)
    if after is None:
        return [model.stem, trouble] + [""] * 6

    def both(figure):
        return f"{figure(before)}; {figure(after)}"

    def below(numbers):
        return " ".join(f"{numbers['tetrahedra_below_deg'][a]:,}" for a in ANGLES)

    slivers = after["slivers"]
    return [model.stem, both(lambda n: f"{n['tetrahedra']:,}") + trouble, both(lambda n: f"{n['min_dihedral_deg']:.2g}"), both(below),
            both(lambda n: f"{n['exempt_tetrahedra']:,}"), f"{slivers['moved']:,}", f"{slivers['added']:,}",
            f"{after['seconds'].get('refinement', 0):.2f}; {after['seconds'].get('slivers', 0):.2f}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", nargs="+", type=lambda p: Path(p).resolve())
    parser.add_argument("--angle", default="12")
    parser.add_argument("--pgdr", type=lambda p: Path(p).resolve(), default=ROOT / "build" / "release" / "pgdr")
    parser.add_argument("--limit", type=float, default=120)
    parser.add_argument("--threads", default="2")
    parser.add_argument("--size")
    arguments = parser.parse_args()
    how = ["--threads", arguments.threads] + (["--size", arguments.size] if arguments.size else [])
    rows = []
    for model in arguments.models:
        with tempfile.TemporaryDirectory(prefix="pgdr-slivers-") as scratch:
            rows.append(row(arguments.pgdr, model, arguments.angle, how, arguments.limit, Path(scratch)))
        note(" | ".join(rows[-1]))
    print(table(["model", "tetrahedra", "smallest", "below 1 5 10 14", "exempt", "moved", "added", "seconds: refinement; slivers"], rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
