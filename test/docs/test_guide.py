#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every command of the guide runs, one block after the other in one folder; what a block needs and is not there (npm, SciPy) leaves it out. Options
that the tables name are options of the program."""
import importlib.util
import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
APP = os.environ.get("PGDR_APP", "")
GUIDE = (ROOT / "docs/guide/README.md").read_text(encoding="utf-8")


class Guide(unittest.TestCase):
    def test_all_commands_run(self):
        blocks = re.findall(r"^```sh\n(.*?)^```$", GUIDE, re.M | re.S)
        self.assertEqual(len(blocks), 10)
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "data").symlink_to(ROOT / "data")
            (Path(folder) / "bin").mkdir()
            (Path(folder) / "bin/pgdr").symlink_to(APP)
            (Path(folder) / "bin/python3").symlink_to(sys.executable)
            environment = {**os.environ, "PATH": f"{folder}/bin:{os.environ['PATH']}"}
            for block in blocks:
                if "poisson" in block:
                    if not all(importlib.util.find_spec(m) for m in ("pgdr", "scipy", "meshio")):
                        continue
                    block = block.replace("data/../", f"{ROOT}/")
                run = subprocess.run(["bash", "-e", "-c", block], cwd=folder, env=environment, capture_output=True, text=True)
                if "without npm" in run.stderr:
                    block = re.sub(r" --report \S+", "", block)
                    run = subprocess.run(["bash", "-e", "-c", block], cwd=folder, env=environment, capture_output=True, text=True)
                self.assertEqual(run.returncode, 0, block + run.stdout + run.stderr)
                for output in re.findall(r" -o (\S+)", block):
                    if "$" not in output:
                        self.assertTrue((Path(folder) / output).exists(), output)

    def test_all_options_are_there(self):
        known = "".join(subprocess.run([APP, command, "--help"], capture_output=True, text=True).stdout for command in ("mesh", "check", "info", "view"))
        named = set(re.findall(r"(?<![\w-])--[a-z][a-z-]+", GUIDE))
        self.assertGreater(len(named), 20)
        self.assertEqual({option for option in named if option not in known}, set())


if __name__ == "__main__":
    if not APP:
        print("no program to test")
        sys.exit(77)
    APP = str(Path(APP).resolve())
    unittest.main()
