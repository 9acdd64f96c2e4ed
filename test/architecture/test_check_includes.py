# SPDX-License-Identifier: GPL-3.0-or-later
"""Every rule of check_includes.py fails on a tree that breaks it, and a good tree passes."""

import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from check_includes import check_tree, main  # noqa: E402

GOOD = {
    "include/pgdr/refine_mesh_3.h": "#include <pgdr/refinement/refiner.h>\n#include <pgdr/io/writer.h>\n",
    "include/pgdr/make_mesh_3.h": "#include <pgdr/refine_mesh_3.h>\n#include <pgdr/cgal/complex.h>\n",
    "include/pgdr/cgal/complex.h": "#include <pgdr/refinement/refiner.h>\n#include <pgdr/parallel/loop.h>\n",
    "include/pgdr/parameters.h": "#include <functional>\n",
    "include/pgdr/domain/plc.h": "#include <pgdr/parameters.h>\n",
    "include/pgdr/mesh/cavity.h": "#include <pgdr/domain/plc.h>\nvoid f() { tds.create_cell(); }\n",
    "include/pgdr/refinement/refiner.h": '#include "../mesh/cavity.h"\n// tr.insert_in_hole(p) is called in mesh/\n',
    "include/pgdr/refinement/queue.h": "#include <atomic>\n/* #include <thread>\n   */ #include <queue>\n",
    "include/pgdr/io/writer.h": "#include <pgdr/domain/plc.h>\n",
    "include/pgdr/octree/morton.h": "#include <cstdint>\n",
    "include/pgdr/independence/zone.h": "#include <pgdr/octree/morton.h>\n",
    "include/pgdr/schedule/epochs.h": "#include <pgdr/parallel/loop.h>\n#include <pgdr/octree/morton.h>\n",
    "include/pgdr/parallel/loop.h": "#ifdef CGAL_LINKED_WITH_TBB\n#endif\n#include <oneapi/tbb/parallel_for.h>\n",
    "include/pgdr/refinement/indexed_mesh_of_3.h": "#include <pgdr/parallel/loop.h>\n",
    "include/pgdr/quality/measure.h": "#include <pgdr/parallel/loop.h>\n",
    "src/refine.cpp": "#include <pgdr/refine_mesh_3.h>\n",
    "src/long.cpp": "// Length: a table\n" + "int x;\n" * 600,
}

BAD = [  # (file, contents, what the message says)
    ("octree/a.h", "#include <pgdr/mesh/cavity.h>\n", "octree/ must not include mesh/"),
    ("octree/a.h", "#include <pgdr/schedule/epochs.h>\n", "octree/ must not include schedule/"),
    ("octree/a.h", "#  include <oneapi/tbb.h>\n", "only parallel/ may include TBB"),
    ("independence/a.h", "#include <pgdr/refinement/refiner.h>\n", "independence/ must not include refinement/"),
    ("independence/a.h", "#include <tbb/tbb.h>\n", "only parallel/ may include TBB"),
    ("io/a.h", "#include <tbb/parallel_for.h>\n", "only parallel/ may include TBB"),
    ("schedule/a.h", "#include <tbb/task_arena.h>\n", "only parallel/ may include TBB"),
    ("slivers/a.h", "#ifdef CGAL_LINKED_WITH_TBB\n", "only parallel/ may ask whether there is TBB"),
    ("schedule/a.h", "#include <pgdr/mesh/cavity.h>\n", "schedule/ must not include mesh/"),
    ("refinement/a.h", "#include <pgdr/schedule/epochs.h>\n", "refinement/ must not include schedule/"),
    ("refinement/a.h", "#include <thread>\n", "refinement/ must not know of threads"),
    ("refinement/a.h", "#include <mutex>\n", "refinement/ must not know of threads"),
    ("io/a.h", "#include <pgdr/refinement/refiner.h>\n", "io/ must not include refinement/"),
    ("io/a.h", '#include "../conforming/a.h"\n', "io/ must not include conforming/"),
    ("quality/a.h", "#include <pgdr/conforming/a.h>\n", "quality/ must not include conforming/"),
    ("quality/a.h", "#include <pgdr/refinement/refiner.h>\n", "quality/ must not include refinement/"),
    ("quality/a.h", "#include <pgdr/acute/angles.h>\n", "quality/ must not include acute/"),
    ("acute/a.h", "#include <pgdr/refinement/refiner.h>\n", "acute/ must not include refinement/"),
    ("refinement/a.h", "#include <pgdr/parallel/loop.h>\n", "the engine in refinement/ must not include parallel/"),
    ("conforming/a.h", "#include <pgdr/parallel/loop.h>\n", "conforming/ must not include parallel/"),
    ("mesh/a.h", "#include <pgdr/parallel/loop.h>\n", "mesh/ must not include parallel/"),
    ("octree/a.h", "#include <pgdr/parallel/loop.h>\n", "octree/ must not include parallel/"),
    ("independence/a.h", "#include <pgdr/parallel/loop.h>\n", "independence/ must not include parallel/"),
    ("parallel/a.h", "#include <pgdr/mesh/cavity.h>\n", "parallel/ must not include mesh/"),
    ("quality/a.h", "#include <tbb/parallel_for.h>\n", "only parallel/ may include TBB"),
    ("refinement/a.h", "void f() { tr.tds().delete_cell(c); }\n", "only mesh/ may change a triangulation"),
    ("conforming/a.h", "auto v = tr.insert_in_hole (p, b, e, c, i);\n", "only mesh/ may change a triangulation"),
    ("refinement/a.h", "#include <pgdr/refine_mesh_3.h>\n", "nothing inside the house includes a front door"),
    ("io/a.h", "#include <pgdr/make_mesh_3.h>\n", "nothing inside the house includes a front door"),
    ("io/a.h", "#include <pgdr/cgal/complex.h>\n", "io/ must not include cgal/"),
    ("report/a.h", "#include <pgdr/slivers/a.h>\n", "report/ must not include slivers/"),
    ("cgal/a.h", "#include <pgdr/schedule/epochs.h>\n", "cgal/ must not include schedule/"),
    ("parameters.h", "#include <pgdr/domain/plc.h>\n", "must not include rooms"),
    ("sizing/a.h", "int x;\n" * 501, "more than 500 lines"),
]


def write_tree(root, files):
    for name, contents in files.items():
        path = Path(root) / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(contents)


class CheckIncludes(unittest.TestCase):
    def messages(self, extra):
        with tempfile.TemporaryDirectory() as root:
            write_tree(root, {**GOOD, **extra})
            return check_tree(root)[0]

    def test_a_good_tree_passes(self):
        self.assertEqual(self.messages({}), [])

    def test_every_rule_fails_on_a_tree_that_breaks_it(self):
        for name, contents, expected in BAD:
            with self.subTest(file=name, rule=expected):
                messages = self.messages({"include/pgdr/" + name: contents})
                self.assertEqual(len(messages), 1, messages)
                self.assertIn(expected, messages[0])
                self.assertIn(name, messages[0])

    def test_the_offending_line_is_printed(self):
        (message,) = self.messages({"include/pgdr/io/a.h": "\n#include <pgdr/refinement/refiner.h>\n"})
        self.assertIn("include/pgdr/io/a.h:2:", message)
        self.assertIn("#include <pgdr/refinement/refiner.h>", message)

    def test_a_circle_of_rooms_is_found(self):
        (message,) = self.messages({
            "include/pgdr/quality/a.h": "#include <pgdr/report/a.h>\n",
            "include/pgdr/report/a.h": "#include <pgdr/quality/a.h>\n",
        })
        self.assertIn("circle: quality -> report -> quality", message)

    def test_a_room_with_a_budget_does_not_grow(self):
        (message,) = self.messages({f"include/pgdr/acute/{name}.h": "int x;\n" for name in "abcdefg"})
        self.assertIn("acute/ has 7 files", message)
        (message,) = self.messages({f"include/pgdr/acute/{name}.h": "int x;\n" * 400 for name in "abc"})
        self.assertIn("1200 lines", message)

    def test_sources_of_a_room_obey_its_rules(self):
        (message,) = self.messages({"src/io/a.cpp": '#include "helper.h"\n#include <pgdr/refinement/refiner.h>\n'})
        self.assertIn("src/io/a.cpp:2: io/ must not include refinement/", message)

    def test_an_empty_tree_is_an_error(self):
        with tempfile.TemporaryDirectory() as root:
            self.assertEqual(main([root]), 1)


if __name__ == "__main__":
    unittest.main()
