#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures how the refinement scales with the number of threads, and checks that the mesh is always the same.

Each case is meshed with every number of threads in turn, several times over; the tables show medians. Times are those
that pgdr itself measures (--stats). The exit code is 1 if a run fails or two meshes of one case differ in their
checksums.

Needs: cmake --build build/release --target pgdr-app
"""

import argparse
import json
import sys
import tempfile
from pathlib import Path

from measure import ROOT, Failure, machine, median, note, spread, table, timed

# name: (input in data/, options, how much faster the refinement has to be on two threads)
CASES = {
    "cube": ("cube.poly", ["--size", "0.0093"], 1.85),
    "wings": ("winged_body_in_box.poly",
              ["--size", "0.5", "--refine-box=-19.89,-5.65,-5.61,6.50,8.05,5.61:0.25"], 1.75),
}


def parse(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--threads", default="1,2", metavar="N,N,...", help="default 1,2")
    parser.add_argument("--repetitions", type=int, default=3, metavar="N", help="default 3")
    parser.add_argument("--only", metavar="NAME", choices=CASES, help="one case: " + ", ".join(CASES))
    parser.add_argument("--size", metavar="R", help="another --size for the case given by --only")
    parser.add_argument("--option", action="append", default=[], metavar="WORD",
                        help="a word more for pgdr mesh; repeatable")
    parser.add_argument("--pgdr", default=str(ROOT / "build/release/pgdr"), metavar="PROGRAM")
    parser.add_argument("--json", metavar="FILE", help="write the statistics of every single run as well")
    arguments = parser.parse_args(words)
    try:
        arguments.threads = [int(word) for word in arguments.threads.split(",")]
    except ValueError:
        parser.error("--threads: numbers with commas between them")
    if min(arguments.threads) < 1 or arguments.repetitions < 1:
        parser.error("--threads and --repetitions must be at least 1")
    if arguments.size and not arguments.only:
        parser.error("--size needs --only")
    return arguments


def measure(case, arguments):
    """The statistics of all runs of a case, by number of threads."""
    source, options, _ = CASES[case]
    if arguments.size:
        options = ["--size", arguments.size, *options[2:]]
    runs = {n: [] for n in arguments.threads}
    with tempfile.TemporaryDirectory(prefix="pgdr-scaling-") as folder:
        for repetition in range(arguments.repetitions):
            for n in arguments.threads:
                timed([str(Path(arguments.pgdr).resolve()), "mesh", str(ROOT / "data" / source), "--min-dihedral", "0",
                       *options, *arguments.option, "--threads", str(n), "--quiet", "--stats", "stats.json", "-o", "out.mesh"],
                      folder)
                stats = json.loads((Path(folder) / "stats.json").read_text(encoding="utf-8"))
                runs[n].append(stats)
                note(f"{case} {repetition + 1}/{arguments.repetitions}, {n} threads: refinement "
                     f"{stats['seconds']['refinement']:.2f} s, total {stats['seconds']['total']:.2f} s, "
                     f"{stats['mesh_checksum']}")
    return runs


def report(case, runs):
    """Prints the tables of a case; False if its meshes differ."""
    def seconds(n, phase):
        return median([stats["seconds"].get(phase, 0) for stats in runs[n]])

    first = next(iter(runs))
    some = runs[first][0]
    source, _, target = CASES[case]
    print(f"\n### {case}: {source}, {some['tetrahedra']:,} tetrahedra\n")
    rows = []
    for n in runs:
        refinement = seconds(n, "refinement")
        peak = max(stats["peak_memory_bytes"] for stats in runs[n])
        rows.append([n, spread([stats["seconds"]["refinement"] for stats in runs[n]]),
                     f"{seconds(first, 'refinement') / refinement:.2f}",
                     f"{1e-6 * some['tetrahedra'] / refinement:.2f}", f"{seconds(n, 'total'):.2f}",
                     f"{seconds(first, 'total') / seconds(n, 'total'):.2f}", f"{peak / some['tetrahedra']:.0f}",
                     " ".join(sorted({stats["mesh_checksum"] for stats in runs[n]}))])
    print(table(["threads", "refinement, s", "speed-up", "M tetrahedra/s", "total, s", "speed-up", "bytes/tetrahedron",
                 "checksum"], rows))
    phases = [phase for phase in some["seconds"] if max(seconds(n, phase) for n in runs) >= 0.005]
    print()
    print(table(["phase", *(f"{n} thread{'s' * (n > 1)}, s" for n in runs)],
                [[phase, *(f"{seconds(n, phase):.3f}" for n in runs)] for phase in phases]))
    if first == 1 and 2 in runs:
        ratio = seconds(1, "refinement") / seconds(2, "refinement")
        # Two threads cannot be much more than twice as fast: then something else slowed the runs on one.
        verdict = "disturbed, run it again" if ratio > 2.1 else "reached" if ratio >= target else "missed"
        print(f"\nRefinement on 2 threads: {ratio:.2f} x as fast as on 1; wanted {target}: {verdict}.")
    checksums = {stats["mesh_checksum"] for n in runs for stats in runs[n]}
    print(f"\nAll {sum(map(len, runs.values()))} meshes are the same." if len(checksums) == 1
          else f"\n**The meshes differ**: {len(checksums)} checksums.")
    return len(checksums) == 1


def main(words):
    arguments = parse(words)
    results, same = {}, True
    for case in [arguments.only] if arguments.only else CASES:
        try:
            results[case] = measure(case, arguments)
        except Failure as error:
            note(f"failed: {case}: {error}")
            return 1
    print(f"{machine()}; median (range) of {arguments.repetitions} interleaved runs")
    for case, runs in results.items():
        same = report(case, runs) and same
    if arguments.json:
        Path(arguments.json).write_text(json.dumps(results, indent=2) + "\n", encoding="utf-8")
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
