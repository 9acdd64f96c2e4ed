// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include <pgdr/domain/vec_3.h>
#include <pgdr/domain/scale.h>
#include <pgdr/io/atomic_file.h>
#include <pgdr/io/write_problems.h>

namespace pgdr {

namespace {

/// The cells of an unstructured grid, with the vertices of the PLC that they use.
class Problem_cells {
 public:
  explicit Problem_cells(const Plc& plc) : plc_(plc), point_of_vertex_(plc.vertices.size(), none) {}

  void add(std::size_t problem, std::int64_t facet, const std::vector<Index>& corners) {
    if (corners.empty() || !std::ranges::all_of(corners, [this](Index v) { return is_drawable(v); })) return;
    for (const Index v : corners) {
      if (point_of_vertex_[v] == none) {
        point_of_vertex_[v] = vertices_.size();
        vertices_.push_back(v);
      }
      connectivity_ << point_of_vertex_[v] << ' ';
    }
    size_ += corners.size();
    offsets_ << size_ << ' ';
    types_ << (corners.size() == 1 ? vtk_vertex : corners.size() == 2 ? vtk_line : vtk_polygon) << ' ';
    problem_ << problem << ' ';
    facet_ << facet << ' ';
    ++count_;
  }

  std::string text() const {
    std::ostringstream points, numbers;
    points.precision(17);
    for (const Index v : vertices_) {
      const Vec_3 p = unit_of(plc_) * to_vec(plc_.vertices[v]);
      points << p.x << ' ' << p.y << ' ' << p.z << '\n';
      numbers << v + plc_.first_index << ' ';
    }
    std::ostringstream out;
    const auto array = [&out](const char* type, const char* name, const std::string& values, int components = 1) {
      out << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\"" << components
          << "\" format=\"ascii\">\n" << values << "\n</DataArray>\n";
    };
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
           "header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\""
        << vertices_.size() << "\" NumberOfCells=\"" << count_ << "\">\n<PointData>\n";
    array("Int32", "vertex", numbers.str());
    out << "</PointData>\n<CellData>\n";
    array("Int32", "problem", problem_.str());
    array("Int32", "facet", facet_.str());
    out << "</CellData>\n<Points>\n";
    array("Float64", "points", points.str(), 3);
    out << "</Points>\n<Cells>\n";
    array("Int32", "connectivity", connectivity_.str());
    array("Int32", "offsets", offsets_.str());
    array("UInt8", "types", types_.str());
    out << "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
    return out.str();
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  static constexpr int vtk_vertex = 1, vtk_line = 3, vtk_polygon = 7;

  bool is_drawable(Index v) const {
    if (v >= plc_.vertices.size()) return false;
    const Vec_3 p = to_vec(plc_.vertices[v]);
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  }

  const Plc& plc_;
  std::vector<std::size_t> point_of_vertex_;
  std::vector<Index> vertices_;
  std::ostringstream connectivity_, offsets_, types_, problem_, facet_;
  std::size_t size_ = 0, count_ = 0;
};

}  // namespace

void write_problems(const Plc& plc, const std::vector<Input_problem>& problems, const std::filesystem::path& path) {
  Problem_cells cells(plc);
  for (std::size_t i = 0; i < problems.size(); ++i) {
    for (const Index f : problems[i].facets)
      if (f < plc.facets.size())
        for (const auto& polygon : plc.facets[f].polygons)
          cells.add(i, static_cast<std::int64_t>(f + plc.first_index), polygon);
    if (problems[i].vertices.size() == 2)
      cells.add(i, -1, problems[i].vertices);
    else
      for (const Index v : problems[i].vertices) cells.add(i, -1, {v});
  }
  Atomic_file file(path);
  file.write(cells.text());
  file.commit();
}

}  // namespace pgdr
