#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of `pgdr mesh --report` and `pgdr view` holds what it should, needs no network, and works in a browser: headless Chromium, where it is
installed, shows a mesh that is cut open at another place when the plane moves."""
import html
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77
BROWSER = [
    "--headless", "--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
    "--enable-unsafe-swiftshader", "--use-angle=swiftshader", "--window-size=1000,900", "--enable-logging=stderr", "--v=0", "--dump-dom",
]  # fmt: skip


def data_of(page):
    text = page.read_text()
    assert not re.search(r'<(script|img|link|iframe)[^>]*(src|href)=', text), "the page asks for other files"
    assert len(text) < 15e6
    found = re.search(r'<script type="application/json" id="data">(.*?)</script>', text, re.S)
    assert found, "the page has no data"
    return json.loads(found[1])


def check_in_browser(chromium, page, folder):
    run = subprocess.run([chromium, *BROWSER, f"--user-data-dir={folder}/profile", f"file://{page}#test"], capture_output=True, text=True, timeout=120)
    errors = [line for line in run.stderr.splitlines() if "CONSOLE" in line]
    assert not errors, errors
    found = re.search(r'data-test="([^"]*)"', run.stdout)
    assert found, "the page did not come to its end"
    seen = json.loads(html.unescape(found[1]))
    whole, half, little = seen["triangles"]
    assert whole > half > little > 0, seen
    assert 0.02 < seen["drawn"] < 0.9, seen


def main():
    app = os.environ.get("PGDR_APP", "")
    if not app:
        print("no program to test")
        return SKIPPED
    data = Path(__file__).resolve().parents[2] / "data"
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        page, mesh, other = folder / "report.html", folder / "out.mesh", folder / "view.html"
        command = [app, "mesh", data / "two_regions.poly", "--size", "0.2", "--name-region", "10=the </script> one", "--threads", "2"]
        run = subprocess.run([*command, "-o", mesh, "--report", page, "--stats", folder / "s.json"], capture_output=True, text=True)
        if run.returncode == 2 and "without npm" in run.stderr:
            print("the program was built without npm: skipped")
            return SKIPPED
        assert run.returncode == 0, run.stderr
        stats = json.loads((folder / "s.json").read_text())
        report = data_of(page)
        assert report["title"] == "two_regions.poly"
        assert ["tetrahedra", f"{stats['tetrahedra']:,}"] in report["output"]
        assert ["vertices", "12"] in report["input"], report["input"]
        assert report["histograms"][0]["regions"][0] == "the </script> one"
        for histogram in report["histograms"]:
            assert sum(b[2] for b in histogram["bins"]) in (stats["tetrahedra"], 6 * stats["tetrahedra"])
        assert abs(float(report["worst"][0]["dihedral"]) - stats["min_dihedral_deg"]) < 1e-2
        assert report["tasks"] and report["phases"]

        run = subprocess.run([app, "view", mesh, "-o", other], capture_output=True, text=True)
        assert run.returncode == 0, run.stderr
        assert ["tetrahedra", f"{stats['tetrahedra']:,}"] in data_of(other)["output"]
        run = subprocess.run([app, "view", mesh, "-o", folder / "view.txt"], capture_output=True, text=True)
        assert run.returncode == 2 and ".html" in run.stderr

        chromium = shutil.which("chromium")
        if not chromium:
            print("chromium is not installed: the page was not opened")
            return 0
        check_in_browser(chromium, page, folder)
        check_in_browser(chromium, other, folder)
    return 0


if __name__ == "__main__":
    sys.exit(main())
