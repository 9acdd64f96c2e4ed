#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Dihedral angles of the meshes that pgdr and others make of the same models: a table in Markdown.

For every model, by quality alone, radius-edge ratio 2: pgdr without and with the removal of slivers; TetGen 1.5 with its
default optimization, on the PLC that pgdr understood; Gmsh's HXT with optimization, which keeps the surface's triangles and adds
none; CGAL's Mesh_3 with perturbation and exudation, which needs a size: the one, of at most seven that are tried, that gives
about as many tetrahedra as pgdr made, and whose surface is near the model's, not the model's. Gmsh and Mesh_3 take closed surfaces of
triangles alone; the model "cube" is data/cube.poly, and has a size. All angles are measured here, by NumPy.

usage: bench/quality.py MODEL... [--angle A] [--pgdr PROGRAM] [--mesh-3 PROGRAM] [--limit SECONDS] [--cube-size R]
Needs: cmake --build build/release --target pgdr-app bench_mesh_3_peer; Debian's packages gmsh, tetgen, python3-meshio.
What is not installed is left out with a message.
"""

import argparse
import shutil
import sys
import tempfile
from pathlib import Path

import meshio
import numpy

from measure import ROOT, attempt, note, table
from peers import CUBE_GEO, CUBE_OFF

BELOW = (1, 5, 10, 14)  # degrees
THREADS = 2


def tetrahedra(path):
    """Corners of all tetrahedra of a mesh file: an array of (n, 4, 3)."""
    mesh = meshio.read(path)
    return numpy.concatenate([mesh.points[block.data] for block in mesh.cells if block.type == "tetra"])


def dihedral_angles(corners):
    """The six dihedral angles of tetrahedra (n, 4, 3), in degrees: an array of (n, 6)."""
    angles = []
    for i in range(4):
        for j in range(i):
            k, l = (m for m in range(4) if m not in (i, j))
            edge = corners[:, j] - corners[:, i]
            u, v = (numpy.cross(edge, corners[:, m] - corners[:, i]) for m in (k, l))
            # The cross product again, and not an inverse cosine, which has no digits left where the angle is 0.
            sine = numpy.linalg.norm(numpy.cross(u, v), axis=1)
            angles.append(numpy.degrees(numpy.arctan2(sine, numpy.einsum("ij,ij->i", u, v))))
    return numpy.stack(angles, axis=1)


def row(model, mesher, path, seconds):
    corners = tetrahedra(path)
    angles = dihedral_angles(corners)
    smallest, n = angles.min(axis=1), len(corners)
    shares = [f"{100 * numpy.count_nonzero(smallest < a) / n:.3f}" for a in BELOW]
    return [model, mesher, f"{n:,}", f"{smallest.min():.2g}", f"{angles.max():.1f}", *shares, f"{seconds:.1f}"]


class Model:
    """A model, and what each mesher needs of it, in a folder."""

    def __init__(self, name, arguments, folder):
        self.folder, self.pgdr, self.limit = folder, arguments.pgdr, arguments.limit
        self.is_cube = name == "cube"
        self.path = ROOT / "data" / "cube.poly" if self.is_cube else Path(name).resolve()
        self.name = self.path.stem
        self.size = arguments.cube_size if self.is_cube else 0
        self.surface = self.write_surface()

    def write_surface(self):
        """The model as an OFF file, or none if it is no surface."""
        if self.is_cube:
            (self.folder / "surface.off").write_text(CUBE_OFF, encoding="utf-8")
        elif self.path.suffix == ".off":
            shutil.copy(self.path, self.folder / "surface.off")
        elif self.path.suffix in (".stl", ".obj", ".ply"):
            surface = meshio.read(self.path)
            points, back = numpy.unique(surface.points, axis=0, return_inverse=True)
            triangles = back.reshape(-1)[numpy.concatenate([b.data for b in surface.cells if b.type == "triangle"])]
            meshio.write_points_cells(self.folder / "surface.off", points, [("triangle", triangles)])
        else:
            return None
        return self.folder / "surface.off"

    def run(self, command, output):
        """The mesh file and the seconds that it took, or a remark."""
        code, seconds, text = attempt(command, self.limit, self.folder)
        if code == 0 and (self.folder / output).exists():
            return self.folder / output, seconds
        return None, "no end" if code is None else f"exit code {code}: {text.strip().splitlines()[-1] if text.strip() else ''}"[:60]

    def ours(self, angle):
        return self.run([self.pgdr, "mesh", self.path, "--quiet", "--threads", THREADS, "--ignore-region-sizes", "--min-dihedral", angle,
                         "-o", "pgdr.mesh", *(["--size", self.size] if self.size else [])], "pgdr.mesh")

    def tetgens(self, program):
        attempt([self.pgdr, "info", self.path, "--write-plc", "plc.poly"], self.limit, self.folder)
        # The volume of a tetrahedron of TetGen's, for as many as pgdr makes of a circumradius: measured, as in bench/peers.py.
        volume = f"a{0.38 * self.size ** 3:.3g}" if self.size else ""
        return self.run([program, "-pMQq2.0/0" + volume, "plc.poly"], "plc.1.ele")

    def gmshs(self, program):
        if self.is_cube:
            geometry = CUBE_GEO
        else:
            surface = meshio.read(self.surface)
            surface.write(self.folder / "surface.stl")
            geometry = 'Merge "surface.stl";\nSurface Loop(1) = Surface{:};\nVolume(1) = {1};\n'
        (self.folder / "model.geo").write_text(geometry, encoding="utf-8")
        size = ["-clmax", 0.93 * self.size] if self.size else []
        return self.run([program, "-3", "-algo", "hxt", "-nt", THREADS, "-optimize", "-optimize_netgen", *size, "-format", "mesh", "-o", "gmsh.mesh",
                         "model.geo"], "gmsh.mesh")

    def mesh_3s(self, program, wanted):
        """A size for about as many tetrahedra, which go with its cube; the nearest of seven."""
        points = meshio.read(self.surface).points
        size = self.size or numpy.linalg.norm(points.max(axis=0) - points.min(axis=0)) / 40
        best, nearest = None, numpy.inf
        for _ in range(1 if self.size else 7):
            path, seconds = self.run([program, "surface.off", size, "mesh_3.mesh", THREADS, self.limit / 4], "mesh_3.mesh")
            if path is None:
                return best or (None, seconds)
            n = len(tetrahedra(path))
            if (off := abs(numpy.log(n / wanted))) < nearest:
                nearest = off
                best = path.replace(self.folder / "best.mesh"), seconds
            if nearest < 0.1:
                break
            size *= numpy.clip((n / wanted) ** (1 / 3), 0.5, 2)
        return best


def rows_of(model, angle, programs):
    rows = []

    def add(mesher, result):
        path, seconds = result
        rows.append(row(model.name, mesher, path, seconds) if path else [model.name, mesher, seconds] + [""] * 7)
        note(" | ".join(rows[-1]))

    add("pgdr, `--min-dihedral 0`", model.ours(0))
    ours = model.ours(angle)
    add(f"pgdr, `--min-dihedral {angle}`", ours)
    wanted = len(tetrahedra(ours[0])) if ours[0] else 0
    if programs["tetgen"]:
        add("TetGen", model.tetgens(programs["tetgen"]))
    if model.surface and programs["gmsh"]:
        add("Gmsh HXT", model.gmshs(programs["gmsh"]))
    if model.surface and wanted and programs["mesh-3"]:
        add("Mesh_3", model.mesh_3s(programs["mesh-3"], wanted))
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", nargs="+", help="files, or cube")
    parser.add_argument("--angle", default="12")
    parser.add_argument("--pgdr", type=lambda p: Path(p).resolve(), default=ROOT / "build/release/pgdr")
    parser.add_argument("--mesh-3", default=str(ROOT / "build/release/bench/mesh_3_peer"))
    parser.add_argument("--gmsh", default="gmsh")
    parser.add_argument("--tetgen", default="tetgen")
    parser.add_argument("--limit", type=float, default=300, help="seconds for each run; default 300")
    parser.add_argument("--cube-size", type=float, default=0.045)
    arguments = parser.parse_args()
    programs = {}
    for name, program in (("tetgen", arguments.tetgen), ("gmsh", arguments.gmsh), ("mesh-3", arguments.mesh_3)):
        programs[name] = shutil.which(program)
        if programs[name] is None:
            note(f"skipped: {program} is not there")
    rows = []
    for name in arguments.models:
        with tempfile.TemporaryDirectory(prefix="pgdr-quality-") as scratch:
            rows += rows_of(Model(name, arguments, Path(scratch)), arguments.angle, programs)
    print(table(["model", "mesher", "tetrahedra", "smallest", "largest", *(f"% < {a}" for a in BELOW), "seconds"], rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
