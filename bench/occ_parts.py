# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes random CAD parts with OpenCASCADE, tessellated as CAD programs do it, for `bench/models.py`.

Run it by FreeCAD (Debian: `freecad-python3`), which has no arguments for scripts:
    PARTS=DIR COUNT=160 freecadcmd bench/occ_parts.py       FIRST=160 for the next ones
Part k of any run is `DIR/occ_kkk.stl`, a function of k alone (and of OpenCASCADE's version): one to six solids united or cut, up to four
bores, fillets and chamfers on random edges, a deflection of 0.02 to 0.5 at a size of about 30; a third of them turned.
"""
import math
import os
import random
from pathlib import Path

import FreeCAD
import MeshPart
import Part
from FreeCAD import Vector

MOST_TRIANGLES = 60000


def polygon_face(points):
    return Part.Face(Part.makePolygon(points + [points[0]]))


def solid(rng, on_grid):
    def length(low, high):
        return max(1, round(rng.uniform(low, high))) if on_grid else rng.uniform(low, high)

    kind = rng.choice(["box", "cylinder", "cylinder", "cone", "sphere", "torus", "prism", "loft", "turned"])
    if kind == "box":
        shape = Part.makeBox(length(4, 30), length(4, 20), length(2, 15))
        shape.translate(Vector(-10, -8, -5))
        return shape
    if kind == "cylinder":
        radius, height = length(2, 9), length(3, 25)
        return Part.makeCylinder(radius, height, Vector(0, 0, -8), rng.choice([Vector(0, 0, 1), Vector(1, 0, 0), Vector(0, 1, 0)]))
    if kind == "cone":
        return Part.makeCone(length(2, 9), length(1, 5) + 0.37, length(3, 20))
    if kind == "sphere":
        return Part.makeSphere(length(3, 9))
    if kind == "torus":
        return Part.makeTorus(length(5, 10), length(1, 3))
    if kind == "prism":
        n = rng.randint(3, 8)
        corners = [Vector(length(3, 12) * math.cos(2 * math.pi * k / n), length(3, 12) * math.sin(2 * math.pi * k / n), 0) for k in range(n)]
        return polygon_face(corners).extrude(Vector(0, 0, length(2, 12)))
    if kind == "loft":
        square = Part.makePolygon([Vector(-5, -5, 0), Vector(5, -5, 0), Vector(5, 5, 0), Vector(-5, 5, 0), Vector(-5, -5, 0)])
        return Part.makeLoft([square, Part.Wire(Part.makeCircle(length(1, 4), Vector(0, 0, length(5, 12))))], True)
    h = length(4, 12)
    profile = [Vector(2, 0, 0), Vector(length(4, 9), 0, 0), Vector(length(3, 8), 0, h / 2), Vector(length(3, 9), 0, h), Vector(2, 0, h)]
    return polygon_face(profile).revolve(Vector(0, 0, 0), Vector(0, 0, 1), 360)


def largest_solid(shape, otherwise):
    return max(shape.Solids, key=lambda s: s.Volume) if shape.Solids and shape.isValid() else otherwise


def moved(shape, rng, on_grid):
    def coordinate(most):
        x = rng.uniform(-most, most)
        return round(x) if on_grid else x

    shape = shape.copy()
    shape.translate(Vector(coordinate(15), coordinate(10), coordinate(8)))
    if rng.random() < 0.3:
        shape.rotate(Vector(0, 0, 0), Vector(rng.random(), rng.random(), rng.random()), rng.uniform(0, 90))
    return shape


def rounded(shape, rng):
    """With a fillet or a chamfer on a few edges, where OpenCASCADE can make one."""
    edges = rng.sample(shape.Edges, min(len(shape.Edges), rng.randint(1, 4)))
    try:
        if rng.random() < 0.6:
            return largest_solid(shape.makeFillet(rng.choice([0.2, 0.5, 1, 2]), edges), shape)
        return largest_solid(shape.makeChamfer(rng.choice([0.2, 0.5, 1]), edges), shape)
    except Exception:  # whatever OpenCASCADE throws
        return shape


def part(number):
    rng = random.Random(number)
    on_grid = rng.random() < 0.6
    shape = solid(rng, on_grid)
    for _ in range(rng.randint(1, 5)):
        other = moved(solid(rng, on_grid), rng, on_grid)
        shape = largest_solid(shape.fuse(other) if rng.random() < 0.6 else shape.cut(other), shape)
    for _ in range(rng.randint(0, 4)):
        axis = rng.choice([Vector(0, 0, 1), Vector(1, 0, 0), Vector(0, 1, 0)])
        center = Vector(rng.uniform(-12, 12), rng.uniform(-8, 8), rng.uniform(-6, 6))
        shape = largest_solid(shape.cut(Part.makeCylinder(rng.choice([0.5, 1, 1.5, 2, 3.2]), 80, center - axis * 40, axis)), shape)
    shape = largest_solid(shape.removeSplitter(), shape)
    for _ in range(rng.randint(0, 4)):
        shape = rounded(shape, rng)
    mesh = MeshPart.meshFromShape(
        Shape=shape, LinearDeflection=rng.choice([0.5, 0.1, 0.1, 0.02]), AngularDeflection=rng.choice([0.1, 0.3, 0.5]), Relative=False)
    if rng.random() < 0.3:
        turn = FreeCAD.Matrix()
        turn.rotateX(rng.uniform(0, 3))
        turn.rotateZ(rng.uniform(0, 3))
        mesh.transform(turn)
    return mesh


def main():
    folder = Path(os.environ["PARTS"])
    folder.mkdir(parents=True, exist_ok=True)
    first = int(os.environ.get("FIRST", "0"))
    for number in range(first, first + int(os.environ.get("COUNT", "160"))):
        try:
            mesh = part(number)
        except Exception as e:  # whatever OpenCASCADE throws
            print(f"{number}: {e}", flush=True)
            continue
        if 4 < mesh.CountFacets <= MOST_TRIANGLES:
            mesh.write(str(folder / f"occ_{number:03d}.stl"))
        print(f"{number}: {mesh.CountFacets} triangles", flush=True)


main()
