#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The examples that go on with a mesh, in Python and with deal.II, run and come out with what they should. One whose libraries are not installed is left out."""
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SKIPPED = 77
EXAMPLES = Path(__file__).parents[2] / "examples"
APP = os.environ.get("PGDR_APP", "")
PNG = b"\x89PNG"


def needs(*modules):
    missing = [name for name in modules if not importlib.util.find_spec(name)]
    return unittest.skipIf(missing, f"no {', '.join(missing)}")


class Examples(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def output_of(self, *command):
        # Matplotlib and DOLFINx keep what they compile in the user's folder.
        run = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, env={**os.environ, "HOME": str(self.folder)}, timeout=600)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        return run.stdout

    def by_python(self, script, *arguments):
        return self.output_of(sys.executable, "-B", EXAMPLES / "python" / script, *arguments)

    def numbers(self, pattern, text):
        found = re.search(pattern, text)
        self.assertTrue(found, text)
        return [float(n.replace(",", "")) for n in found.groups()]

    @needs("pgdr", "scipy", "meshio")
    def test_poisson(self):
        import meshio

        tetrahedra, largest = self.numbers(r"([\d,]+) tetrahedra>: largest u ([\d.]+)", self.by_python("poisson.py"))
        self.assertTrue(10_000 < tetrahedra < 100_000)
        # Without the ball, whose material conducts ten times as well, it would be 0.0562 (the series of the cube).
        self.assertTrue(0.044 < largest < 0.049)
        mesh = meshio.read(self.folder / "poisson.vtu")
        self.assertEqual({block.type for block in mesh.cells}, {"tetra", "triangle"})
        self.assertIn("u", mesh.point_data)

    @needs("pgdr", "dolfinx", "meshio", "h5py")
    def test_flow_box(self):
        slowest, fastest = self.numbers(r"speeds from ([\d.]+) to ([\d.]+)", self.by_python("flow_box.py"))
        # A sphere would have 0 and 1.5 times the flow's speed; this body is longer, with edges.
        self.assertTrue(0 <= slowest < 0.7 and 1.2 < fastest < 2)
        self.assertTrue((self.folder / "flow.xdmf").exists())

    @needs("pgdr", "scipy", "matplotlib")
    def test_scan_to_picture(self):
        import numpy as np
        from scipy.spatial import ConvexHull

        step = np.arange(400) + 0.5
        polar, turn = np.arccos(1 - step / 200), np.pi * (1 + 5**0.5) * step
        points = np.stack([np.cos(turn) * np.sin(polar), np.sin(turn) * np.sin(polar), np.cos(polar)], axis=1)
        triangles = [t if np.linalg.det(points[t]) > 0 else t[::-1] for t in ConvexHull(points).simplices]
        bumps = points * (1 + 0.1 * np.sin(5 * points[:, :1]) * np.cos(4 * points[:, 2:]))
        for holes in (0, 1):  # the second one needs a repair
            kept = triangles[holes:]
            lines = ["OFF", f"{len(bumps)} {len(kept)} 0", *(" ".join(map(str, p)) for p in bumps), *(f"3 {t[0]} {t[1]} {t[2]}" for t in kept)]
            (self.folder / "scan.off").write_text("\n".join(lines) + "\n")
            text = self.by_python("scan_to_picture.py", "scan.off", "scan.png")
            self.assertEqual("repaired" in text, holes == 1)
            self.assertGreater(self.numbers(r"cut ([\d.]+) degrees", text)[0], 5)
            self.assertEqual((self.folder / "scan.png").read_bytes()[:4], PNG)

    @unittest.skipUnless(APP and Path("/usr/share/cmake/deal.II").exists() and shutil.which("cmake"), "no deal.II")
    def test_two_materials(self):
        self.output_of("cmake", "-S", EXAMPLES / "dealii", "-B", "build", "-DCMAKE_BUILD_TYPE=Release")
        self.output_of("cmake", "--build", "build")
        for version in ("4.1-ascii", "2.2"):
            self.output_of(APP, "mesh", EXAMPLES / "dealii/wall.poly", "--size", "0.2", "--gmsh-format", version, "--outer-triangles", "--quiet", "-o", "wall.msh")
            tetrahedra, error = self.numbers(r"(\d+) tetrahedra, .* largest error ([\d.e+-]+)", self.output_of("build/two_materials", "wall.msh", "wall.vtu"))
            self.assertTrue(tetrahedra > 500 and error < 1e-8)


if __name__ == "__main__":
    APP = APP and str(Path(APP).resolve())
    ran = unittest.main(exit=False, verbosity=2).result
    sys.exit(1 if not ran.wasSuccessful() else SKIPPED if len(ran.skipped) == ran.testsRun else 0)
