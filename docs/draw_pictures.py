#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the pictures of the README with pgdr and headless Chromium.

usage: docs/draw_pictures.py [PROGRAM]      default: build/release/pgdr
"""
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PICTURES = {"winged_body": ["data/winged_body_in_box.poly", "--size", "2.4", "--refine-box=-19.89,-5.65,-5.61,6.50,8.05,5.61:0.6"]}


def main():
    program = Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/release/pgdr").resolve()
    for name, arguments in PICTURES.items():
        with tempfile.TemporaryDirectory() as folder:
            page = Path(folder) / "page.html"
            subprocess.run([program, "mesh", *arguments, "--quiet", "-o", Path(folder) / "out.vtu", "--report", page], cwd=ROOT, check=True)
            command = ["chromium", "--headless", "--no-sandbox", "--enable-unsafe-swiftshader", "--use-angle=swiftshader", "--hide-scrollbars", "--disable-background-networking"]
            command += ["--window-size=1000,640", f"--user-data-dir={folder}/profile", f"--screenshot={ROOT}/docs/pictures/{name}.png", f"file://{page}#picture"]
            subprocess.run(command, check=True, capture_output=True)


if __name__ == "__main__":
    main()
