#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""On a terminal `pgdr mesh` shows a line that is rewritten in place, not too often, and gone at the end."""

import os
import pathlib
import pty
import subprocess
import sys
import tempfile
import time

ERASE = b"\r\x1b[K"


def errors_on_a_terminal(arguments):
    """What the program writes to stderr when that is a terminal, its exit code and the seconds it took."""
    ours, theirs = pty.openpty()
    start = time.monotonic()
    process = subprocess.Popen(arguments, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=theirs)
    os.close(theirs)
    written = b""
    while True:
        try:
            block = os.read(ours, 65536)
        except OSError:  # the other end is closed (Linux says EIO)
            break
        if not block:
            break
        written += block
    os.close(ours)
    return written, process.wait(), time.monotonic() - start


def main():
    app = os.environ.get("PGDR_APP", "")
    if not app:
        print("no program to test")
        return 77
    try:
        for end in pty.openpty():
            os.close(end)
    except OSError as error:  # a container without /dev/pts, say
        print("no terminal to test on:", error)
        return 77
    data = pathlib.Path(__file__).resolve().parents[2] / "data"
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "out.vtu")
        command = [app, "mesh", str(data / "cube.poly"), "--size", "0.04", "-o", output]
        written, code, seconds = errors_on_a_terminal(command)
        assert code == 0, written
        assert b"vertices" in written or seconds < 0.5, written
        assert b"\n" not in written, written
        assert written.endswith(ERASE), written
        shown = written.count(b"\r")
        assert shown <= 10 * seconds + 12, (shown, seconds)

        written, code, _ = errors_on_a_terminal(command + ["--quiet"])
        assert code == 0 and written == b"", written
    return 0


if __name__ == "__main__":
    sys.exit(main())
