#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes a ball in a box and solves -div(k grad u) = 1 with linear elements, u = 0 on the box; writes poisson.vtu for ParaView.

usage: poisson.py [FILE]      Needs NumPy, SciPy and meshio: apt install python3-scipy python3-meshio
"""
import sys

import numpy as np
import scipy.sparse as sparse
import scipy.sparse.linalg
from scipy.spatial import ConvexHull

import pgdr

BOX, BALL = 1, 2  # markers of facets, and ids of regions

# Points of a box and, around its middle, of a ball; the facets of both.
box = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
step = np.arange(80) + 0.5
polar, turn = np.arccos(1 - 2 * step / 80), np.pi * (1 + 5**0.5) * step
ball = 0.5 + 0.25 * np.stack([np.cos(turn) * np.sin(polar), np.sin(turn) * np.sin(polar), np.cos(polar)], axis=1)
triangles = [list(t + len(box)) for t in ConvexHull(ball).simplices]

mesh = pgdr.mesh(
    np.vstack([box, ball]),
    sides + triangles,
    markers=[BOX] * len(sides) + [BALL] * len(triangles),
    regions=[((0.01, 0.01, 0.01), BOX), ((0.5, 0.5, 0.5), BALL)],
    size=lambda x, y, z: 0.04 + 0.1 * abs(((x - 0.5) ** 2 + (y - 0.5) ** 2 + (z - 0.5) ** 2) ** 0.5 - 0.25),
)

# Gradients of the four shape functions of each tetrahedron, and what they come to.
p = mesh.points[mesh.tetrahedra]
volume = mesh.volumes()
gradients = np.linalg.inv(np.concatenate([np.ones((len(p), 4, 1)), p], axis=2))[:, 1:, :].transpose(0, 2, 1)
k = np.where(mesh.regions == BALL, 10.0, 1.0)
local = np.einsum("t,tik,tjk->tij", k * volume, gradients, gradients)
rows, columns = (np.repeat(mesh.tetrahedra, 4, axis=1), np.tile(mesh.tetrahedra, (1, 4)))
n = len(mesh.points)
stiffness = sparse.csr_matrix((local.ravel(), (rows.ravel(), columns.ravel())), shape=(n, n))
load = np.bincount(mesh.tetrahedra.ravel().astype(np.int64), weights=np.repeat(volume / 4, 4), minlength=n)

free = np.setdiff1d(np.arange(n), mesh.triangles[mesh.markers == BOX])
u = np.zeros(n)
u[free] = scipy.sparse.linalg.spsolve(stiffness[free][:, free].tocsc(), load[free])

out = mesh.to_meshio()
out.point_data["u"] = u
out.write(sys.argv[1] if len(sys.argv) > 1 else "poisson.vtu")
print(f"{mesh}: largest u {u.max():.4f}")
