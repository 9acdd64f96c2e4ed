#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The figures of docs/theory.md can be drawn again, and those that it shows are all there are."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]


def main():
    app = os.environ.get("PGDR_APP")
    if not app:
        print("pgdr-test-skip: there is no program pgdr")
        return 77
    shown = set(re.findall(r"figures/([\w.]+)\)", (ROOT / "docs" / "theory.md").read_text()))
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, "-B", ROOT / "docs" / "draw_figures.py", "--pgdr", app, "--output", folder],
                       check=True)
        drawn = {path.name for path in pathlib.Path(folder).iterdir()}
        shapes = {name: len(list(xml.etree.ElementTree.parse(pathlib.Path(folder) / name).iter())) for name in drawn}
    kept = {path.name for path in (ROOT / "docs" / "figures").iterdir()}
    print(f"drawn {shapes}, kept {sorted(kept)}, shown {sorted(shown)}")
    return 0 if drawn == kept == shown and min(shapes.values()) > 10 else 1


if __name__ == "__main__":
    sys.exit(main())
