#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The examples of the Python module run, and come out with what they should."""
import re
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77
try:
    import meshio
    import scipy.spatial  # noqa: F401

    import pgdr  # noqa: F401
except ImportError as error:
    print(f"{error}: skipped")
    sys.exit(SKIPPED)

with tempfile.TemporaryDirectory() as folder:
    out = Path(folder) / "poisson.vtu"
    run = subprocess.run([sys.executable, "-B", Path(__file__).parents[2] / "examples/python/poisson.py", out], capture_output=True, text=True)
    found = re.search(r"([\d,]+) tetrahedra>: largest u ([\d.]+)", run.stdout)
    if run.returncode != 0 or not found:
        sys.exit(f"poisson.py: {run.stdout}{run.stderr}")
    # Without the ball, whose material conducts ten times as well, it would be 0.0562 (the series of the cube).
    if not (10_000 < int(found[1].replace(",", "")) < 100_000 and 0.044 < float(found[2]) < 0.049):
        sys.exit(f"poisson.py: {run.stdout}")
    mesh = meshio.read(out)
    if {block.type for block in mesh.cells} != {"tetra", "triangle"} or "u" not in mesh.point_data:
        sys.exit("poisson.vtu does not hold what it should")
