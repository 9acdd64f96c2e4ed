// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/io/read_sizes.h>

#include <array>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <string>

#include <pgdr/domain/input_error.h>
#include <pgdr/io/write_mesh.h>

#include "../catch.h"
#include "../inputs.h"
#include "read_back.h"
#include "sample_mesh.h"
#include "temporary_folder.h"

namespace {

std::string failure_of(const std::filesystem::path& path, const std::string& array) {
  try {
    pgdr::read_nodal_values(path, array);
  } catch (const pgdr::Input_error& error) {
    return error.what();
  }
  return "read";
}

}  // namespace

TEST_CASE("arrays of points and cells are read from our own .vtu files, compressed or not") {
  const pgdr_test::Temporary_folder folder;
  const auto mesh = pgdr_test::sample_mesh(40);  // several blocks
  for (const int level : {0, 1, 9}) {
    pgdr::Write_options options;
    options.vtu.compression = level;
    pgdr::write_mesh(mesh, folder / "a.vtu", options);
    const auto of_points = pgdr::read_nodal_values(folder / "a.vtu", "reference");
    REQUIRE(of_points.points == mesh.points);
    CHECK(std::equal(of_points.values.begin(), of_points.values.end(), mesh.point_references.begin(), mesh.point_references.end()));
    const auto of_cells = pgdr::read_nodal_values(folder / "a.vtu", "region");
    REQUIRE(of_cells.points == mesh.points);
    for (const double v : of_cells.values) CHECK((1 <= v && v <= 3));
  }
  CHECK(failure_of(folder / "a.vtu", "none").find("no array 'none' of one component, but in_dimension, reference, region") != std::string::npos);
}

TEST_CASE("all encodings of VTK's XML files are read") {
  const pgdr_test::Temporary_folder folder;
  const std::string script =
      "import sys, numpy as n\n"
      "try:\n"
      "    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter, vtkXMLImageDataWriter\n"
      "    from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid, vtkImageData\n"
      "    from vtkmodules.vtkCommonCore import vtkPoints, vtkFloatArray\n"
      "except ImportError:\n"
      "    sys.exit(77)\n"
      "def field(name, values):\n"
      "    a = vtkFloatArray(); a.SetName(name)\n"
      "    [a.InsertNextValue(v) for v in values]\n"
      "    return a\n"
      "g, p = vtkUnstructuredGrid(), vtkPoints()\n"
      "[p.InsertNextPoint(i, 0.5 * i, i * i) for i in range(5)]\n"
      "g.SetPoints(p)\n"
      "from vtkmodules.vtkCommonCore import vtkIdList\n"
      "for c in ((0, 1, 2, 3), (1, 2, 3, 4)):\n"
      "    ids = vtkIdList(); [ids.InsertNextId(i) for i in c]; g.InsertNextCell(10, ids)\n"
      "g.GetPointData().AddArray(field('h', [1, 2, 3, 4, 5.5])); g.GetCellData().AddArray(field('k', [2, 4]))\n"
      "m = vtkImageData(); m.SetOrigin(1, 2, 3); m.SetSpacing(0.5, 1, 2); m.SetExtent(0, 1, 0, 2, 0, 1)\n"
      "m.GetPointData().AddArray(field('h', range(12))); m.GetCellData().AddArray(field('k', [7, 8]))\n"
      "for i, (mode, coded, packed, wide) in enumerate([(0, 1, 0, 0), (1, 1, 0, 0), (1, 1, 1, 1), (2, 1, 1, 0), (2, 1, 0, 1), (2, 0, 1, 1), (2, 0, 0, 0)]):\n"
      "    for w, o, e in ((vtkXMLUnstructuredGridWriter(), g, 'vtu'), (vtkXMLImageDataWriter(), m, 'vti')):\n"
      "        w.SetDataMode(mode); w.SetEncodeAppendedData(coded); w.SetHeaderTypeToUInt64() if wide else w.SetHeaderTypeToUInt32()\n"
      "        w.SetCompressorTypeToZLib() if packed else w.SetCompressorTypeToNone()\n"
      "        w.SetInputData(o); w.SetFileName(sys.argv[1] + '/%d.%s' % (i, e)); w.Write()\n";
  folder.write("make.py", script);
  const int code = pgdr_test::run("'" + pgdr_test::python() + "' '" + (folder / "make.py").string() + "' '" + folder.path().string() + "'");
  if (code == 77) PGDR_SKIP("VTK's Python modules are not installed");
  REQUIRE(code == 0);
  for (int i = 0; i < 7; ++i) {
    INFO(i);
    const auto h = pgdr::read_nodal_values(folder / (std::to_string(i) + ".vtu"), "h");
    CHECK(h.values == std::vector<double>{1, 2, 3, 4, 5.5});
    REQUIRE(h.points.size() == 5);
    CHECK(h.points[3] == std::array<double, 3>{3, 1.5, 9});
    CHECK(pgdr::read_nodal_values(folder / (std::to_string(i) + ".vtu"), "k").values == std::vector<double>{2, 3, 3, 3, 4});
    const auto image = pgdr::read_nodal_values(folder / (std::to_string(i) + ".vti"), "h");
    REQUIRE(image.points.size() == 12);
    CHECK(image.points[0] == std::array<double, 3>{1, 2, 3});
    CHECK(image.points[11] == std::array<double, 3>{1.5, 4, 5});
    CHECK(image.values[11] == 11);
    REQUIRE(image.grid);
    CHECK(image.grid->nodes == std::array<std::size_t, 3>{2, 3, 2});
    CHECK(image.grid->spacing == std::array<double, 3>{0.5, 1, 2});
    const auto cells = pgdr::read_nodal_values(folder / (std::to_string(i) + ".vti"), "k");
    REQUIRE(cells.points.size() == 2);
    CHECK(cells.points[1] == std::array<double, 3>{1.25, 3.5, 4});
  }
}

TEST_CASE("a background file that is cut off or wrong is refused, wherever it is cut") {
  const pgdr_test::Temporary_folder folder;
  pgdr::write_mesh(pgdr_test::sample_mesh(4), folder / "a.vtu");
  std::ifstream in(folder / "a.vtu", std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  std::size_t read = 0;
  for (std::size_t size = 0; size < whole.size(); size += 7) {
    folder.write("b.vtu", whole.substr(0, size));
    read += failure_of(folder / "b.vtu", "region") == "read";
  }
  CHECK(read * 7 < 60 + whole.size() / 20);  // the last array is not needed
  for (std::size_t at = 0; at < whole.size(); at += 11) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 0x55);
    folder.write("b.vtu", changed);
    failure_of(folder / "b.vtu", "region");  // read or refused, never worse
  }
  CHECK(failure_of(folder / "missing.vtu", "h") != "read");
}
