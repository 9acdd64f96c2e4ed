#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the pictures of the README, the guide and the manual, with pgdr, its Python module, the compiled examples and headless Chromium.

usage: docs/draw_pictures.py [NAME...]      default: all of them; with PGDR_APP in the environment, by that program
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).resolve().parents[1]
APP = Path(os.environ.get("PGDR_APP", ROOT / "build/release/pgdr")).resolve()
# Name: commands (none: those of the guide's example of this number), the mesh that they write, and how the page shows it.
README = "pgdr mesh data/winged_body_in_box.poly --size 2.4 --refine-box=-19.89,-5.65,-5.61,6.50,8.05,5.61:0.6 -o out.vtu"
PICTURES = {
    "winged_body": (README, "out.vtu", "cut=y:0.5"),
    "manual_cube": ("example_refine_cube", "cube.vtu", "cut=y:0.4"),
    "manual_graded": ("example_distance_sizing_with_gradation", "graded.vtu", "cut=y:0.5"),
    "manual_remeshed": ("example_surface_mesh_to_c3t3", "remeshed.vtu", "cut=y:0.4"),
    "guide_1": (1, "plate.vtu", "cut=y:0.3"),
    "guide_2": (2, "closed.mesh", "cut=y:0.4"),
    "guide_3": (3, "part.mesh", "cut=y:0.4"),
    "guide_4": (4, "by_ball.vtu", "cut=y:0.2"),
    "guide_5": (5, "cube.msh", "cut=x:0.3"),
    "guide_6": (6, "assembly.vtu", "cut=y:0.3&colour=region"),
    "guide_7": (7, "flow.vtu", "cut=y:0.5"),
    "guide_8": (8, "block.vtu", "cut=y:0.3"),
    "guide_9": (9, "two.mesh", "cut=y:0.4&colour=region"),
    "guide_10": (10, "poisson.vtu", "cut=y:0.5&colour=region"),
}


def commands_of(example):
    """What the guide says, with the files of second order in a format that the page reads, too."""
    guide = (ROOT / "docs/guide/README.md").read_text(encoding="utf-8")
    block = re.findall(r"^```sh\n(.*?)^```$", guide, re.M | re.S)[example - 1]
    return block.replace(" -o block.inp", " -o block.inp -o block.vtu").replace("data/../", f"{ROOT}/")


def draw(name, commands, mesh, view):
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "data").symlink_to(ROOT / "data")
        (Path(folder) / "bin").mkdir()
        (Path(folder) / "bin/pgdr").symlink_to(APP)
        (Path(folder) / "bin/python3").symlink_to(sys.executable)
        environment = {**os.environ, "PATH": f"{folder}/bin:{APP.parent}/examples:{os.environ['PATH']}", "PYTHONPATH": str(APP.parent / "python")}
        for command in (commands if isinstance(commands, str) else commands_of(commands), f"pgdr view {mesh} -o page.html"):
            subprocess.run(["bash", "-e", "-c", command], cwd=folder, env=environment, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        browser = ["chromium", "--headless", "--no-sandbox", "--enable-unsafe-swiftshader", "--use-angle=swiftshader", "--hide-scrollbars", "--disable-background-networking"]
        browser += ["--window-size=900,520", f"--user-data-dir={folder}/profile", f"--screenshot={folder}/page.png", f"file://{folder}/page.html#picture&{view}"]
        subprocess.run(browser, check=True, capture_output=True)
        target = ROOT / f"docs/pictures/{name}.png"
        # A fifth of the bytes, and hardly to be told apart.
        Image.open(f"{folder}/page.png").convert("RGB").quantize(64, dither=Image.Dither.NONE).save(target, optimize=True)
        print(target.name, target.stat().st_size)


def main():
    if not shutil.which("chromium"):
        sys.exit("there is no Chromium")
    for name in sys.argv[1:] or PICTURES:
        draw(name, *PICTURES[name])


if __name__ == "__main__":
    main()
