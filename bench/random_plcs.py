#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes small random PLCs that are hard on a mesher, by quality alone, and checks the meshes.

Wedges from half a degree, fans of facets on one edge, needles, slits, spikes, crumpled bodies, facets that meet in a vertex only,
dented hulls of random points, balls with regular folds, blocks with a top that is not quite flat, curved tops of fused strips of needles,
bodies that nearly touch, terraces that are nearly flat; from 1,000,000 on beams: profiles of U, L, T and others, whose walls have cocircular corners;
from 2,000,000 on stacks: prisms on each other, with narrow gaps between them.
Some of them turned, moved, scaled from 1e-6 to 1e6. Each is made from its number alone. Prints a table by kind in Markdown, and the numbers of those that
did not end with a mesh that passes; `--keep FOLDER` writes these as .poly files, without the facets that the failure does not need.
`--min-dihedral A`: dihedral angles below A degrees fail, too, but for those that the input's angles explain.

usage: bench/random_plcs.py [--first N] [--count N] [--kinds KIND,...] [--min-dihedral A] [--pgdr PROGRAM] [--limit SECONDS] [--keep FOLDER]
Needs: cmake --build build/release --target pgdr-app.
"""

import argparse
import collections
import math
import random
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from measure import ROOT, attempt, table

KINDS = ("wedge", "fan", "needle", "slit", "spike", "star", "pair", "hull", "ball", "bent", "strip", "touch", "terrace")
FIRST_BEAM, FIRST_STACK = 1000000, 2000000  # numbers below keep their kinds, which docs and tests name


def _box_faces(facets, first):
    """Those of a box whose corner i, from `first` on, is at the upper end of axis k if bit k of i is set."""
    for face in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)):
        facets.append([first + i for i in face])


def _box(points, facets, half):
    first = len(points)
    for i in range(8):
        points.append(tuple(half * (1 if i >> k & 1 else -1) for k in range(3)))
    _box_faces(facets, first)


def _angle(rng, low, high):
    """Between low and high degrees, small ones as often as large ones; in radians."""
    return math.radians(low * (high / low) ** rng.random())


def _wedge(rng, points, facets):
    """A prism over a triangle with a small angle, its ends slanted."""
    phi = _angle(rng, 0.5, 90)
    a, b, height = rng.uniform(0.5, 2), rng.uniform(0.5, 2), rng.uniform(0.3, 3)
    for end in (0, height):
        for x, y in ((0, 0), (a, 0), (b * math.cos(phi), b * math.sin(phi))):
            points.append((x, y, end + rng.uniform(-0.1, 0.1) * height))
    facets += [[0, 1, 2], [3, 4, 5], [0, 1, 4, 3], [1, 2, 5, 4], [2, 0, 3, 5]]


def _fan(rng, points, facets):
    """Two to eight facets on one edge, inside a box."""
    count = rng.randint(2, 8)
    gap = _angle(rng, 0.5, 40)
    points += [(0, 0, -0.4), (0, 0, rng.uniform(0.1, 0.5))]
    angle = 0
    for _ in range(count):
        x, y = math.cos(angle), math.sin(angle)
        first = len(points)
        r = rng.uniform(0.2, 0.8)
        points.append((r * x, r * y, rng.uniform(-0.6, 0.6)))
        if rng.random() < 0.5:
            facets.append([0, 1, first])
        else:
            points[first] = (r * x, r * y, rng.uniform(-0.6, -0.1))
            s = rng.uniform(0.2, 0.8)
            points.append((s * x, s * y, rng.uniform(0, 0.6)))
            facets.append([0, first, first + 1, 1])
        angle += gap * rng.uniform(1, 1.5)
        if angle > math.radians(340):
            break
    _box(points, facets, 1)


def _needle(rng, points, facets):
    """A tetrahedron with corners of fractions of a degree."""
    phi = _angle(rng, 0.1, 20)
    length = rng.uniform(0.5, 2)
    points += [(0, 0, 0), (length, 0, 0), (rng.uniform(0.3, 1) * length, length * math.tan(phi), 0),
               (rng.uniform(0.2, 1) * length, rng.uniform(-1, 1) * length * math.tan(_angle(rng, 0.5, 30)),
                length * math.tan(_angle(rng, 1, 60)))]
    facets += [[0, 1, 2], [0, 1, 3], [1, 2, 3], [2, 0, 3]]


def _slit(rng, points, facets):
    """Two facets with a narrow gap between them, inside a box; not quite parallel."""
    gap = 10 ** rng.uniform(-1.5, -0.5)
    tilt = rng.uniform(0, 0.5) * gap
    for z in (0, gap):
        first = len(points)
        dx, dy = rng.uniform(-0.2, 0.2), rng.uniform(-0.2, 0.2)
        for x, y in ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)):
            points.append((x + dx, y + dy, z + (tilt * x if z else 0)))
        facets.append([first, first + 1, first + 2, first + 3])
    _box(points, facets, 1)


def _spike(rng, points, facets):
    """A pyramid with a tip of a few degrees, alone or inside a box."""
    sides = rng.randint(3, 10)
    radius = math.tan(_angle(rng, 1, 30))
    points.append((rng.uniform(-0.3, 0.3) * radius, rng.uniform(-0.3, 0.3) * radius, 1))
    for i in range(sides):
        turn = 2 * math.pi * (i + rng.uniform(0, 0.5)) / sides
        points.append((radius * math.cos(turn), radius * math.sin(turn), 0))
    for i in range(sides):
        facets.append([0, 1 + i, 1 + (i + 1) % sides])
    facets.append(list(range(1, sides + 1)))
    if rng.random() < 0.5:
        _box(points, facets, 1.5)


def _star(rng, points, facets):
    """A polyhedron like a crumpled icosahedron in a box."""
    golden = (1 + math.sqrt(5)) / 2
    corners = [(s, t * golden, 0) for s in (-1, 1) for t in (-1, 1)]
    corners = [c[k:] + c[:k] for k in range(3) for c in corners]
    for c in corners:
        r = 10 ** rng.uniform(-1, 0) / math.sqrt(1 + golden * golden)
        points.append(tuple(r * x for x in c))
    for i in range(12):
        for j in range(i + 1, 12):
            for k in range(j + 1, 12):
                if all(abs(math.dist(corners[a], corners[b]) - 2) < 1e-9 for a, b in ((i, j), (j, k), (i, k))):
                    facets.append([i, j, k])
    _box(points, facets, 1.2)


def _pair(rng, points, facets):
    """Two triangles that meet in one vertex, one close above the other, in a box."""
    phi = _angle(rng, 0.5, 30)
    points.append((0, 0, 0))
    for k in range(2):
        first = len(points)
        turn = rng.uniform(-0.5, 0.5)
        for offset in (turn, turn + rng.uniform(0.3, 2)):
            r = rng.uniform(0.2, 0.8)
            points.append((r * math.cos(offset), r * math.sin(offset), k * r * math.tan(phi)))
        facets.append([0, first, first + 1])
    _box(points, facets, 1)


def _hull(rng, points, facets):
    """Up to three hulls of random points, one triangle of some dented, inside a box."""
    for cell in rng.sample(range(8), rng.randint(1, 3)):
        corner = [-0.5 if cell >> k & 1 else 0.5 for k in range(3)]
        cloud = [tuple(c + rng.uniform(-0.45, 0.45) for c in corner) for _ in range(rng.randint(4, 14))]
        hull = []
        for i in range(len(cloud)):
            for j in range(i + 1, len(cloud)):
                for k in range(j + 1, len(cloud)):
                    sides = [_side(cloud[i], cloud[j], cloud[k], p) for m, p in enumerate(cloud) if m not in (i, j, k)]
                    if min(sides) > 0 or max(sides) < 0:
                        hull.append((i, j, k))
        first = len(points)
        points += cloud
        corners = {i for f in hull for i in f}
        middle = tuple(sum(cloud[i][c] for i in corners) / len(corners) for c in range(3))
        dented = rng.choice(hull) if rng.random() < 0.5 else None
        for f in hull:
            if f != dented:
                facets.append([first + i for i in f])
                continue
            t = rng.uniform(0.05, 0.9)
            points.append(tuple(t * middle[c] + (1 - t) * sum(cloud[i][c] for i in f) / 3 for c in range(3)))
            facets += [[first + f[i], first + f[(i + 1) % 3], len(points) - 1] for i in range(3)]
    _box(points, facets, 1)


def _ball(rng, points, facets):
    """A ball of triangles, every other vertex pulled towards the center: symmetric, with many like distances."""
    around, along = 2 * rng.randint(3, 10), rng.randint(4, 10)
    pull = rng.uniform(0, 0.6)
    points += [(0, 0, -1), (0, 0, 1)]
    for i in range(1, along):
        for j in range(around):
            a, b = math.pi * i / along, 2 * math.pi * (j + i / 2) / around
            r = 1 - pull * ((i + j) % 2)
            points.append((r * math.sin(a) * math.cos(b), r * math.sin(a) * math.sin(b), -r * math.cos(a)))
    for j in range(around):
        ring = [[2 + i * around + (j + k) % around for k in range(2)] for i in range(along - 1)]
        facets += [[0, ring[0][1], ring[0][0]], [1, ring[-1][0], ring[-1][1]]]
        for (a, b), (c, d) in zip(ring, ring[1:]):
            facets += [[a, b, c], [b, d, c]]


def _bent(rng, points, facets):
    """A block whose top is of narrow triangles that are fused, though none lies quite in their plane, perhaps with a facet close below."""
    turns = sorted(rng.uniform(0, 2 * math.pi) for _ in range(rng.randint(4, 40)))
    turns = [t for t, after in zip(turns, turns[1:] + [turns[0] + 2 * math.pi]) if after - t > 0.01]
    n, height, bump = len(turns), 10 ** rng.uniform(-1.5, 0.5), 10 ** rng.uniform(-9, -5.7)
    for top in (False, True):
        for t in turns:
            points.append((math.cos(t), math.sin(t), height + rng.uniform(-bump, bump) if top else 0))
    hub = [rng.random() ** 3 for _ in turns]
    points.append(tuple(sum(h * p[c] for h, p in zip(hub, points[n:])) / sum(hub) for c in range(2)) + (height,))
    for i in range(n):
        j = (i + 1) % n
        facets += [[2 * n, n + i, n + j], [i, j, n + j, n + i]]
    facets.append(list(range(n)))
    if rng.random() < 0.5:
        slope = math.tan(_angle(rng, 0.5, 30))
        for k in range(2):
            corner = points[n + (n // 2 + k) % n]
            r = rng.uniform(0.3, 0.8)
            x, y = (r * (corner[c] - points[2 * n][c]) for c in range(2))
            points.append((points[2 * n][0] + x, points[2 * n][1] + y, height - min(0.5 * height, slope * math.hypot(x, y))))
        facets.append([2 * n, 2 * n + 1, 2 * n + 2])


def _bar(points, facets, front, back, height):
    """What a top with these ends, at y = 0 and y = 1, needs to be a block: both ends, two sides and the bottom."""
    first = len(points)
    for i in (front[0], back[0], back[-1], front[-1]):
        points.append((points[i][0], points[i][1], -height))
    a, b, c, d = range(first, first + 4)
    facets += [front + [d, a], back + [c, b], [front[0], a, b, back[0]], [front[-1], d, c, back[-1]], [a, b, c, d]]


def _strip(rng, points, facets):
    """A bar with a curved top as programs draw it: strips, each of needles that are fused, though they do not lie quite in one plane."""
    n, bend, noise = rng.randint(3, 9), rng.uniform(0, 0.4), 10 ** rng.uniform(-10, -6)
    widths = [10 ** rng.uniform(-3.5, -0.5) for _ in range(n)]
    at = [sum(widths[:i]) / sum(widths) for i in range(n + 1)]
    lines = []
    for i, x in enumerate(at):
        inner = [rng.uniform(0.1, 0.8) for _ in range(rng.randint(0, 5) if 0 < i < n else 0)]
        inner = sorted(inner + [y + 10 ** rng.uniform(-4.5, -1) for y in inner if rng.random() < 0.4])
        lines.append(list(range(len(points), len(points) + len(inner) + 2)))
        for y in [0, *inner, 1]:
            off = noise if 0 < y < 1 else 0
            points.append((x + rng.uniform(-off, off), y, bend * x * (1 - x) + rng.uniform(-off, off)))
    for left, right in zip(lines, lines[1:]):
        i = j = 0
        while i + 1 < len(left) or j + 1 < len(right):
            is_left = j + 1 == len(right) or (i + 1 < len(left) and points[left[i + 1]][1] < points[right[j + 1]][1])
            facets.append([left[i], right[j], left[i + 1] if is_left else right[j + 1]])
            i, j = i + is_left, j + (not is_left)
    _bar(points, facets, [line[0] for line in lines], [line[-1] for line in lines], rng.uniform(0.05, 1))


def _touch(rng, points, facets):
    """Two to four boxes, each almost on the one below; mostly in a larger one."""
    z = -0.6
    for _ in range(rng.randint(2, 4)):
        first = len(points)
        (x0, x1), (y0, y1) = (sorted((rng.uniform(-0.8, -0.05), rng.uniform(0.05, 0.8))) for _ in range(2))
        top, gap = z + rng.uniform(0.05, 0.3), 10 ** rng.uniform(-2.2, -0.7)
        tilt = rng.uniform(-0.5, 0.5) * gap if rng.random() < 0.5 else 0
        for i in range(8):
            x = x1 if i & 1 else x0
            points.append((x, y1 if i & 2 else y0, top + tilt * x if i & 4 else z))
        _box_faces(facets, first)
        z = top + gap
    if rng.random() < 0.7:
        _box(points, facets, 2)


def _terrace(rng, points, facets):
    """A block with a top of plateaus, one a little higher than the other, and slopes between them from a degree to upright."""
    n = rng.randint(1, 5)
    front, back, z = [len(points)], [len(points) + 1], 0
    points += [(0, 0, 0), (0, 1, 0)]
    for i in range(n):
        step, angle = 10 ** rng.uniform(-3, -1.3) * rng.choice((-1, 1)), _angle(rng, 1, 90)
        run = min(abs(step) / math.tan(angle), 0.5)
        x = [i + 1 + rng.uniform(-0.2, 0.2) for _ in range(2)]
        for up, move in ((0, 0), (step, run)):
            front.append(len(points))
            back.append(len(points) + 1)
            points += [(x[0] + move, 0, z + up), (x[1] + move, 1, z + up)]
        z += step
    front.append(len(points))
    back.append(len(points) + 1)
    points += [(n + 1, 0, z), (n + 1, 1, z)]
    facets += [[front[i], back[i], back[i + 1], front[i + 1]] for i in range(len(front) - 1)]
    _bar(points, facets, front, back, rng.uniform(0.3, 1))


def _prism(points, facets, profile, heights):
    """Over a polygon in the plane, from one height to another."""
    n, first = len(profile), len(points)
    points += [(x, y, z) for z in heights for x, y in profile]
    bottom, top = range(first, first + n), range(first + n, first + 2 * n)
    facets += [list(bottom), list(top)]
    facets += [[bottom[i], bottom[(i + 1) % n], top[(i + 1) % n], top[i]] for i in range(n)]


def _beam(rng, points, facets):
    """A beam with a profile of U, L, T or a trapezoid, whose measures are small whole numbers."""
    a, b, c, h, k, length = (rng.choice((1, 2, 3, 4, 5, 6, 8)) for _ in range(6))
    profile = rng.choice((
        ((0, 0), (a + b + c, 0), (a + b + c, h + k), (a + b, h + k), (a + b, h), (a, h), (a, h + k), (0, h + k)),
        ((0, 0), (a + b, 0), (a + b, h), (a, h), (a, h + k), (0, h + k)),
        ((0, 0), (b, 0), (b, h), (b + c, h), (b + c, h + k), (-a, h + k), (-a, h), (0, h)),
        ((0, 0), (a + b + c, 0), (a + b, h), (a, h))))
    _prism(points, facets, profile, (0, length * rng.choice((1, 2, 5))))


def _stack(rng, points, facets):
    """Two to four prisms on each other, turned and moved, with gaps between them."""
    gap, z = 10 ** rng.uniform(-6, -1.5), 0
    for _ in range(rng.randint(2, 4)):
        n, radius, turn = rng.choice((3, 4, 5, 6, 12)), rng.uniform(0.3, 0.6), rng.uniform(0, 7)
        x, y, top = rng.uniform(-0.1, 0.1), rng.uniform(-0.1, 0.1), z + rng.uniform(0.05, 0.3)
        angles = [turn + 2 * math.pi * i / n for i in range(n)]
        _prism(points, facets, [(x + 1.5 * radius * math.cos(a), y + radius * math.sin(a)) for a in angles], (z, top))
        z = top + gap


def _side(a, b, c, p):
    """Six times the volume of a tetrahedron, with its sign."""
    u, v, w = ([x - y for x, y in zip(q, a)] for q in (b, c, p))
    return sum(u[i] * (v[(i + 1) % 3] * w[(i + 2) % 3] - v[(i + 2) % 3] * w[(i + 1) % 3]) for i in range(3))


def _rotation(rng):
    """A uniform rotation, from a random unit quaternion."""
    q = [rng.gauss(0, 1) for _ in range(4)]
    n = math.sqrt(sum(x * x for x in q))
    w, x, y, z = (c / n for c in q)
    return ((1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
            (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
            (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)))


def kind_of(seed):
    if seed >= FIRST_BEAM:
        return "stack" if seed >= FIRST_STACK else "beam"
    return KINDS[seed % len(KINDS)]


def plc(seed):
    """(kind, points, facets) of the PLC with this number."""
    rng = random.Random(seed)
    kind = kind_of(seed)
    points, facets = [], []
    globals()["_" + kind](rng, points, facets)
    m = _rotation(rng) if rng.random() < 0.7 else ((1, 0, 0), (0, 1, 0), (0, 0, 1))
    scale = 10 ** rng.uniform(-6, 6) if rng.random() < 0.5 else 1
    shift = [rng.uniform(-10, 10) if rng.random() < 0.5 else 0 for _ in range(3)]
    moved = [[scale * (sum(m[i][j] * p[j] for j in range(3)) + shift[i]) for i in range(3)] for p in points]
    return kind, moved, facets


def as_poly(points, facets):
    """The text of a .poly file, without the points that no facet uses."""
    used = sorted({i for f in facets for i in f})
    lines = [f"{len(used)} 3 0 0"]
    lines += [f"{k} " + " ".join(repr(x) for x in points[i]) for k, i in enumerate(used)]
    lines.append(f"{len(facets)} 0")
    for f in facets:
        lines += ["1", f"{len(f)} " + " ".join(str(used.index(i)) for i in f)]
    return "\n".join(lines + ["0", "0"]) + "\n"


def failure(pgdr, text, limit, folder, *angle):
    """What is wrong with the mesh of a PLC, or nothing."""
    source, mesh = folder / "input.poly", folder / "output.mesh"
    source.write_text(text)
    code, _, text = attempt([pgdr, "mesh", source, "-o", mesh, "--quiet", "--threads", 1, "--radius-edge-ratio", 2], limit, folder)
    if code != 0:
        return "no end" if code is None else text.strip() or f"exit code {code}"
    code, _, text = attempt([pgdr, "check", mesh, "--plc", source, *angle], 600, folder)
    return "" if code == 0 else next((line for line in text.splitlines() if not line.startswith("ok")), "no end of the check")


def minimised(pgdr, points, facets, limit, folder, *angle):
    """The facets without those that a failure does not need; without these the PLC has to be valid, too."""
    for f in list(facets):
        fewer = [g for g in facets if g is not f]
        text = as_poly(points, fewer)
        (folder / "fewer.poly").write_text(text)
        if attempt([pgdr, "info", folder / "fewer.poly"], limit, folder)[0] == 0 and failure(pgdr, text, limit, folder, *angle):
            facets = fewer
    return facets


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--count", type=int, default=700)
    parser.add_argument("--kinds", default=",".join((*KINDS, "beam", "stack")))
    parser.add_argument("--min-dihedral")
    parser.add_argument("--pgdr", type=lambda p: Path(p).resolve(), default=ROOT / "build" / "release" / "pgdr")
    parser.add_argument("--limit", type=float, default=20)
    parser.add_argument("--keep", type=Path)
    args = parser.parse_args()
    kinds = args.kinds.split(",")
    angle = ["--min-dihedral", args.min_dihedral] if args.min_dihedral else []

    def one(seed):
        kind, points, facets = plc(seed)
        with tempfile.TemporaryDirectory() as folder:
            wrong = failure(args.pgdr, as_poly(points, facets), args.limit, Path(folder), *angle)
            if wrong and args.keep:
                facets = minimised(args.pgdr, points, facets, args.limit, Path(folder), *angle)
            return seed, kind, as_poly(points, facets), wrong

    seeds = [s for s in range(args.first, args.first + args.count) if kind_of(s) in kinds]
    count, failed = collections.Counter(), collections.Counter()
    with ThreadPoolExecutor(2) as pool:
        for seed, kind, text, wrong in pool.map(one, seeds):
            count[kind] += 1
            if not wrong:
                continue
            failed[kind] += 1
            print(f"{kind} {seed}: {wrong[:150]}", flush=True)
            if args.keep:
                args.keep.mkdir(parents=True, exist_ok=True)
                (args.keep / f"{kind}_{seed}.poly").write_text(text)
    print()
    print(table(["kind", "meshed and checked", "of"], [[k, count[k] - failed[k], count[k]] for k in kinds if count[k]]))
    return 1 if failed else 0


if __name__ == "__main__":
    raise SystemExit(main())
