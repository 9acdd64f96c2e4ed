#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python module as users call it. Run by ctest, or by pytest with the module in PYTHONPATH."""
import doctest
import json
import multiprocessing
import os
import signal
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

SKIPPED = 77
try:
    import numpy as np
    import pytest

    import pgdr
except ImportError as error:
    print(f"{error}: skipped")
    sys.exit(SKIPPED)

DATA = Path(os.environ.get("PGDR_DATA_DIR", Path(__file__).parents[2] / "data"))
CORNERS = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
SIDES = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]


def test_the_example_of_the_module():
    assert doctest.testmod(pgdr).failed == 0


def test_arrays():
    mesh = pgdr.mesh(CORNERS, SIDES, size=0.2, markers=[1, 2, 3, 4, 5, 6], regions=[((0.5, 0.5, 0.5), 7)])
    assert mesh.stop == "finished" and mesh.message == "" and mesh.missing_pieces == 0
    assert mesh.points.shape[1] == 3 and mesh.tetrahedra.shape[1] == 4 and mesh.triangles.shape[1] == 3
    assert mesh.points.dtype == np.float64 and len(mesh.regions) == len(mesh.tetrahedra)
    assert set(mesh.regions) == {7} and set(mesh.markers) == {1, 2, 3, 4, 5, 6}
    assert (mesh.volumes() > 0).all() and abs(mesh.volumes().sum() - 1) < 1e-12
    on_first = np.unique(mesh.triangles[mesh.markers == 1])
    assert (mesh.points[on_first][:, 0] == 0).all()
    with pytest.raises(ValueError):
        mesh.points[0, 0] = 1
    assert all(passed for _, passed, _ in mesh.check())
    assert all(passed for _, passed, _ in mesh.check(pgdr.Plc(CORNERS, SIDES, markers=[1, 2, 3, 4, 5, 6], regions=[((0.5, 0.5, 0.5), 7)])))
    points = mesh.points
    del mesh
    assert abs(points.max() - 1) < 1e-12  # the view keeps its memory


def test_the_same_mesh_for_every_number_of_threads_and_as_the_program():
    checksums = {pgdr.mesh(CORNERS, np.array(SIDES), size=0.08, threads=n).statistics()["checksum"] for n in (1, 2, 5)}
    assert len(checksums) == 1
    program = os.environ.get("PGDR_APP")
    if program:
        with tempfile.TemporaryDirectory() as folder:
            arguments = [program, "mesh", DATA / "two_regions.poly", "--size", "0.3", "--stats", "-", "-o", Path(folder) / "a.mesh"]
            text = subprocess.run(arguments, capture_output=True, check=True).stdout
        assert json.loads(text)["mesh_checksum"] == pgdr.mesh(pgdr.read(DATA / "two_regions.poly"), size=0.3).statistics()["checksum"]


def test_sizes():
    coarse, fine = (len(pgdr.mesh(CORNERS, SIDES, size=s).tetrahedra) for s in (0.4, 0.1))
    assert coarse < fine / 4
    assert len(pgdr.mesh(CORNERS, SIDES, size=lambda x, y, z: 0.1).tetrahedra) == fine
    graded = pgdr.mesh(CORNERS, SIDES, size=lambda x, y, z: 0.1 + 0.3 * x)
    assert coarse < len(graded.tetrahedra) < fine
    grid = pgdr.Grid((0, 0, 0), (1, 1, 1), np.full((3, 4, 5), 0.1))
    assert grid(0.3, 0.2, 0.9) == 0.1
    assert len(pgdr.mesh(CORNERS, SIDES, size=grid).tetrahedra) == fine
    values = np.full((9, 9, 9), 0.4)
    values[0, :, :] = 0.1
    assert pgdr.Grid((0, 0, 0), (1, 1, 1), values)(0, 0.5, 0.5) == 0.1  # the first index is x
    assert pgdr.Grid((0, 0, 0), (1, 1, 1), values, gradation=0.2)(0.5, 0.5, 0.5) < 0.21
    nodes = pgdr.Nodes(CORNERS, 0.1 + 0.3 * CORNERS[:, 0])
    assert abs(nodes(0.25, 0.3, 0.6) - 0.175) < 1e-12 and nodes(5, 5, 5) == 0.4
    assert len(pgdr.mesh(CORNERS, SIDES, size=nodes).tetrahedra) == len(graded.tetrahedra)
    by_facet = pgdr.mesh(CORNERS, SIDES, markers=[1, 0, 0, 0, 0, 0], facet_sizes={1: 0.05})
    radii = by_facet.points[by_facet.triangles[by_facet.markers == 1]]
    edges = np.linalg.norm(radii - np.roll(radii, 1, axis=1), axis=2)
    assert edges.max() <= 0.1 * (1 + 1e-9)


def test_cells_across():
    plc = pgdr.Plc(CORNERS, SIDES)
    sizes = [len(pgdr.mesh(plc, cells_across=n).tetrahedra) for n in (2, 6)]
    assert sizes[1] > 5 * sizes[0]
    with pytest.raises(ValueError, match="cells_across"):
        pgdr.mesh(plc, cells_across=-1)


def test_curvature():
    angles = np.linspace(0, 2 * np.pi, 48, endpoint=False)
    rings = [np.column_stack([np.cos(angles), np.sin(angles), np.full(48, z)]) for z in (0.0, 1.0)]
    walls = [[i, (i + 1) % 48, 48 + (i + 1) % 48, 48 + i] for i in range(48)]
    plc = pgdr.Plc(np.vstack(rings), [*walls, list(range(48)), list(range(48, 96))])
    sizes = [len(pgdr.mesh(plc, curvature=n).tetrahedra) for n in (8, 100)]
    assert sizes[1] > 2 * sizes[0]
    with pytest.raises(ValueError, match="curvature"):
        pgdr.mesh(plc, curvature=0)


def test_order_2():
    mesh = pgdr.mesh(CORNERS, SIDES, size=0.3, order=2)
    middle = (mesh.points[mesh.tetrahedra[:, 1]] + mesh.points[mesh.tetrahedra[:, 3]]) / 2
    assert abs(middle - mesh.points[mesh.tetrahedron_nodes[:, 4]]).max() == 0
    assert all(passed for _, passed, _ in mesh.check())


def test_files():
    with tempfile.TemporaryDirectory() as folder:
        mesh = pgdr.mesh(pgdr.read(DATA / "two_regions.poly"), size=0.5)
        mesh.write(Path(folder) / "a.vtu", vtu_triangles=True)
        assert (Path(folder) / "a.vtu").stat().st_size > 1000
        mesh.write(Path(folder) / "a.msh", gmsh_format="2.2", outer_triangles=True)
        text = (Path(folder) / "a.msh").read_text()
        inner = int((mesh.markers == 3).sum())
        assert "$MeshFormat\n2.2 " in text and inner > 0 and f"$Elements\n{len(mesh.tetrahedra) + len(mesh.triangles) - inner}\n" in text
        with pytest.raises(ValueError):
            mesh.write(Path(folder) / "a.stl")
        with pytest.raises(ValueError):
            mesh.write(Path(folder) / "a.msh", gmsh_format="3")
        with pytest.raises(RuntimeError):
            mesh.write(Path(folder) / "none" / "a.vtu")
        with pytest.raises(pgdr.InputError):
            pgdr.read(Path(folder) / "missing.stl")


def test_meshio():
    meshio = pytest.importorskip("meshio")
    del meshio
    plc = pgdr.Plc(CORNERS, SIDES, markers=[1, 2, 2, 2, 2, 2], marker_names={1: "inlet"}, region_names={0: "water"})
    mesh = pgdr.mesh(plc, size=0.4)
    out = mesh.to_meshio()
    assert [block.type for block in out.cells] == ["tetra", "triangle"]
    assert list(out.field_data["inlet"]) == [1, 2] and list(out.field_data["water"]) == [0, 3]
    assert (out.cell_data["marker"][1] == mesh.markers).all()
    plc.marker_names = {1: "water", 2: "Water"}
    assert set(pgdr.mesh(plc, size=0.4).to_meshio().field_data) == {"water", "water_surface", "Water_surface_2"}


def test_coordinates_of_any_size():
    for scale in (1e200, 1e-200):
        mesh = pgdr.mesh(scale * CORNERS, SIDES, size=0.3 * scale)
        assert mesh.points.max() == scale
        assert mesh.statistics()["min_dihedral_deg"] > 5
        assert all(passed for _, passed, _ in mesh.check(pgdr.Plc(scale * CORNERS, SIDES)))
        with tempfile.TemporaryDirectory() as folder:
            mesh.write(Path(folder) / "a.vtu")
    small = pgdr.Plc(1e-200 * CORNERS, SIDES, nesting="alternate")
    with pytest.raises(pgdr.InputError, match="too different in size"):
        pgdr.assemble([small, pgdr.Plc(CORNERS, SIDES, nesting="alternate")])


def test_bent_polygons():
    corners = CORNERS.copy()
    corners[-1] += 0.1
    mesh = pgdr.mesh(corners, SIDES, size=0.4, triangulate=True)
    assert all(passed for _, passed, _ in mesh.check(pgdr.Plc(corners, SIDES)))


def test_errors():
    with pytest.raises(pgdr.InputError) as caught:
        pgdr.mesh(CORNERS, SIDES[:5])
    assert isinstance(caught.value, ValueError) and caught.value.problems[0]["kind"] == "open_surface"
    for arguments in ({"size": -1.0}, {"radius_edge_ratio": 1.5}, {"placement": "here"}, {"order": 3}, {"nesting": "both"}, {"facet_sizes": {5: 0.1}}):
        with pytest.raises(ValueError):
            pgdr.mesh(CORNERS, SIDES, **arguments)
    with pytest.raises(ValueError, match="the size at"):
        pgdr.mesh(CORNERS, SIDES, size=lambda x, y, z: x - 0.5)
    with pytest.raises(IndexError):
        pgdr.mesh(CORNERS, [[0, 1, 99]])
    with pytest.raises(ValueError):
        pgdr.mesh(CORNERS[:, :2], SIDES)
    for arguments in ({"size": "0.1"}, {"markers": [1.5] * 6}, {"regions": [(0.5, 0.5, 0.5)]}, {"facet_sizes": {0: "fine"}}):
        with pytest.raises(TypeError):
            pgdr.mesh(CORNERS, SIDES, **arguments)
    with pytest.raises(ValueError):
        pgdr.mesh(CORNERS, SIDES, tolerance=-1)
    with pytest.raises(TypeError):
        pgdr.mesh(CORNERS)


def test_what_a_function_raises_comes_out():
    def size(x, y, z):
        if x > 0.5:
            raise ZeroDivisionError("here")
        return 0.1

    with pytest.raises(ZeroDivisionError, match="here"):
        pgdr.mesh(CORNERS, SIDES, size=size)
    with pytest.raises(TypeError, match="number"):
        pgdr.mesh(CORNERS, SIDES, size=lambda x, y, z: "fine")

    def progress(phase, vertices, pending):
        raise KeyError(phase)

    with pytest.raises(KeyError):
        pgdr.mesh(CORNERS, SIDES, size=0.005, max_vertices=2_000_000, progress=progress)


def test_ctrl_c_and_limits():
    timer = threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        pgdr.mesh(CORNERS, SIDES, size=0.004, max_vertices=20_000_000)
    timer.join()
    mesh = pgdr.mesh(CORNERS, SIDES, size=0.01, max_vertices=5000)
    assert mesh.stop == "vertex_budget" and len(mesh.unrefined) > 0


def test_other_threads_go_on_meanwhile():
    steps = []
    running = threading.Event()
    running.set()

    def count():
        while running.is_set():
            steps.append(1)
            running.wait(0)

    other = threading.Thread(target=count)
    other.start()
    before = len(steps)
    pgdr.mesh(CORNERS, SIDES, size=0.05)
    running.clear()
    other.join()
    assert len(steps) > before + 10


def _in_child(queue):
    try:
        pgdr.mesh(CORNERS, SIDES, size=0.3)
        queue.put("meshed")
    except RuntimeError as error:
        queue.put(str(error))


def test_a_forked_child_is_told():
    context = multiprocessing.get_context("fork")
    queue = context.Queue()
    child = context.Process(target=_in_child, args=(queue,))
    child.start()
    assert "fork" in queue.get(timeout=60)
    child.join()


if __name__ == "__main__":
    sys.exit(pytest.main(["-q", "-p", "no:cacheprovider", __file__]))
