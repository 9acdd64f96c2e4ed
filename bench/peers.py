#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares pgdr with other meshers, end to end: from the command line to the closed file.

All of them mesh the unit cube with about 6.4 million tetrahedra and write Medit .mesh: pgdr on one and two threads,
Gmsh's HXT (C. Marot et al., 2019) and CGAL's Mesh_3 on two threads, and TetGen (H. Si, 2015), which knows one. What is
not installed is skipped with a message. The runs take turns, so that a change of the machine's mood meets all of them;
the table shows medians. The sizes below were found by trial so that the counts agree to 3 %; a count that does not is
reported. None of them removes slivers here; bench/quality.py compares those who do.

TetGen 1.5 is told to write nothing but the .mesh file (-NEF), with the triangles of the boundary alone; that favours
it. The file's header then still announces all triangles, a mistake of that version.

Needs: cmake --build build/release --target pgdr-app bench_mesh_3_peer; Debian's packages gmsh and tetgen.
"""

import argparse
import json
import shutil
import sys
import tempfile
from pathlib import Path
from typing import Callable, NamedTuple

from measure import ROOT, Failure, machine, median, note, spread, table, timed

CUBE_GEO = """// The unit cube.
Point(1) = {0, 0, 0};
line[] = Extrude {1, 0, 0} { Point{1}; };
square[] = Extrude {0, 1, 0} { Curve{line[1]}; };
cube[] = Extrude {0, 0, 1} { Surface{square[1]}; };
"""

# The same for Mesh_3, which reads surfaces of triangles.
CUBE_OFF = """OFF
8 12 0
0 0 0
1 0 0
0 1 0
1 1 0
0 0 1
1 0 1
0 1 1
1 1 1
3 0 2 3
3 0 3 1
3 4 5 7
3 4 7 6
3 0 1 5
3 0 5 4
3 2 6 7
3 2 7 3
3 0 4 6
3 0 6 2
3 1 3 7
3 1 7 5
"""

# Option, and the number of tetrahedra that it gave: pgdr 0.1, Gmsh 4.8.4, CGAL 5.5.1, TetGen 1.5.0 (Debian 12).
SIZES = {
    "pgdr-size": ("0.0091", 6436124, "largest circumradius"),
    "gmsh-size": ("0.00845", 6479938, "length of edges"),
    "mesh-3-size": ("0.009", 6403956, "largest circumradius"),
    "tetgen-volume": ("0.000000295", 6393291, "largest volume"),
}
# (ours, theirs, how many times faster we want to be)
TARGETS = [("pgdr-2", "gmsh", 2.5), ("pgdr-2", "mesh-3", 2.5), ("pgdr-1", "tetgen", 4)]
TOLERANCE = 0.03


class Peer(NamedTuple):
    title: str
    program: str  # as it would be typed
    command: Callable  # path of the program -> words
    output: str
    hint: str  # how to get it


def peers(arguments):
    """What to run, by the name that --only takes. Every command runs in a folder that holds cube.poly, cube.off and cube.geo."""
    build = "cmake --build build/release --target "
    ours = {
        f"pgdr-{n}": Peer(f"pgdr, {n} thread{'s' * (n > 1)}", arguments.pgdr,
                          lambda path, n=n: [path, "mesh", "cube.poly", "--size", arguments.pgdr_size, "--min-dihedral", "0",
                                             "--threads", str(n), "--quiet", "-o", "pgdr.mesh"],
                          "pgdr.mesh", build + "pgdr-app")
        for n in (1, 2)
    }
    return ours | {
        "gmsh": Peer("Gmsh HXT, 2 threads", arguments.gmsh,
                     lambda path: [path, "-3", "-algo", "hxt", "-nt", "2", "-clmax", arguments.gmsh_size,
                                   "-format", "mesh", "-o", "gmsh.mesh", "cube.geo"],
                     "gmsh.mesh", "package gmsh"),
        "mesh-3": Peer("CGAL Mesh_3, 2 threads", arguments.mesh_3,
                       lambda path: [path, "cube.off", arguments.mesh_3_size, "mesh_3.mesh", "2"],
                       "mesh_3.mesh", build + "bench_mesh_3_peer"),
        "tetgen": Peer("TetGen, 1 thread", arguments.tetgen,
                       lambda path: [path, f"-pq2.0a{arguments.tetgen_volume}gNEFQ", "cube.poly"],
                       "cube.1.mesh", "package tetgen"),
    }


def count_tetrahedra(path):
    """The number in the header of a .mesh file's tetrahedra."""
    with open(path, "rb") as file:
        for line in file:
            words = line.split()
            if words and words[0] == b"Tetrahedra":
                return int(words[1] if len(words) > 1 else next(file))
    raise Failure(f"{path}: no tetrahedra")


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repetitions", type=int, default=3, metavar="N", help="default 3")
    parser.add_argument("--only", metavar="NAME,NAME", help="some of pgdr-1, pgdr-2, gmsh, mesh-3, tetgen")
    parser.add_argument("--pgdr", default=str(ROOT / "build/release/pgdr"), metavar="PROGRAM")
    parser.add_argument("--mesh-3", default=str(ROOT / "build/release/bench/mesh_3_peer"), metavar="PROGRAM")
    parser.add_argument("--gmsh", default="gmsh", metavar="PROGRAM")
    parser.add_argument("--tetgen", default="tetgen", metavar="PROGRAM")
    for option, (value, count, meaning) in SIZES.items():
        parser.add_argument("--" + option, default=value, metavar="R",
                            help=f"{meaning}; default {value}: {count} tetrahedra")
    parser.add_argument("--json", metavar="FILE", help="write every single run as well")
    arguments = parser.parse_args(words)
    if arguments.repetitions < 1:
        parser.error("--repetitions must be at least 1")
    return parser, arguments


def main(words):
    parser, arguments = parse(words)
    chosen = peers(arguments)
    if arguments.only:
        names = arguments.only.split(",")
        for name in names:
            if name not in chosen:
                parser.error(f"--only: there is no {name}")
        chosen = {name: chosen[name] for name in names}
    programs = {}
    for name, peer in chosen.items():
        path = shutil.which(peer.program)
        if path is None:
            note(f"skipped: {peer.title}: {peer.program} is not there ({peer.hint})")
        else:
            programs[name] = str(Path(path).resolve())

    runs = {name: [] for name in programs}
    counts, failed = {}, False
    with tempfile.TemporaryDirectory(prefix="pgdr-peers-") as folder:
        shutil.copy(ROOT / "data/cube.poly", folder)
        (Path(folder) / "cube.geo").write_text(CUBE_GEO, encoding="utf-8")
        (Path(folder) / "cube.off").write_text(CUBE_OFF, encoding="utf-8")
        for repetition in range(arguments.repetitions):
            for name in list(programs):
                peer = chosen[name]
                try:
                    run = timed(peer.command(programs[name]), folder)
                    counts[name] = count_tetrahedra(Path(folder) / peer.output)
                except (Failure, OSError) as error:
                    note(f"failed: {peer.title}: {error}")
                    del programs[name], runs[name]
                    failed = True
                    continue
                (Path(folder) / peer.output).unlink()
                runs[name].append(run)
                note(f"{repetition + 1}/{arguments.repetitions} {peer.title}: {run.seconds:.2f} s, "
                     f"{counts[name]} tetrahedra")

    report(chosen, runs, counts)
    if arguments.json:
        data = {name: {"tetrahedra": counts[name], "runs": [run._asdict() for run in runs[name]]} for name in runs}
        Path(arguments.json).write_text(json.dumps(data, indent=2) + "\n", encoding="utf-8")
    return 1 if failed or not runs else 0


def report(chosen, runs, counts):
    """Prints the tables: times and memory, then the ratios that are asked for."""
    if not runs:
        return
    print(f"{machine()}; median (range) of {max(map(len, runs.values()))} interleaved runs\n")
    wall = {name: median([run.seconds for run in runs[name]]) for name in runs}
    ours = [name for name in ("pgdr-1", "pgdr-2") if name in runs]
    rows = [[chosen[name].title, f"{counts[name]:,}", spread([run.seconds for run in runs[name]]),
             f"{median([run.processor_seconds for run in runs[name]]):.1f}",
             f"{max(run.peak_bytes for run in runs[name]) / 1e6:,.0f}"]
            + [f"{wall[name] / wall[our]:.2f}" for our in ours] for name in runs]
    print(table(["mesher", "tetrahedra", "wall, s", "processor, s", "peak memory, MB"]
                + [f"wall / {chosen[our].title}" for our in ours], rows))
    print()
    for our, their, target in TARGETS:
        if our in wall and their in wall:
            # As much time for as many tetrahedra, though the counts hardly differ.
            ratio = wall[their] / counts[their] * counts[our] / wall[our]
            print(f"- {chosen[our].title}: {ratio:.2f} x as fast per tetrahedron as {chosen[their].title}; "
                  f"wanted {target}: {'reached' if ratio >= target else 'missed'}")
    reference = ours[0] if ours else next(iter(runs))
    for name in runs:
        if abs(counts[name] / counts[reference] - 1) > TOLERANCE:
            note(f"{chosen[name].title}: the count differs by more than {TOLERANCE:.0%}; change its size and run again")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
