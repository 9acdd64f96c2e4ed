#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes a scan, repaired if need be, and draws what is behind a cut through its middle: the outside grey, tetrahedra by their smallest dihedral angle.

usage: scan_to_picture.py SCAN [PICTURE.png]      SCAN: .stl, .off, .ply or .obj. Needs Matplotlib: apt install python3-matplotlib
"""
import sys

import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

import pgdr

TOLERANCE = "1e-3d"  # of the diagonal: noise that the mesh need not follow
FACES = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]]  # of a tetrahedron, seen from outside counter-clockwise


def normals_of(triangles):
    normals = np.cross(triangles[..., 1, :] - triangles[..., 0, :], triangles[..., 2, :] - triangles[..., 0, :])
    return normals / np.linalg.norm(normals, axis=-1, keepdims=True)


scan = pgdr.read(sys.argv[1])
try:
    mesh = pgdr.mesh(scan, tolerance=TOLERANCE)
except pgdr.InputError as error:
    print(f"repaired, since {error}")
    mesh = pgdr.mesh(pgdr.repair(scan), tolerance=TOLERANCE)

# Behind the cut, across the shortest axis: those faces of tetrahedra that no two of them share.
low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
axis = np.argmin(high - low)
centroids = mesh.points[mesh.tetrahedra].mean(axis=1)
behind = mesh.tetrahedra[centroids[:, axis] > (low + high)[axis] / 2]
faces = behind[:, FACES].reshape(-1, 3)
_, first, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
shown = np.sort(first[count == 1])
triangles = mesh.points[faces[shown]]

# Dihedral angles are those between the normals of two faces, less 180 degrees.
normals = normals_of(mesh.points[behind[:, FACES]])
a, b = np.triu_indices(4, 1)
cosines = -np.einsum("tpk,tpk->tp", normals[:, a], normals[:, b])
angles = np.degrees(np.arccos(np.clip(cosines, -1, 1))).min(axis=1)
is_outside = (np.bincount(mesh.triangles.ravel(), minlength=len(mesh.points)) > 0)[faces[shown]].all(axis=1)
is_outside &= triangles.mean(axis=1)[:, axis] > (low + high)[axis] / 2

colours = plt.get_cmap("viridis")(angles[shown // 4] / 70)
colours[is_outside] = (0.8, 0.8, 0.8, 1)
light = np.roll([-0.8, 0.3, 0.5], axis)
colours[:, :3] *= 0.55 + 0.45 * np.clip(normals_of(triangles) @ light, 0, 1)[:, None]

figure = plt.figure(figsize=(8, 6))
view = figure.add_subplot(projection="3d", proj_type="ortho")
view.add_collection3d(Poly3DCollection(triangles, facecolors=colours, edgecolors=(0, 0, 0, 0.25), linewidths=0.2))
view.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
view.set_box_aspect(high - low, zoom=1.5)
view.view_init(*((15, 200), (15, -70), (-70, -90))[axis])
view.set_axis_off()
picture = sys.argv[2] if len(sys.argv) > 2 else "scan.png"
figure.savefig(picture, dpi=150, bbox_inches="tight")
print(f"{mesh}: smallest dihedral angle behind the cut {angles.min():.1f} degrees; see {picture}")
