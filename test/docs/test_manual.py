#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The manual is built without a warning, every name of the library in it is a link, and all examples are in it."""

import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


class Manual(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        run = subprocess.run([ROOT / "scripts" / "docs", cls.folder.name], capture_output=True, text=True)
        assert run.returncode == 0, run.stdout + run.stderr
        cls.page = (Path(cls.folder.name) / "html" / "index.html").read_text(encoding="utf-8")
        cls.text = (ROOT / "docs" / "manual" / "user_manual.md").read_text(encoding="utf-8")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_every_name_is_a_link(self):
        linked = set(re.findall(r"<a [^>]*>(pgdr::[A-Za-z0-9_:]+)", self.page))
        named = set(re.findall(r"\bpgdr::[A-Za-z0-9_:]*[A-Za-z0-9_]", self.text))
        self.assertGreater(len(named), 20)
        self.assertEqual(named - linked, set())

    def test_every_example_is_shown(self):
        shown = set(re.findall(r"^\\include (\S+)$", self.text, re.MULTILINE))
        self.assertEqual(shown, {path.name for path in (ROOT / "examples").glob("*.cpp")})
        self.assertEqual(self.page.count('<div class="fragment">'), len(shown))


if __name__ == "__main__":
    if not shutil.which("doxygen"):
        print("pgdr-test-skip: no doxygen")
        sys.exit(77)
    unittest.main()
