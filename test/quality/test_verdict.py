#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The measures that --quality writes are those of VTK's Verdict library, tetrahedron by tetrahedron."""

import csv
import os
import pathlib
import subprocess
import sys
import tempfile

try:
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkFiltersVerdict import vtkMeshQuality
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
except ImportError:
    print("pgdr-test-skip: python3-vtk9 is not installed")
    sys.exit(77)

DATA = pathlib.Path(__file__).resolve().parents[2] / "data"
# Our column, Verdict's name, and how to get the one from the other: VTK 9.1 has no mean ratio of tetrahedra, but its inverse.
MEASURES = [("edge_ratio", "EdgeRatio", lambda x: x), ("aspect_ratio", "AspectRatio", lambda x: x),
            ("mean_ratio", "AspectFrobenius", lambda x: 1 / x), ("scaled_jacobian", "ScaledJacobian", lambda x: x),
            ("volume", "Volume", lambda x: x)]


def verdict(path, name):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    quality = vtkMeshQuality()
    quality.SetInputConnection(reader.GetOutputPort())
    getattr(quality, f"SetTetQualityMeasureTo{name}")()
    quality.Update()
    return vtk_to_numpy(quality.GetOutput().GetCellData().GetArray("Quality"))


def main():
    app = os.environ.get("PGDR_APP")
    if not app:
        print("pgdr-test-skip: there is no program pgdr")
        return 77
    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        mesh, table = pathlib.Path(folder) / "m.vtu", pathlib.Path(folder) / "q.csv"
        subprocess.run([app, "mesh", DATA / "winged_body_in_box.poly", "--min-dihedral", "0", "--quiet", "-o", mesh, "--quality", table], check=True)
        with open(table, newline="") as file:
            rows = list(csv.DictReader(file))
        for ours, theirs, convert in MEASURES:
            values = convert(verdict(mesh, theirs))
            worst = max(abs(float(row[ours]) - value) / abs(value) for row, value in zip(rows, values, strict=True))
            print(f"{ours}: {len(rows)} tetrahedra, largest relative difference {worst:.2g}")
            failed += not worst < 1e-5
    return failed


if __name__ == "__main__":
    sys.exit(main())
