#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compiles a file that must not compile, and looks for what its comments in front of functions say in the errors.

usage: check_refused.py COMPILER [FLAG]... FILE
"""
import re
import subprocess
import sys
from pathlib import Path

text = Path(sys.argv[-1]).read_text(encoding="utf-8")
expected = re.findall(r"\n\n// (.*)\n(?=\S.*\) \{)", text)
run = subprocess.run(sys.argv[1:], capture_output=True, text=True, check=False)
missing = [sentence for sentence in expected if f"{sentence}" not in run.stderr]
if not expected or run.returncode == 0 or missing:
    sys.exit(f"exit code {run.returncode}, {len(expected)} sentences expected, not said: {missing}\n{run.stderr[-2000:]}")
print(f"{len(expected)} types are refused")
