#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Potential flow around a winged body in a box, with DOLFINx; writes flow.xdmf for ParaView.

usage: flow_box.py [FILE]      Needs DOLFINx 0.5, as Debian 12 has it: apt install python3-dolfinx python3-meshio python3-h5py
"""
import sys
import tempfile
from pathlib import Path

import meshio
import numpy as np
import ufl
from dolfinx import fem, io, mesh
from dolfinx.fem.petsc import LinearProblem
from mpi4py import MPI

import pgdr

BODY, INLET, OUTLET = 1, 11, 12  # markers of facets in the file

plc = pgdr.read(Path(__file__).parents[2] / "data/winged_body_in_box.poly")
flow = pgdr.mesh(plc, size=3.0, facet_sizes={BODY: 0.4}, gradation=0.3)

# The mesh, and the markers of its boundary triangles, by the files that DOLFINx reads.
with tempfile.TemporaryDirectory() as folder:
    meshio.Mesh(flow.points, [("tetra", flow.tetrahedra)]).write(f"{folder}/mesh.xdmf")
    meshio.Mesh(flow.points, [("triangle", flow.triangles)], cell_data={"marker": [flow.markers]}).write(f"{folder}/facets.xdmf")
    with io.XDMFFile(MPI.COMM_SELF, f"{folder}/mesh.xdmf", "r") as file:
        domain = file.read_mesh(name="Grid")
    domain.topology.create_connectivity(2, 3)
    with io.XDMFFile(MPI.COMM_SELF, f"{folder}/facets.xdmf", "r") as file:
        facets = file.read_meshtags(domain, name="Grid")

# The potential is x far upstream and downstream; nothing flows through the body, nor through the other sides of the box.
space = fem.FunctionSpace(domain, ("Lagrange", 1))
far = fem.Function(space)
far.interpolate(lambda x: x[0])
ends = np.concatenate([facets.find(INLET), facets.find(OUTLET)])
fixed = fem.dirichletbc(far, fem.locate_dofs_topological(space, 2, ends))
u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
load = fem.Constant(domain, 0.0) * v * ufl.dx
solver = {"ksp_type": "cg", "pc_type": "gamg", "ksp_rtol": 1e-10}
potential = LinearProblem(ufl.inner(ufl.grad(u), ufl.grad(v)) * ufl.dx, load, bcs=[fixed], petsc_options=solver).solve()

velocity = fem.Function(fem.VectorFunctionSpace(domain, ("Discontinuous Lagrange", 0)))
velocity.interpolate(fem.Expression(ufl.grad(potential), velocity.function_space.element.interpolation_points()))
speed = np.linalg.norm(velocity.x.array.reshape(-1, 3), axis=1)
with io.XDMFFile(domain.comm, sys.argv[1] if len(sys.argv) > 1 else "flow.xdmf", "w") as file:
    file.write_mesh(domain)
    file.write_function(velocity)
print(f"{flow}: speeds from {speed.min():.3f} to {speed.max():.3f}, of {len(facets.find(BODY))} triangles on the body")
