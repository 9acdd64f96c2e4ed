#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The meshes of golden.txt are what they were, bit for bit, whatever compiler and processor pgdr was compiled for.

Facets with cocircular vertices have several Delaunay triangulations, and which one CGAL makes depends on its version: where a mesh depends on that,
a second checksum behind a comma is that of CGAL 6 (PGDR_CGAL_VERSION, which ctest sets; 5 if it is not set).

A mesh that changes is a decision: `test_golden.py --remake` writes the table anew, and the commit says why. Real models are
looked for in PGDR_INPUTS, else in PGDR_INPUTS_DEFAULT, which ctest sets to where all tests look, and left out where they are absent.

usage: PGDR_APP=build/release/pgdr test/golden/test_golden.py [--remake]
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
TABLE = HERE / "golden.txt"
FOLDERS = {"data": HERE.parents[1] / "data", "corpus": HERE.parent / "corpus"}


def find(name):
    """The file that `data/cube.poly`, `corpus/fan_8.poly` or `inputs/a01.off` stands for; None where it is absent."""
    folder, file = name.split("/", 1)
    inputs = os.environ.get("PGDR_INPUTS") or os.environ.get("PGDR_INPUTS_DEFAULT") or ""
    path = FOLDERS.get(folder, pathlib.Path(inputs)) / file
    return path if path.is_file() or folder != "inputs" else None


def checksum(app, path, options, folder):
    command = [app, "mesh", path, "--quiet", "--max-memory", "none", "-o", folder / "out.mesh", "--stats", folder / "stats.json"]
    run = subprocess.run(command + options, capture_output=True, text=True, check=False)
    if run.returncode not in (0, 4):  # a limit of vertices or lengths is part of what the mesh is
        return f"exit code {run.returncode}: {run.stderr.strip()}"
    return json.loads((folder / "stats.json").read_text(encoding="utf-8"))["mesh_checksum"]


def main():
    app = os.environ.get("PGDR_APP", "")
    if not app:
        print("no program to test")
        return 77
    remakes = sys.argv[1:] == ["--remake"]
    column = -1 if int(os.environ.get("PGDR_CGAL_VERSION", "5").split(".")[0]) >= 6 else 0
    lines, wrong, absent = [], 0, 0
    with tempfile.TemporaryDirectory() as name:
        for line in TABLE.read_text(encoding="utf-8").splitlines():
            if line.startswith("#") or not line.strip():
                lines.append(line)
                continue
            checksums, file, *options = line.split()
            expected = checksums.split(",")
            path = find(file)
            if path is None:
                absent += 1
                lines.append(line)
                continue
            found = checksum(app, path, options, pathlib.Path(name))
            if found != expected[column]:
                wrong += 1
                print(f"{file} {' '.join(options)}: {found}, not {expected[column]}")
                if column == -1 and len(expected) == 1:
                    expected.append(found)
                expected[column] = found
            lines.append(" ".join([",".join(expected), file, *options]))
    if absent:
        print(f"{absent} models are absent: PGDR_INPUTS names their folder")
    if remakes:
        TABLE.write_text("\n".join(lines) + "\n", encoding="utf-8")
        print(f"{wrong} checksums remade")
        return 0
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
