// SPDX-License-Identifier: GPL-3.0-or-later
// VTK's XML format: K. Martin et al., VTK file formats, "XML file formats", with appended raw data.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include <zlib.h>

#include <pgdr/domain/scale.h>
#include <pgdr/io/atomic_file.h>
#include <pgdr/io/output_error.h>
#include <pgdr/io/vtu.h>
#include <pgdr/parallel/parallel_in_order.h>
#include <pgdr/quality/measures.h>

#include "mesh_groups.h"

namespace pgdr {
namespace {

constexpr std::size_t block_bytes = std::size_t(1) << 16;

/// One zlib stream, used anew for each block.
class Compressor {
 public:
  explicit Compressor(int level) : input_(block_bytes) {
    if (deflateInit(&stream_, level) != Z_OK) throw std::bad_alloc();
    output_.resize(deflateBound(&stream_, block_bytes));
  }
  ~Compressor() { deflateEnd(&stream_); }
  Compressor(const Compressor&) = delete;
  Compressor& operator=(const Compressor&) = delete;

  /// Where the bytes to compress go, `block_bytes` at most.
  unsigned char* input() { return input_.data(); }

  /// Compresses the first `size` bytes of the input.
  void compress(std::size_t size) {
    deflateReset(&stream_);
    stream_.next_in = input_.data();
    stream_.avail_in = static_cast<uInt>(size);
    stream_.next_out = output_.data();
    stream_.avail_out = static_cast<uInt>(output_.size());
    if (deflate(&stream_, Z_FINISH) != Z_STREAM_END) throw Output_error("zlib failed to compress a block");
  }

  /// What the last call has made.
  const void* output() const { return output_.data(); }
  std::size_t output_size() const { return output_.size() - stream_.avail_out; }

 private:
  z_stream stream_{};
  std::vector<unsigned char> input_;
  std::vector<Bytef> output_;
};

/// An array of the file: its header element first, its data later.
struct Data_array {
  const char* type;
  const char* name;
  std::size_t components;
  std::uint64_t offset_position = 0;  ///< where in the file the value of its `offset` attribute stands
};

/// The tetrahedra, then the triangles if they are wanted: all cells of the grid.
class Vtu_writer {
 public:
  Vtu_writer(const Indexed_mesh_3& mesh, const Vtu_options& options, Atomic_file& out)
      : mesh_(mesh), options_(options), out_(out), tetrahedra_(io_detail::tetrahedra_of(mesh, io_detail::edges_in_vtk)), triangles_(io_detail::triangles_of(mesh)) {
    corners_ = tetrahedra_.size() * tetrahedra_.nodes_of_each();
    cells_ = tetrahedra_.size();
    if (options.triangles) cells_ += triangles_.size();
    const std::size_t largest = std::max(mesh.points.size(), offset(cells_));
    wide_ = largest > std::size_t(std::numeric_limits<std::int32_t>::max());
  }

  void write() {
    const char* const index_type = wide_ ? "Int64" : "Int32";
    Data_array in_dimension{"UInt8", "in_dimension", 1}, reference{"Int32", "reference", 1};
    Data_array points{"Float64", "Points", 3};
    Data_array connectivity{index_type, "connectivity", 1}, offsets{index_type, "offsets", 1},
        types{"UInt8", "types", 1};
    const bool dimensions = !mesh_.point_dimensions.empty();

    out_.write("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"");
    out_.write(std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian");
    out_.write("\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<UnstructuredGrid>\n");
    write_names();
    out_.write("<Piece NumberOfPoints=\"" + std::to_string(mesh_.points.size()) + "\" NumberOfCells=\"" +
               std::to_string(cells_) + "\">\n<PointData>\n");
    if (dimensions) declare(in_dimension);
    declare(reference);
    out_.write("</PointData>\n<CellData>\n");
    for (Data_array* array : {&region_, &ratio_, &angle_, &exempt_, &unrefined_}) declare(*array);
    if (options_.triangles)
      for (Data_array* array : {&marker_, &attribute_}) declare(*array);
    if (has_input_facets()) declare(input_facet_);
    out_.write("</CellData>\n<Points>\n");
    declare(points);
    out_.write("</Points>\n<Cells>\n");
    for (Data_array* array : {&connectivity, &offsets, &types}) declare(*array);
    out_.write("</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");

    data_begin_ = out_.position();
    // The last array first: meshio replaces offsets by others while it looks for the next one, and takes the first array that has it.
    append_by_kind<std::uint8_t>(
        types, [type = tetrahedron_type()](std::size_t) { return type; }, [type = triangle_type()](std::size_t) { return type; });
    if (wide_)
      append_cells<std::int64_t>(connectivity, offsets);
    else
      append_cells<std::int32_t>(connectivity, offsets);
    append<Indexed_mesh_3::Point>(points, mesh_.points.size(),
                                  [&, unit = unit_of(mesh_)](std::size_t i) {
                                    const auto& [x, y, z] = mesh_.points[i];
                                    return Indexed_mesh_3::Point{unit * x, unit * y, unit * z};
                                  });
    append_cell_data();
    append<std::int32_t>(reference, mesh_.points.size(),
                         [&](std::size_t i) { return io_detail::reference_of(mesh_.point_references, i); });
    if (dimensions)
      append<std::uint8_t>(in_dimension, mesh_.points.size(),
                           [&](std::size_t i) { return mesh_.point_dimensions[i]; });
    out_.write("\n</AppendedData>\n</VTKFile>\n");
  }

 private:
  // VTK's types of cells, of first and of second order.
  std::uint8_t tetrahedron_type() const { return mesh_.tetrahedron_nodes.empty() ? 10 : 24; }
  std::uint8_t triangle_type() const { return mesh_.triangle_nodes.empty() ? 5 : 22; }

  bool has_input_facets() const { return options_.triangles && !mesh_.triangle_input_facets.empty(); }

  /// The first `n` cells have so many nodes.
  std::size_t offset(std::size_t n) const {
    const std::size_t t = std::min(n, tetrahedra_.size());
    return t * tetrahedra_.nodes_of_each() + (n - t) * triangles_.nodes_of_each();
  }

  /// What numbers are called, as field data in the manner of meshio: an array with the name, its values the number and the dimension.
  void write_names() {
    const auto write_kind = [&](const std::map<int, std::string>& names, int dimension) {
      for (const auto& [number, name] : names)
        out_.write("<DataArray type=\"Int64\" Name=\"" + in_attribute(name) + "\" NumberOfTuples=\"2\" format=\"ascii\">\n" + std::to_string(number) + " " +
                   std::to_string(dimension) + "\n</DataArray>\n");
    };
    const Reference_names names = distinct_names(mesh_.names);
    if (names.regions.empty() && names.markers.empty()) return;
    out_.write("<FieldData>\n");
    write_kind(names.markers, 2);
    write_kind(names.regions, 3);
    out_.write("</FieldData>\n");
  }

  static std::string in_attribute(const std::string& name) {
    std::string text;
    for (const char c : io_detail::quotable(name)) text += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
    return text;
  }

  void declare(Data_array& array) {
    out_.write(std::string("<DataArray type=\"") + array.type + "\" Name=\"" + array.name +
               "\" NumberOfComponents=\"" + std::to_string(array.components) +
               "\" format=\"appended\" offset=");
    array.offset_position = out_.position();
    out_.write(std::string(offset_length, ' ') + "/>\n");
  }

  void append_cell_data() {
    const auto measured = [&](auto function) {
      return [&, function](std::size_t i) {
        const auto& t = mesh_.tetrahedra[i];
        return static_cast<float>(function(mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]], mesh_.points[t[3]]));
      };
    };
    const auto region = [&](std::size_t i) { return io_detail::reference_of(mesh_.tetrahedron_references, i); };
    const auto marker = [&](std::size_t i) { return io_detail::reference_of(mesh_.triangle_references, i); };
    const auto marked = [](const std::vector<std::uint32_t>& list) { return [&list](std::size_t i) { return std::uint8_t(std::ranges::binary_search(list, i)); }; };
    const auto nothing = [](std::size_t) { return 0; };
    if (has_input_facets())
      append_by_kind<std::int64_t>(input_facet_, [](std::size_t) { return -1; }, [&](std::size_t i) { return mesh_.triangle_input_facets[i]; });
    if (options_.triangles) {
      const std::vector<std::int32_t> regions = io_detail::tags_of(mesh_.tetrahedra.size(), mesh_.tetrahedron_references);
      const std::vector<std::int32_t> markers = io_detail::tags_of(mesh_.triangles.size(), mesh_.triangle_references);
      append_by_kind<std::int32_t>(attribute_, [&](std::size_t i) { return regions[i]; }, [&](std::size_t i) { return markers[i]; });
      append_by_kind<std::int32_t>(marker_, nothing, marker);
    }
    append_by_kind<std::uint8_t>(unrefined_, marked(mesh_.unrefined), nothing);
    append_by_kind<std::uint8_t>(exempt_, marked(mesh_.exempt), nothing);
    append_by_kind<float>(angle_, measured([](const auto&... p) { return smallest_dihedral_angle_deg(p...); }), nothing);
    append_by_kind<float>(ratio_, measured([](const auto&... p) { return radius_edge_ratio(p...); }), nothing);
    append_by_kind<std::int32_t>(region_, region, nothing);
  }

  template <class Integer>
  void append_cells(const Data_array& connectivity, const Data_array& offsets) {
    append<Integer>(offsets, cells_, [this](std::size_t i) { return static_cast<Integer>(offset(i + 1)); });
    append<Integer>(connectivity, offset(cells_), [&](std::size_t i) {
      const auto node_at = [](const auto& elements, std::size_t k) { return static_cast<Integer>(elements.node(k / elements.nodes_of_each(), k % elements.nodes_of_each())); };
      return i < corners_ ? node_at(tetrahedra_, i) : node_at(triangles_, i - corners_);
    });
  }

  /// A row for each cell, by what it is.
  template <class Row, class Tetrahedron, class Triangle>
  void append_by_kind(const Data_array& array, const Tetrahedron& tetrahedron, const Triangle& triangle) {
    const std::size_t n = tetrahedra_.size();
    append<Row>(array, cells_, [&](std::size_t i) { return i < n ? static_cast<Row>(tetrahedron(i)) : static_cast<Row>(triangle(i - n)); });
  }

  /// Appends the rows `row(0)`, ..., `row(count - 1)` block by block, behind the sizes of the blocks. The blocks are
  /// filled and compressed at once on all threads.
  template <class Row, class Function>
  void append(const Data_array& array, std::size_t count, const Function& row) {
    const std::size_t rows_per_block = block_bytes / sizeof(Row);
    const std::size_t blocks = (count + rows_per_block - 1) / rows_per_block;
    patch_offset(array);
    // number of blocks, bytes of a block, bytes of the last one if it is smaller, compressed bytes of each
    std::vector<std::uint64_t> header{blocks, rows_per_block * sizeof(Row),
                                      count % rows_per_block * sizeof(Row)};
    header.resize(3 + blocks);
    const std::uint64_t header_position = out_.position();
    out_.write(header.data(), header.size() * sizeof(std::uint64_t));
    parallel_in_order<std::unique_ptr<Compressor>>(
        blocks,
        [&](std::size_t b, std::unique_ptr<Compressor>& block) {
          if (!block) block = std::make_unique<Compressor>(options_.compression);
          const std::size_t first = b * rows_per_block, last = std::min(first + rows_per_block, count);
          for (std::size_t i = first; i < last; ++i) {
            const Row value = row(i);
            std::memcpy(block->input() + (i - first) * sizeof(Row), &value, sizeof(Row));
          }
          block->compress((last - first) * sizeof(Row));
        },
        [&](std::size_t b, const std::unique_ptr<Compressor>& block) {
          out_.write(block->output(), block->output_size());
          header[3 + b] = block->output_size();
        });
    out_.overwrite(header_position, header.data(), header.size() * sizeof(std::uint64_t));
  }

  void patch_offset(const Data_array& array) {
    const std::string offset = '"' + std::to_string(out_.position() - data_begin_) + '"';
    out_.overwrite(array.offset_position, offset.data(), offset.size());
  }

  static constexpr std::size_t offset_length = 22;  ///< 64 bits in decimal, and quotes

  const Indexed_mesh_3& mesh_;
  const Vtu_options& options_;
  Atomic_file& out_;
  io_detail::Tetrahedron_nodes tetrahedra_;
  io_detail::Triangle_nodes triangles_;
  std::size_t corners_ = 0;  ///< nodes of all tetrahedra
  std::size_t cells_ = 0;
  Data_array region_{"Int32", "region", 1}, ratio_{"Float32", "radius_edge_ratio", 1}, angle_{"Float32", "min_dihedral_angle", 1};
  Data_array exempt_{"UInt8", "exempt", 1}, unrefined_{"UInt8", "unrefined", 1};
  Data_array marker_{"Int32", "marker", 1}, attribute_{"Int32", "attribute", 1}, input_facet_{"Int64", "input_facet", 1};
  std::uint64_t data_begin_ = 0;
  bool wide_ = false;
};

}  // namespace

void write_vtu(const Indexed_mesh_3& mesh, const std::filesystem::path& path, const Vtu_options& options) {
  Atomic_file out(path);
  Vtu_writer(mesh, options, out).write();
  out.commit();
}

}  // namespace pgdr
