#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What slivers cost a solver: Poisson's equation on meshes of pgdr without and with their removal. A table in Markdown.

-div grad u = f on the model, linear elements by DOLFINx, u = sin(k.x) given on the boundary and f so that this is the solution; k is
two waves over the bounding box's diagonal. For every mesh: the condition number of the stiffness matrix of the vertices inside (ARPACK), by
itself and scaled to a diagonal of ones, as solvers do; the iterations of conjugate gradients, so scaled, to a residual of 1e-10; the
error of the solution and of its gradient, relative, in L2.

usage: bench/finite_elements.py MODEL[:SIZE]... [--angle A] [--pgdr PROGRAM]     MODEL: a file, or cube
Needs: cmake --build build/release --target pgdr-app; Debian's packages python3-dolfinx, python3-scipy, python3-meshio, and its Python.
"""

import argparse
import json
import logging
import sys
import tempfile
from pathlib import Path

import meshio
import numpy
import scipy.sparse
import scipy.sparse.linalg
import ufl
from dolfinx import fem, mesh
from dolfinx.fem import petsc
from mpi4py import MPI

from measure import ROOT, attempt, note, table

DEGREE = 6  # of the polynomials that the error is integrated exactly for


def read(path):
    """Points and tetrahedra in DOLFINx's form, without vertices of no tetrahedron."""
    file = meshio.read(path)
    corners = numpy.concatenate([block.data for block in file.cells if block.type == "tetra"])
    used, corners = numpy.unique(corners, return_inverse=True)
    cell = ufl.Mesh(ufl.VectorElement("Lagrange", ufl.Cell("tetrahedron", geometric_dimension=3), 1))
    return mesh.create_mesh(MPI.COMM_SELF, corners.reshape(-1, 4), file.points[used], cell)


def condition(matrix):
    """Of a symmetric positive definite matrix: the quotient of its largest and smallest eigenvalues."""
    largest = scipy.sparse.linalg.eigsh(matrix, k=1, which="LA", return_eigenvectors=False, tol=1e-4)[0]
    smallest = scipy.sparse.linalg.eigsh(matrix, k=1, sigma=0, which="LM", return_eigenvectors=False, tol=1e-4)[0]
    return largest / smallest


def poisson(path):
    """Condition numbers (plain, scaled), iterations, relative errors (L2, gradient)."""
    domain = read(path)
    points = domain.geometry.x
    wave = 4 * numpy.pi / numpy.linalg.norm(points.max(axis=0) - points.min(axis=0)) * numpy.array([0.6, 0.48, 0.64])
    x = ufl.SpatialCoordinate(domain)
    exact = ufl.sin(ufl.dot(fem.Constant(domain, wave), x))
    space = fem.FunctionSpace(domain, ("CG", 1))
    u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
    stiffness = petsc.assemble_matrix(fem.form(ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx))
    stiffness.assemble()
    indptr, indices, data = stiffness.getValuesCSR()
    load = petsc.assemble_vector(fem.form(fem.Constant(domain, wave @ wave) * exact * v * ufl.dx(metadata={"quadrature_degree": DEGREE}))).getArray()
    k = scipy.sparse.csr_matrix((data, indices, indptr))
    domain.topology.create_connectivity(2, 3)
    boundary = fem.locate_dofs_topological(space, 2, mesh.exterior_facet_indices(domain.topology))
    inner = numpy.setdiff1d(numpy.arange(k.shape[0]), boundary)
    solution = fem.Function(space)
    values = numpy.sin(space.tabulate_dof_coordinates() @ wave)
    a = k[inner][:, inner].tocsc()
    b = load[inner] - k[inner][:, boundary] @ values[boundary]
    scale = scipy.sparse.diags(1 / numpy.sqrt(a.diagonal()))
    scaled = (scale @ a @ scale).tocsc()
    steps = []
    y, info = scipy.sparse.linalg.cg(scaled, scale @ b, tol=1e-10, maxiter=100000, callback=steps.append)
    iterations = f"{len(steps):,}" if info == 0 else "no end"
    values[inner] = scale @ y
    solution.x.array[:] = values

    def norm(what):
        return numpy.sqrt(fem.assemble_scalar(fem.form(ufl.inner(what, what) * ufl.dx(metadata={"quadrature_degree": DEGREE}))))

    return (condition(a), condition(scaled), iterations, norm(solution - exact) / norm(exact),
            norm(ufl.grad(solution - exact)) / norm(ufl.grad(exact)))


def row(pgdr, model, size, angle, folder):
    path = ROOT / "data" / "cube.poly" if model == "cube" else Path(model).resolve()
    how = ["--size", size] if size else []
    code, _, text = attempt([pgdr, "mesh", path, "--quiet", "--ignore-region-sizes", *how, "--min-dihedral", angle, "--stats",
                             folder / "stats.json", "-o", folder / "out.mesh"], 600, folder)
    if code != 0:
        return [path.stem, angle, f"exit code {code}: {text.strip()}"[:80]] + [""] * 6
    numbers = json.loads((folder / "stats.json").read_text(encoding="utf-8"))
    plain, scaled, iterations, error, gradient = poisson(folder / "out.mesh")
    return [path.stem, angle, f"{numbers['tetrahedra']:,}", f"{numbers['min_dihedral_deg']:.2g}", f"{plain:.3g}", f"{scaled:.3g}", iterations,
            f"{error:.3e}", f"{gradient:.3e}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", nargs="+")
    parser.add_argument("--angle", default="12")
    parser.add_argument("--pgdr", type=lambda p: Path(p).resolve(), default=ROOT / "build/release/pgdr")
    arguments = parser.parse_args()
    logging.disable(logging.INFO)  # DOLFINx compiles its forms, and says so
    rows = []
    for word in arguments.models:
        model, _, size = word.partition(":")
        for angle in ("0", arguments.angle):
            with tempfile.TemporaryDirectory(prefix="pgdr-elements-") as scratch:
                rows.append(row(arguments.pgdr, model, size, angle, Path(scratch)))
            note(" | ".join(rows[-1]))
    print(table(["model", "`--min-dihedral`", "tetrahedra", "smallest angle", "condition", "scaled", "iterations", "error", "of the gradient"], rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
