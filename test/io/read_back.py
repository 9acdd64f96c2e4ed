#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads a mesh that pgdr wrote with meshio and, if it is there, VTK, and compares it with what was told.

usage: read_back.py MESH POINTS TETRAHEDRA [--exempt N] [--volume V] [--group NAME:TYPE:COUNT]... [--order 2] [--triangles N]

Exit code 0: all equal; 1: not (one line says what); 77: meshio is not installed.
"""
import argparse
import sys

CELL_DATA = ["exempt", "min_dihedral_angle", "radius_edge_ratio", "region", "unrefined"]


def tetrahedra_of(mesh):
    import numpy

    blocks = [block.data for block in mesh.cells if block.type in ("tetra", "tetra10")]
    return numpy.concatenate(blocks) if blocks else numpy.zeros((0, 4), dtype=int)


def signed_volumes(points, tetrahedra):
    import numpy

    a, b, c, d = (points[tetrahedra[:, i]] for i in range(4))
    return numpy.einsum("ij,ij->i", b - a, numpy.cross(c - a, d - a)) / 6


def elements_of(mesh, name, kind):
    """How many elements of a type are in a named group: Gmsh's physical groups, sets of others, or a tag where the format has no names."""
    number = name.rpartition("_")[2]
    number = int(number) if number.lstrip("-").isdigit() else None
    if name in mesh.field_data and "marker" in mesh.cell_data:  # a .vtu file
        number, tags = mesh.field_data[name][0], "region" if kind.startswith("tetra") else "marker"
    elif name in mesh.field_data:
        number, tags = mesh.field_data[name][0], "gmsh:physical"
    elif name in mesh.cell_sets:
        return sum(len(s) for s, block in zip(mesh.cell_sets[name], mesh.cells) if s is not None and block.type == kind)
    else:
        tags = next((t for t in ("su2:tag", "tetgen:ref", "medit:ref") if t in mesh.cell_data), None)
        if tags is None:
            sys.exit(f"no group {name}: {sorted(mesh.field_data)}, {sorted(mesh.cell_sets)}, {sorted(mesh.cell_data)}")
    return sum(int((values == number).sum()) for values, block in zip(mesh.cell_data[tags], mesh.cells) if block.type == kind)


def check_middle_nodes(mesh):
    """Nodes of second order are in the middle of the edges that meshio, as VTK, says they are on."""
    ends = {"tetra10": (4, ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))), "triangle6": (3, ((0, 1), (1, 2), (2, 0)))}
    for block in mesh.cells:
        corners, edges = ends[block.type]
        for k, (a, b) in enumerate(edges):
            middle = (mesh.points[block.data[:, a]] + mesh.points[block.data[:, b]]) / 2
            expect(f"node {k} of {block.type} in the middle", bool((abs(middle - mesh.points[block.data[:, corners + k]]) < 1e-9).all()), True)


def expect(what, found, expected):
    if found != expected:
        sys.exit(f"{what}: {found}, expected {expected}")


def check_with_meshio(arguments):
    import meshio

    mesh = meshio.read(arguments.mesh)
    tetrahedra = tetrahedra_of(mesh)
    expect("points in meshio", len(mesh.points), arguments.points)
    expect("tetrahedra in meshio", len(tetrahedra), arguments.tetrahedra)
    if len(tetrahedra):
        volumes = signed_volumes(mesh.points, tetrahedra)
        expect("all tetrahedra positively oriented", bool((volumes > 0).all()), True)
        expected = arguments.volume
        if expected is not None and abs(volumes.sum() - expected) > 1e-9 * abs(expected):
            sys.exit(f"volume: {volumes.sum()}, expected {expected}")
    if arguments.order == 2:
        check_middle_nodes(mesh)
    if arguments.triangles is not None:
        expect("triangles in meshio", sum(len(b.data) for b in mesh.cells if b.type.startswith("triangle")), arguments.triangles)
    for group in arguments.group:
        name, kind, count = group.split(":")
        expect(f"elements of {name}", elements_of(mesh, name, kind), int(count))
    if arguments.mesh.endswith(".vtu"):
        data = {name: values[0] for name, values in mesh.cell_data.items()}
        expect("cell data", sorted(data), sorted(CELL_DATA + (["attribute", "marker"] if arguments.triangles else [])))
        expect("point data", "reference" in mesh.point_data, True)
        if len(tetrahedra):
            ratios = data["radius_edge_ratio"]
            expect("ratios at least that of the regular tetrahedron", bool((ratios > 0.612).all()), True)
            angles = data["min_dihedral_angle"]
            expect("angles in range", bool(((angles >= 0) & (angles < 70.6)).all()), True)
        if arguments.exempt is not None:
            expect("exempt tetrahedra", int(data["exempt"].sum()), arguments.exempt)


def check_with_vtk(arguments):
    try:
        from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow
        from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
    except ImportError:
        print("vtk is not installed: left out")
        return
    errors = vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(errors)
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(arguments.mesh)
    reader.Update()
    expect("messages of VTK", errors.GetOutput(), "")
    grid = reader.GetOutput()
    expect("points in VTK", grid.GetNumberOfPoints(), arguments.points)
    expect("cells in VTK", grid.GetNumberOfCells(), arguments.tetrahedra + (arguments.triangles or 0))
    vtk_tetra = {1: 10, 2: 24}[arguments.order]
    for cell in {0, arguments.tetrahedra - 1} if arguments.tetrahedra else ():
        expect("cell type", grid.GetCellType(cell), vtk_tetra)
    names = [grid.GetCellData().GetArrayName(i) for i in range(grid.GetCellData().GetNumberOfArrays())]
    expect("cell data in VTK", sorted(names), sorted(CELL_DATA + (["attribute", "marker"] if arguments.triangles else [])))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("mesh")
    parser.add_argument("points", type=int)
    parser.add_argument("tetrahedra", type=int)
    parser.add_argument("--exempt", type=int)
    parser.add_argument("--volume", type=float)
    parser.add_argument("--order", type=int, default=1)
    parser.add_argument("--triangles", type=int)
    parser.add_argument("--group", action="append", default=[])
    arguments = parser.parse_args()
    try:
        import meshio  # noqa: F401
    except ImportError:
        print("meshio is not installed")
        sys.exit(77)
    check_with_meshio(arguments)
    if arguments.mesh.endswith(".vtu"):
        check_with_vtk(arguments)
    print("equal")


if __name__ == "__main__":
    main()
