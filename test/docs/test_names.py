#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every file and every name of the code that ARCHITECTURE.md, docs/theory.md and docs/robustness.md quote exists."""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DOCUMENTS = ["ARCHITECTURE.md", "docs/theory.md", "docs/robustness.md"]
FOLDERS = ["include", "src", "apps", "python", "test", "bench", "examples", "cmake", "scripts", "docs"]
# Of libraries, of the language, of models, and of versions before.
FOREIGN = re.compile(r"^(CGAL|std|tbb)::|^(insert|create_cell|set_neighbor|info|Polyhedron_3|Surface_mesh|FaceListGraph|small_vector|disjoint_sets|BASELINE|voron_\w+)$")


def main():
    files = [p for folder in FOLDERS for p in (ROOT / folder).rglob("*") if p.is_file() and "node_modules" not in p.parts]
    names = {p.name for p in files}
    code = " ".join(p.read_text(encoding="utf-8", errors="replace") for p in files if p.suffix in {".h", ".cpp", ".py", ".js", ".cmake", ".txt", ""} and p != Path(__file__).resolve())
    words = set(re.findall(r"[A-Za-z_]\w+", code))
    unknown = []
    for document in DOCUMENTS:
        for quoted in sorted(set(re.findall(r"`([^`\n]+)`", (ROOT / document).read_text(encoding="utf-8")))):
            path = quoted.rstrip("/")
            if re.fullmatch(r"[\w./-]+\.(h|cpp|py|cmake)", path):  # a file, with or without its folders
                known = path.split("/")[-1] in names and ("/" not in path or any(p.as_posix().endswith("/" + path) for p in files))
            elif re.fullmatch(r"~?[A-Za-z_]\w*(::\w+)*(\(\))?", quoted) and not FOREIGN.search(quoted):  # a name
                known = all(part in words for part in re.findall(r"\w+", quoted))
            else:
                continue
            if not known:
                unknown.append(f"{document}: `{quoted}`")
    if unknown:
        sys.exit("nothing is called so any more:\n" + "\n".join(unknown))


if __name__ == "__main__":
    main()
