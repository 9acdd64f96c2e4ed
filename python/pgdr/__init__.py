# SPDX-License-Identifier: GPL-3.0-or-later
"""Tetrahedral meshes of piecewise linear complexes: Delaunay, with a bounded radius-edge ratio, the same for every number of threads.

>>> import numpy, pgdr
>>> points = numpy.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
>>> facets = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
>>> cube = pgdr.mesh(points, facets, size=0.2)
>>> bool(abs(cube.volumes().sum() - 1) < 1e-12)
True

Meshing runs without Python's global lock, on all cores unless `threads` says otherwise, and ends at Ctrl-C. It does not work in a child of
fork(): use the start method "spawn" of multiprocessing.
"""
from __future__ import annotations

import operator
import os
from typing import Any, Callable, Iterable, Mapping, Sequence

import numpy as np

from . import _pgdr
from ._pgdr import Grid, InputError, Nodes, __version__

__all__ = ["Grid", "InputError", "Mesh", "Nodes", "Plc", "assemble", "mesh", "read", "repair", "__version__"]

Size = "None | float | Callable[[float, float, float], float] | Grid | Nodes"


class Plc(_pgdr.Plc):
    """A piecewise linear complex: what is meshed.

    Parameters
    ----------
    points : array of shape (n, 3)
    facets : array of shape (m, k), or a sequence of sequences of indices into `points`
        Plane polygons, which meet in common points and edges only. Closed surfaces of several bodies, and facets inside, may be among them.
    markers : sequence of m ints, optional
        What the triangles on each facet have as `Mesh.markers`; 0 unless given. Facets with different ones are never fused.
    regions : sequence of (point, id) or (point, id, size), optional
        The volume around a point gets `id` in `Mesh.regions`, and an upper bound of circumradii.
    holes : array of shape (h, 3), optional
        The volumes around these points are not meshed.
    nesting : "fill" or "alternate"
        Whether all that is enclosed is meshed, or shells are material and void in turn, from the outside.
    marker_names, region_names : dictionaries from ints to names, optional

    Raises
    ------
    IndexError, ValueError
        For indices and shapes that make no sense. What is wrong with the geometry is found by `mesh`.
    """

    def __init__(
        self,
        points: Any,
        facets: Any,
        *,
        markers: Sequence[int] | None = None,
        regions: Iterable[tuple] | None = None,
        holes: Any | None = None,
        nesting: str = "fill",
        marker_names: Mapping[int, str] | None = None,
        region_names: Mapping[int, str] | None = None,
    ) -> None:
        super().__init__(
            points,
            facets,
            markers=markers if markers is None else [operator.index(m) for m in markers],
            regions=regions,
            holes=None if holes is None else np.atleast_2d(np.asarray(holes, dtype=float)),
            nesting=nesting,
            marker_names=dict(marker_names or {}),
            region_names=dict(region_names or {}),
        )


class Mesh:
    """A tetrahedral mesh. Arrays are read-only views of memory that the mesh owns; indices count from 0."""

    def __init__(self, raw: _pgdr.RawMesh, radius_edge_ratio: float, coplanar_tolerance: float, triangulate: bool) -> None:
        self._raw = raw
        self._how = radius_edge_ratio, coplanar_tolerance, triangulate

    @property
    def points(self) -> np.ndarray:
        """Coordinates, shape (n, 3)."""
        return self._raw.points

    @property
    def tetrahedra(self) -> np.ndarray:
        """Indices of points, shape (m, 4), positively oriented."""
        return self._raw.tetrahedra

    @property
    def regions(self) -> np.ndarray:
        """The region id of each tetrahedron, shape (m,)."""
        return self._raw.regions

    @property
    def triangles(self) -> np.ndarray:
        """The triangles on facets, shape (t, 3), oriented outwards."""
        return self._raw.triangles

    @property
    def markers(self) -> np.ndarray:
        """The marker of each triangle, shape (t,)."""
        return self._raw.markers

    @property
    def edges(self) -> np.ndarray:
        """The edges on segments, shape (e, 2)."""
        return self._raw.edges

    @property
    def point_dimensions(self) -> np.ndarray:
        """0 for corners of the input, 1, 2 and 3 for points on its segments, on its facets and inside, shape (n,)."""
        return self._raw.point_dimensions

    @property
    def exempt(self) -> np.ndarray:
        """Tetrahedra above the bound on the radius-edge ratio, next to small angles of the input."""
        return self._raw.exempt

    @property
    def unrefined(self) -> np.ndarray:
        """Tetrahedra above a bound that a limit kept from being refined."""
        return self._raw.unrefined

    @property
    def tetrahedron_nodes(self) -> np.ndarray:
        """In a mesh of order 2 the points in the middle of edges 01, 12, 20, 03, 13, 23, shape (m, 6)."""
        return self._raw.tetrahedron_nodes

    @property
    def triangle_nodes(self) -> np.ndarray:
        """In a mesh of order 2 the points in the middle of edges 01, 12, 20, shape (t, 3)."""
        return self._raw.triangle_nodes

    @property
    def marker_names(self) -> dict[int, str]:
        return self._raw.marker_names

    @property
    def region_names(self) -> dict[int, str]:
        return self._raw.region_names

    @property
    def stop(self) -> str:
        """Why the refinement ended: "finished", "vertex_budget", "min_edge_length", "memory_limit" or "time_limit"."""
        return self._raw.stop

    @property
    def message(self) -> str:
        """What a limit has left undone, in a sentence; empty where nothing."""
        return self._raw.message

    @property
    def missing_pieces(self) -> int:
        """Pieces of the input that are not in the mesh; 0 unless a limit ended it early."""
        return self._raw.missing

    def __repr__(self) -> str:
        return f"<pgdr.Mesh of {len(self.points):,} points, {len(self.tetrahedra):,} tetrahedra>"

    def volumes(self) -> np.ndarray:
        """The volume of each tetrahedron, shape (m,)."""
        a, b, c, d = (self.points[self.tetrahedra[:, i]] for i in range(4))
        return np.einsum("ij,ij->i", b - a, np.cross(c - a, d - a)) / 6

    def statistics(self) -> dict[str, Any]:
        """Counts, volumes by region, worst ratio and angles, and a checksum that is equal for equal meshes."""
        return self._raw.statistics()

    def check(self, plc: _pgdr.Plc | None = None) -> list[tuple[str, bool, str]]:
        """Verifies the mesh, property by property, by code that shares nothing with what made it.

        With a `plc`, also that the mesh conforms to it; it must be what was meshed, without a tolerance.
        Returns (property, whether it holds, figures) for each.
        """
        return self._raw.check(plc, *self._how)

    def write(self, path: str | os.PathLike, *, vtu_triangles: bool = False, gmsh_format: str = "4.1", outer_triangles: bool = False) -> None:
        """Writes a file in the format of its extension: .vtu, .vtk, .mesh (Medit), .msh (Gmsh), .inp (Abaqus), .su2 or .ele (TetGen).

        `vtu_triangles`: triangles in .vtu files, too. `gmsh_format`: of .msh files, "4.1" (binary), "4.1-ascii" or "2.2". `outer_triangles`: none between
        regions nor inside them, which deal.II and SU2 refuse.

        Raises ValueError for other extensions and formats, RuntimeError where the file cannot be written.
        """
        self._raw.write(os.fspath(path), vtu_triangles, gmsh_format, outer_triangles)

    def to_meshio(self) -> Any:
        """As a `meshio.Mesh` with blocks of tetrahedra and triangles, cell data "region" and "marker", and the names as field data."""
        import meshio

        def block(corners: np.ndarray, nodes: np.ndarray, name: str) -> tuple[str, np.ndarray]:
            return (name, corners) if len(nodes) == 0 else (f"{name}{'10' if name == 'tetra' else '6'}", np.hstack([corners, nodes]))

        none_t, none_f = np.zeros(len(self.tetrahedra), dtype=np.int32), np.zeros(len(self.triangles), dtype=np.int32)
        markers, regions = self._raw.distinct_names
        names = {name: np.array([number, dimension]) for numbers, dimension in ((markers, 2), (regions, 3)) for number, name in numbers.items()}
        return meshio.Mesh(
            self.points,
            [block(self.tetrahedra, self.tetrahedron_nodes, "tetra"), block(self.triangles, self.triangle_nodes, "triangle")],
            cell_data={"region": [self.regions, none_f], "marker": [none_t, self.markers]},
            field_data=names,
        )

    def to_pyvista(self) -> Any:
        """As a `pyvista.UnstructuredGrid` of the tetrahedra, with cell data "region"."""
        import pyvista

        second_order = len(self.tetrahedron_nodes) > 0
        cells = np.hstack([self.tetrahedra, self.tetrahedron_nodes]) if second_order else self.tetrahedra
        grid = pyvista.UnstructuredGrid({24 if second_order else 10: cells.astype(np.int64)}, self.points)
        grid.cell_data["region"] = self.regions
        return grid


def _tolerance(plc: _pgdr.Plc, tolerance: float | str | None) -> float:
    """In units of length: a number, a part of the diagonal like "1e-4d", or what the program does."""
    if not isinstance(tolerance, str) and tolerance is not None and not 0 <= tolerance < float("inf"):
        raise ValueError("a tolerance has to be at least 0")
    if tolerance is None:
        return 1e-6 * plc.diagonal if plc.is_surface else 0.0
    if isinstance(tolerance, str):
        return float(tolerance[:-1]) * plc.diagonal if tolerance.endswith(("d", "D")) else float(tolerance)
    return float(tolerance)


def mesh(
    points: Any,
    facets: Any = None,
    *,
    size: Size = None,
    facet_sizes: Mapping[int | str, float] | None = None,
    curvature: float | None = None,
    cells_across: float | None = None,
    gradation: float = 0.5,
    markers: Sequence[int] | None = None,
    regions: Iterable[tuple] | None = None,
    holes: Any | None = None,
    nesting: str = "fill",
    radius_edge_ratio: float = 2.0,
    min_dihedral: float = 12.0,
    optimize: int = 0,
    placement: str = "lazy",
    tolerance: float | str | None = None,
    coplanar_tolerance: float = 1e-6,
    triangulate: bool = False,
    order: int = 1,
    min_edge_length: float = 0.0,
    max_vertices: int = 0,
    max_memory: int = 0,
    time_limit: float = 0.0,
    threads: int = 0,
    progress: Callable[[str, int, int], Any] | None = None,
) -> Mesh:
    """Meshes a piecewise linear complex.

    Parameters
    ----------
    points, facets, markers, regions, holes, nesting
        As of `Plc`; or a `Plc`, as `read` gives it, in place of `points` and alone.
    size : None, float, function of (x, y, z), Grid or Nodes
        Upper bound of the circumradius of every tetrahedron, by its circumcenter. A function is called from several threads, one call at a time;
        it must return the same for the same point. None: as coarse as the shape allows.
    facet_sizes : dictionary from markers, or their names, to floats
        Upper bounds of the circumradius on facets; away from them the bound grows by `gradation` for each unit of distance.
    curvature : float
        So many edges around a full turn of a curved surface, which facets that meet at less than 40 degrees stand for; away from it the bound grows, too.
    cells_across : float
        So many edges across walls and whatever else is narrow, between facets of a region that face each other; away from it the bound grows, too.
    radius_edge_ratio : float, at least 2
        Upper bound of circumradius over shortest edge.
    min_dihedral : float
        No smaller dihedral angle, in degrees, as far as that gets; 0: do nothing for it.
    optimize : int
        Rounds in which vertices move to make tetrahedra better on average.
    placement : "lazy", "circumcenter", "type1" or "type2"
        Where new points go.
    tolerance : float, or a str like "1e-4d" for a part of the bounding box's diagonal
        How far the boundary may be changed to rid it of needles and steps. None: 1e-6 of the diagonal with nesting "alternate", which is what `read`
        gives for surface files, else 0.
    coplanar_tolerance : float
        Adjacent facets this close to one plane, relative to the diagonal, are fused.
    triangulate : bool
        Take polygons that are not plane as triangles.
    order : 1 or 2
        2: a node in the middle of each edge.
    min_edge_length, max_vertices, max_memory (bytes), time_limit (seconds)
        Limits; `Mesh.stop` tells which one ended the refinement. 0: none; of memory, nine tenths of what is free.
    threads : int
        0: one for each core. The mesh is the same for every number.
    progress : function of (phase, vertices, pending)
        Called about twenty times a second, as far as there is news. What it raises ends the refinement.

    Raises
    ------
    InputError
        For input that cannot be meshed; it has a list `problems`.
    ValueError
        For parameters and sizes that make no sense.
    KeyboardInterrupt
        At Ctrl-C, and whatever `size` or `progress` raise.
    """
    if isinstance(points, _pgdr.Plc):
        if facets is not None or markers is not None or regions is not None or holes is not None:
            raise TypeError("a Plc brings its own facets, markers, regions and holes")
        plc = points
    else:
        if facets is None:
            raise TypeError("mesh() needs facets, or a Plc")
        plc = Plc(points, facets, markers=markers, regions=regions, holes=holes, nesting=nesting)
    if order not in (1, 2):
        raise ValueError("order has to be 1 or 2")
    raw = _pgdr.mesh(
        plc,
        size=size,
        facet_sizes=None if facet_sizes is None else dict(facet_sizes),
        curvature=curvature,
        cells_across=cells_across,
        gradation=gradation,
        radius_edge_ratio=radius_edge_ratio,
        min_dihedral=min_dihedral,
        optimize=optimize,
        placement=placement,
        tolerance=_tolerance(plc, tolerance),
        coplanar_tolerance=coplanar_tolerance,
        triangulate=triangulate,
        min_edge_length=min_edge_length,
        max_vertices=max_vertices,
        max_memory=max_memory,
        time_limit=time_limit,
        threads=threads,
        progress=progress,
    )
    if order == 2:
        raw.add_midside_nodes()
    return Mesh(raw, radius_edge_ratio, coplanar_tolerance, triangulate)


def read(path: str | os.PathLike, *, markers_from: str = "names") -> Plc:
    """Reads a .poly, .smesh, .off, .stl, .ply or .obj file, or a mesh to be refined further: .mesh, .vtu or .msh.

    `markers_from` says what in a surface file becomes markers: "names" (of solids, groups and materials), "colors" (of faces) or "nothing".
    Raises InputError, whose message has the line.
    """
    return _pgdr.read(os.fspath(path), markers_from=markers_from)


def repair(plc: _pgdr.Plc, *, tolerance: float | str = "1e-6d", largest_hole: float | str = "0.5d") -> Plc:
    """A valid complex of a surface that has duplicates, cracks, holes, wrong orientations or intersections; see `pgdr mesh --repair`.

    Raises InputError for what cannot be repaired.
    """
    return _pgdr.repair(plc, tolerance=_tolerance(plc, tolerance), largest_hole=_tolerance(plc, largest_hole))


def assemble(parts: Sequence[_pgdr.Plc], *, tolerance: float | str = "1e-6d", largest_hole: float | str = 0.0) -> Plc:
    """One complex of several bodies, a region each, numbered from 1 and called as they are; where they overlap, the later one has it.

    Parts of the diagonal are those of the largest body.
    """
    largest = max(parts, key=lambda part: part.diagonal)
    return _pgdr.assemble(list(parts), tolerance=_tolerance(largest, tolerance), largest_hole=_tolerance(largest, largest_hole))
