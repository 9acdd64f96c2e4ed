#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The documented way to formats that pgdr does not write: meshio reads the .msh and writes them, with the libraries that are there."""
import os
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77
# Format, and what meshio needs for it.
FORMATS = {".xdmf": "h5py", ".e": "netCDF4"}

try:
    import meshio
except ImportError:
    print("meshio is not installed: skipped")
    sys.exit(SKIPPED)
app = os.environ.get("PGDR_APP", "")
if not app:
    print("no program to test")
    sys.exit(SKIPPED)


def tetrahedra(mesh):
    return sum(len(block.data) for block in mesh.cells if block.type == "tetra")


tried = 0
with tempfile.TemporaryDirectory() as name:
    folder = Path(name)
    data = Path(__file__).resolve().parents[2] / "data"
    subprocess.run([app, "mesh", data / "two_regions.poly", "--size", "0.4", "--quiet", "-o", folder / "out.msh"], check=True)
    original = meshio.read(folder / "out.msh")
    assert tetrahedra(original) > 100
    for extension, library in FORMATS.items():
        try:
            __import__(library)
        except ImportError:
            print(f"{extension}: {library} is not installed, left out")
            continue
        tried += 1
        line = f"import meshio; meshio.read('out.msh').write('out{extension}')"
        run = subprocess.run([sys.executable, "-c", line], cwd=folder, capture_output=True, text=True)
        assert run.returncode == 0, f"{extension}: {run.stderr}"
        copy = meshio.read(folder / f"out{extension}")
        assert len(copy.points) == len(original.points), extension
        assert tetrahedra(copy) == tetrahedra(original), (extension, tetrahedra(copy))
if tried == 0:
    sys.exit(SKIPPED)
