# SPDX-License-Identifier: GPL-3.0-or-later
"""What the benchmark scripts share: timed runs, medians, Markdown tables."""

import os
import re
import statistics
import subprocess
import sys
import time
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parent.parent


class Failure(Exception):
    """A program that could not be run, or that failed."""


class Run(NamedTuple):
    seconds: float  # wall clock, from the start of the program until it has ended
    processor_seconds: float  # over all threads
    peak_bytes: int  # resident


def timed(command, folder=None):
    """Runs a command without a shell; raises Failure with the end of its output if it fails."""
    with open(Path(folder or ".") / "output.log", "w+b") as log:
        start = time.perf_counter()
        try:
            process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=log, stderr=log)
        except OSError as error:
            raise Failure(f"{command[0]}: {error.strerror}") from error
        _, status, usage = os.wait4(process.pid, 0)
        seconds = time.perf_counter() - start
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            log.seek(0)
            end = log.read().decode(errors="replace").strip().splitlines()[-5:]
            raise Failure("\n  ".join([f"{' '.join(command)}: exit code {process.returncode}", *end]))
    # Linux counts in KiB.
    return Run(seconds, usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024)


def attempt(command, limit, folder):
    """Exit code (None: out of time), seconds and output of a command that may fail or not end."""
    begin = time.perf_counter()
    try:
        done = subprocess.run([str(c) for c in command], cwd=folder, timeout=limit, capture_output=True, text=True)
    except subprocess.TimeoutExpired:
        return None, limit, ""
    return done.returncode, time.perf_counter() - begin, done.stdout + done.stderr


def number(text, pattern, otherwise):
    """What the first group of a pattern holds, thousands separated or not."""
    found = re.search(pattern, text)
    return float(found.group(1).replace(",", "").rstrip(".")) if found else otherwise


def median(values):
    return statistics.median(values)


def spread(values):
    """Median and range, as `12.3 (12.1-13.0)`."""
    return f"{median(values):.2f} ({min(values):.2f}-{max(values):.2f})"


def table(header, rows):
    """A table in Markdown. The first column is text, the others are numbers."""
    rule = ["---"] + ["---:"] * (len(header) - 1)
    return "\n".join("| " + " | ".join(str(cell) for cell in row) + " |" for row in [header, rule, *rows])


def machine():
    """The processor and its number of cores, for the line above a table."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace").splitlines()
        name = next(line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        name = "unknown processor"
    return f"{name}, {len(os.sched_getaffinity(0))} cores"


def note(text):
    print(text, file=sys.stderr, flush=True)
