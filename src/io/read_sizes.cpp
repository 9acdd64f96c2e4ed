// SPDX-License-Identifier: GPL-3.0-or-later
#include <pgdr/io/read_sizes.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <pgdr/domain/input_error.h>

#include "file_text.h"
#include "vtk_xml.h"

namespace pgdr {
namespace {

using io_detail::Vtk_xml;

/// Of points, else of cells.
std::pair<std::vector<double>, bool> values_of(const Vtk_xml& file, const std::string& array) {
  for (const bool is_of_cells : {false, true})
    if (auto values = file.array(is_of_cells ? "CellData" : "PointData", array)) return {std::move(*values), is_of_cells};
  std::string known;
  for (const char* section : {"PointData", "CellData"})
    for (const std::string& name : file.names(section)) known += (known.empty() ? ", but " : ", ") + name;
  file.fail("it has no array '" + array + "' of one component" + known);
}

/// Values of cells at their nodes; nodes of no cell are left out.
Nodal_values averaged(const Vtk_xml& file, const Nodal_values& nodes, const std::vector<double>& of_cells) {
  const std::vector<double> connectivity = file.array("Cells", "connectivity").value_or(std::vector<double>{}),
                            offsets = file.array("Cells", "offsets").value_or(std::vector<double>{});
  if (offsets.size() != of_cells.size()) file.fail("it has " + std::to_string(of_cells.size()) + " values for " + std::to_string(offsets.size()) + " cells");
  std::vector<double> sum(nodes.points.size()), count(nodes.points.size());
  std::size_t i = 0;
  for (std::size_t cell = 0; cell < offsets.size(); ++cell)
    for (; static_cast<double>(i) < offsets[cell]; ++i) {
      if (i >= connectivity.size() || !(connectivity[i] >= 0 && connectivity[i] < static_cast<double>(sum.size()))) file.fail("its cells name points that are not there");
      const auto v = static_cast<std::size_t>(connectivity[i]);
      sum[v] += of_cells[cell];
      count[v] += 1;
    }
  Nodal_values result;
  for (std::size_t v = 0; v < sum.size(); ++v)
    if (count[v] > 0) {
      result.points.push_back(nodes.points[v]);
      result.values.push_back(sum[v] / count[v]);
    }
  return result;
}

Nodal_values read_grid(const Vtk_xml& file, const std::string& array) {
  const std::vector<double> c = file.array("Points", "", 3).value_or(std::vector<double>{});
  Nodal_values nodes;
  for (std::size_t i = 0; i + 2 < c.size(); i += 3) nodes.points.push_back({c[i], c[i + 1], c[i + 2]});
  auto [values, is_of_cells] = values_of(file, array);
  if (is_of_cells) return averaged(file, nodes, values);
  nodes.values = std::move(values);
  if (nodes.values.size() != nodes.points.size())
    file.fail("its array '" + array + "' has " + std::to_string(nodes.values.size()) + " values for " + std::to_string(nodes.points.size()) + " points");
  return nodes;
}

Nodal_values read_image(const Vtk_xml& file, const std::string& array) {
  const std::vector<double> extent = file.attribute_numbers("ImageData", "WholeExtent");
  constexpr double most = 1 << 30;
  if (extent.size() != 6 || !std::ranges::all_of(extent, [](double e) { return std::abs(e) <= most && e == std::floor(e); })) file.fail("its image has no extent of whole numbers");
  const std::vector<double> direction = file.attribute_numbers("ImageData", "Direction");
  if (!direction.empty() && direction != std::vector<double>{1, 0, 0, 0, 1, 0, 0, 0, 1}) file.fail("its image is turned (Direction), which is not read");
  std::vector<double> origin = file.attribute_numbers("ImageData", "Origin"), spacing = file.attribute_numbers("ImageData", "Spacing");
  origin.resize(3, 0);
  spacing.resize(3, 1);
  auto [values, is_of_cells] = values_of(file, array);
  const double shift = is_of_cells ? 0.5 : 0;
  const auto last = [&, less = is_of_cells ? 1 : 0](std::size_t d) { return extent[2 * d + 1] - less; };
  const auto is_empty = [&](std::size_t d) { return last(d) < extent[2 * d]; };
  if (is_empty(0) || is_empty(1) || is_empty(2) || !((last(0) - extent[0] + 1) * (last(1) - extent[2] + 1) * (last(2) - extent[4] + 1) == static_cast<double>(values.size())))
    file.fail("its array '" + array + "' does not fit the image's extent");
  Nodal_values nodes;
  Sizing_grid& grid = nodes.grid.emplace();
  for (std::size_t d = 0; d < 3; ++d) {
    grid.nodes[d] = static_cast<std::size_t>(last(d) - extent[2 * d] + 1);
    grid.spacing[d] = spacing[d];
    grid.origin[d] = origin[d] + (extent[2 * d] + shift) * spacing[d];
  }
  for (std::size_t i = 0; i < grid.size(); ++i) nodes.points.push_back(grid.point(i));
  nodes.values = std::move(values);
  return nodes;
}

}  // namespace

Nodal_values read_nodal_values(const std::filesystem::path& path, const std::string& array) {
  const io_detail::File_text text(path);
  const Vtk_xml file(text.view(), path);
  Nodal_values values;
  if (file.type() == "UnstructuredGrid") values = read_grid(file, array);
  else if (file.type() == "ImageData") values = read_image(file, array);
  else file.fail("it holds '" + std::string(file.type()) + "', not an unstructured grid or image data");
  if (values.points.empty()) io_detail::fail_at(path, 0, Input_problem::Kind::empty, "it has no points");
  return values;
}

}  // namespace pgdr
