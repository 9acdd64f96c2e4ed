#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The shapes in data/ are what scripts/make_shapes writes, byte for byte."""

import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]


def main():
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, "-B", ROOT / "scripts" / "make_shapes", folder], check=True)
        made = {path.name: path.read_bytes() for path in pathlib.Path(folder).iterdir()}
    kept = {path.name: path.read_bytes() for path in (ROOT / "data").glob("*.poly")}
    wrong = sorted(name for name in made.keys() | kept.keys() if made.get(name) != kept.get(name))
    for name in wrong:
        print(f"data/{name} differs from what scripts/make_shapes writes")
    print(f"{len(made)} shapes, {len(wrong)} differ")
    return 1 if wrong or not made else 0


if __name__ == "__main__":
    sys.exit(main())
