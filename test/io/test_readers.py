#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What programs other than meshio and VTK (see read_back.py) find in our files: as many tetrahedra, names, and second order. One that is not installed is left out."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77
DATA = Path(__file__).resolve().parents[2] / "data"
APP = os.environ.get("PGDR_APP", "")
NAMES = {"inlet", "left"}
FOAM = {**os.environ, "WM_PROJECT_DIR": "/usr/share/openfoam"}


def output_of(*command, folder, **options):
    run = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300, check=False, **options)
    assert run.returncode == 0, f"{command}:\n{run.stdout[-2000:]}"
    return run.stdout


def by_gmsh(folder, file, names):
    """Gmsh writes what it has read in its oldest format, with a line for each element."""
    output_of("gmsh", file, "-save_all", "-save", "-format", "msh22", "-v", "2", "-o", "again.msh", folder=folder)
    text = (folder / "again.msh").read_text(encoding="utf-8")
    if names:
        assert NAMES <= set(re.findall(r'"(.*)"', text)), text[:500]
    return len(re.findall(r"^\d+ (?:4|11) ", text, re.M))


def by_tetgen(folder, file, names):
    del names  # TetGen's files have numbers only
    return int(re.search(r"Input tetrahedra: (\d+)", output_of("tetgen", "-rNEF", Path(file).stem, folder=folder))[1])


def by_openfoam(folder, file, names):
    case = folder / "case"
    (case / "system").mkdir(parents=True, exist_ok=True)
    head = "FoamFile{version 2.0; format ascii; class dictionary; object controlDict;}\n"
    (case / "system" / "controlDict").write_text(head + "application a; startFrom startTime; startTime 0; stopAt endTime; endTime 1; deltaT 1; writeControl timeStep; writeInterval 1;\n")
    output = output_of("gmshToFoam", folder / file, folder=case, env=FOAM)
    if names:
        assert "inlet" in (case / "constant/polyMesh/boundary").read_text(encoding="utf-8") and "cellZone left" in output
    owner = (case / "constant/polyMesh/owner").read_text(encoding="utf-8")
    return int(re.search(r"nCells: ?(\d+)", owner)[1])


def by_calculix(folder, file, names):
    """Solves for a load on the inlet; a set that is not there, or nodes in another order, would be an error."""
    del names
    sections = "".join(f"*SOLID SECTION, ELSET={s}, MATERIAL=M\n" for s in ("left", "region_20"))
    deck = f"*INCLUDE, INPUT={file}\n*MATERIAL, NAME=M\n*ELASTIC\n1,0.3\n{sections}*BOUNDARY\n9,1,3\n10,1,3\n11,1,3\n"
    (folder / "deck.inp").write_text(deck + "*STEP\n*STATIC\n*DSLOAD\ninlet,P,1\n*EL PRINT, ELSET=left, TOTALS=ONLY\nEVOL\n*EL PRINT, ELSET=region_20, TOTALS=ONLY\nEVOL\n*END STEP\n")
    assert "Job finished" in output_of("ccx", "deck", folder=folder)
    volumes = [float(v) for v in re.findall(r"^ +([\d.E+-]+)$", (folder / "deck.dat").read_text(encoding="utf-8"), re.M)]
    assert len(volumes) == 2 and all(abs(v - 1) < 1e-5 for v in volumes), volumes
    text = (folder / file).read_text(encoding="utf-8")  # it does not say how many it has
    return len(re.findall(r"^\d+(?:,\d+){4}$|^\d+(?:,\d+){10}$", text[text.index("*ELEMENT"):], re.M))


# Program, function, file, whether names are in it, options.
READERS = [
    ("gmsh", by_gmsh, "a.msh", True, []),
    ("gmsh", by_gmsh, "a.msh", True, ["--gmsh-format", "2.2"]),
    ("gmsh", by_gmsh, "a.msh", True, ["--order", "2"]),
    ("gmsh", by_gmsh, "a.mesh", False, []),
    ("gmsh", by_gmsh, "a.vtk", False, []),
    ("gmsh", by_gmsh, "a.vtk", False, ["--order", "2"]),
    ("gmshToFoam", by_openfoam, "a.msh", True, ["--gmsh-format", "2.2"]),
    ("tetgen", by_tetgen, "a.ele", False, []),
    ("tetgen", by_tetgen, "a.ele", False, ["--order", "2"]),
    ("ccx", by_calculix, "a.inp", True, []),
    ("ccx", by_calculix, "a.inp", True, ["--order", "2"]),
]


def main():
    if not APP:
        print("no program to test")
        return SKIPPED
    tried = 0
    for program, count, file, names, options in READERS:
        if not shutil.which(program):
            print(f"{program} is not installed: {file} left out")
            continue
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            mesh = [APP, "mesh", DATA / "two_regions.poly", "--size", "0.4", "--quiet", "--name-region", "10=left", "--name-marker", "1=inlet", "-o", file, *options]
            output_of(*mesh, "--stats", "stats.json", folder=folder)
            expected = int(re.search(r'"tetrahedra": *(\d+)', (folder / "stats.json").read_text(encoding="utf-8"))[1])
            found = count(folder, file, names)
            assert found == expected > 100, f"{program} finds {found} of {expected} tetrahedra in {file} {options}"
        tried += 1
    return 0 if tried else SKIPPED


if __name__ == "__main__":
    sys.exit(main())
