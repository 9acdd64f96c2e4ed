#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fails when a file breaks the rules of the house (ARCHITECTURE.md says why they are there).

usage: check_includes.py ROOT

Prints `FILE:LINE: rule` and the offending line for each violation; exit code 1 if there is any.
"""

import re
import sys
from pathlib import Path

MAX_LINES = 500
# For a room that must not grow again: the most files and lines in include/.
BUDGET = {"acute": (6, 900)}
FRONT_DOORS = {"refine_mesh_3.h", "make_mesh_3.h", "mesh_domain.h"}
# Rooms that come after everything: only the front doors include them.
LAST_ROOMS = {"slivers", "cgal"}
OPEN_TO_ALL = {"parameters.h"}

# For a room: the rooms that it may include besides itself. A room that is not listed may include every
# room that FORBIDDEN does not name.
ALLOWED = {
    "parallel": set(),
    "octree": set(),
    "independence": {"octree"},
    "simplify": {"domain", "parallel"},
    "repair": {"domain"},
    "mirrors": {"domain"},
    "acute": {"mirrors", "domain", "mesh"},
    "cgal": {"domain", "mesh", "refinement", "parallel"},
}
# For a room: the rooms that it must not include.
FORBIDDEN = {
    "schedule": {"mesh", "conforming", "acute", "mirrors"},
    "refinement": {"schedule"},
    "slivers": {"schedule", "io", "quality"},
    "conforming": {"schedule", "parallel"},
    "mesh": {"schedule", "parallel", "refinement", "conforming", "acute", "mirrors", "io", "quality", "report"},
    "domain": {"mesh", "refinement", "conforming", "acute", "mirrors", "schedule", "io", "quality", "report"},
    "sizing": {"mesh", "refinement", "conforming", "acute", "mirrors", "schedule", "io", "quality", "report"},
    "io": {"refinement", "conforming", "acute", "mirrors", "schedule"},
    "quality": {"refinement", "conforming", "acute", "mirrors", "schedule"},
}
# The engine is sequential; these headers of its room come after it.
AFTER_REFINEMENT = {"refinement/indexed_mesh_of_3.h", "refinement/canonical_order.h", "refinement/sort_tetrahedra.h"}
TBB = re.compile(r"^(tbb|oneapi)/")
HAS_TBB = "CGAL_LINKED_WITH_TBB"
THREADS = {"thread", "mutex", "shared_mutex", "condition_variable", "future", "semaphore", "barrier", "latch"}
CHANGES_TRIANGULATION = re.compile(
    r"\b(insert_in_hole|create_cell|create_vertex|delete_cell|delete_vertex|create_star_3|"
    r"set_neighbors?|set_vertex|set_vertices|set_adjacency)\s*\("
)
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
SOURCES = {".h", ".hpp", ".cpp"}
FOLDERS = ("include", "src", "apps", "test", "bench", "examples")


def without_comments(lines):
    """The same lines with comments blanked out; strings are not parsed, no rule needs it."""
    inside = False
    for line in lines:
        code = ""
        while line:
            if inside:
                end = line.find("*/")
                line, inside = ("", True) if end < 0 else (line[end + 2:], False)
                continue
            start = re.search(r"//|/\*", line)
            if not start:
                code, line = code + line, ""
            elif start.group() == "//":
                code, line = code + line[: start.start()], ""
            else:
                code, line, inside = code + line[: start.start()], line[start.end():], True
        yield code


def room_of(path):
    """`octree` for octree/morton.h, "" for a header at the top."""
    return path.split("/")[0] if "/" in path else ""


def included(header, delimiter, target):
    """The path below include/pgdr that `target` means, or None for somebody else's header."""
    if target.startswith("pgdr/"):
        return target[len("pgdr/"):]
    if delimiter == '"':
        parts = []
        for part in ((Path(header).parent / target).as_posix()).split("/"):
            parts = parts[:-1] if part == ".." and parts else parts + [part]
        return "/".join(parts)
    return None


def check_header(header, lines):
    """Violations (line number, rule) of one header, and the rooms that it includes with the line."""
    room, violations, edges = room_of(header), [], []
    for number, line in enumerate(without_comments(lines), 1):
        if room != "mesh" and CHANGES_TRIANGULATION.search(line):
            violations.append((number, "only mesh/ may change a triangulation"))
        if room != "parallel" and HAS_TBB in line:
            violations.append((number, "only parallel/ may ask whether there is TBB"))
        match = INCLUDE.match(line)
        if not match:
            continue
        delimiter, target = match.groups()
        if TBB.match(target) and room != "parallel":
            violations.append((number, "only parallel/ may include TBB"))
        if room in ("refinement", "conforming", "octree", "independence") and target in THREADS:
            violations.append((number, f"{room}/ must not know of threads"))
        path = included(header, delimiter, target)
        if path is None or path in OPEN_TO_ALL:
            continue
        if path in FRONT_DOORS:
            if room != "":
                violations.append((number, f"nothing inside the house includes a front door, {path}"))
            continue
        other = room_of(path)
        if room == "" or other == room:
            if header in OPEN_TO_ALL:
                violations.append((number, f"{header} is open to all and must not include rooms"))
            continue
        if other == "":
            violations.append((number, f"{room}/ must not include {path} at the top"))
        elif other in LAST_ROOMS or other in FORBIDDEN.get(room, ()) or (room in ALLOWED and other not in ALLOWED[room]):
            violations.append((number, f"{room}/ must not include {other}/"))
        elif room == "refinement" and other == "parallel" and header not in AFTER_REFINEMENT:
            violations.append((number, "the engine in refinement/ must not include parallel/"))
        else:
            edges.append((room, other, number))
    return violations, edges


def find_cycle(graph):
    """A list of rooms that include each other in a circle, or None."""
    done, path = set(), []

    def visit(room):
        if room in path:
            return path[path.index(room):] + [room]
        if room in done:
            return None
        path.append(room)
        for other in sorted(graph.get(room, ())):
            cycle = visit(other)
            if cycle:
                return cycle
        path.pop()
        done.add(room)
        return None

    for room in sorted(graph):
        cycle = visit(room)
        if cycle:
            return cycle
    return None


def check_tree(root):
    """All violations below `root`, as printable strings; and the number of files looked at."""
    root, messages, graph, count, sizes = Path(root), [], {}, 0, {}
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in SOURCES or not path.is_file():
                continue
            count += 1
            name = path.relative_to(root).as_posix()
            lines = path.read_text(encoding="utf-8").splitlines()
            if len(lines) > MAX_LINES and not any(re.search(r"//.*\bLength:", line) for line in lines):
                messages.append(f"{name}:{len(lines)}: more than {MAX_LINES} lines without a comment 'Length:' that says why")
            room_file = re.sub("^(include/pgdr|src)/", "", name)
            if room_file == name or (folder == "src" and room_of(room_file) == ""):
                continue  # tests, programs and instantiations stand outside the house
            sizes.setdefault(room_of(room_file), []).append(len(lines))
            violations, edges = check_header(room_file, lines)
            messages += [f"{name}:{number}: {rule}\n    {lines[number - 1].strip()}" for number, rule in violations]
            for room, other, number in edges:
                graph.setdefault(room, {}).setdefault(other, f"{name}:{number}: {lines[number - 1].strip()}")
    for room, (files, lines) in BUDGET.items():
        found = sizes.get(room, [])
        if len(found) > files or sum(found) > lines:
            messages.append(f"{room}/ has {len(found)} files and {sum(found)} lines, more than {files} or {lines}")
    cycle = find_cycle(graph)
    if cycle:
        steps = [graph[a][b] for a, b in zip(cycle, cycle[1:])]
        messages.append("the rooms include each other in a circle: " + " -> ".join(cycle) + "".join(f"\n    {s}" for s in steps))
    return messages, count


def main(arguments):
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    messages, count = check_tree(arguments[0])
    if count == 0:
        messages.append(f"{arguments[0]}: no sources found")
    for message in messages:
        print(message)
    print(f"{count} files, {len(messages)} violations")
    return 1 if messages else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
