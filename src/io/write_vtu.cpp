// SPDX-License-Identifier: GPL-3.0-or-later
// VTK's XML format: K. Martin et al., VTK file formats, "XML file formats", with appended raw data.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
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

namespace pgdr {
namespace {

constexpr std::size_t block_bytes = std::size_t(1) << 16;

/// One zlib stream, used anew for each block; speed counts for more than the last percent of size.
class Compressor {
 public:
  Compressor() : input_(block_bytes) {
    if (deflateInit(&stream_, 1) != Z_OK) throw std::bad_alloc();
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

class Vtu_writer {
 public:
  Vtu_writer(const Indexed_mesh_3& mesh, Atomic_file& out) : mesh_(mesh), out_(out) {
    const std::size_t largest = std::max(mesh.points.size(), 4 * mesh.tetrahedra.size());
    wide_ = largest > std::size_t(std::numeric_limits<std::int32_t>::max());
  }

  void write() {
    const char* const index_type = wide_ ? "Int64" : "Int32";
    Data_array in_dimension{"UInt8", "in_dimension", 1}, reference{"Int32", "reference", 1};
    Data_array region{"Int32", "region", 1}, ratio{"Float32", "radius_edge_ratio", 1};
    Data_array angle{"Float32", "min_dihedral_angle", 1}, exempt{"UInt8", "exempt", 1}, unrefined{"UInt8", "unrefined", 1};
    Data_array points{"Float64", "Points", 3};
    Data_array connectivity{index_type, "connectivity", 1}, offsets{index_type, "offsets", 1},
        types{"UInt8", "types", 1};
    const bool dimensions = !mesh_.point_dimensions.empty();

    out_.write("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"");
    out_.write(std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian");
    out_.write("\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<UnstructuredGrid>\n");
    out_.write("<Piece NumberOfPoints=\"" + std::to_string(mesh_.points.size()) + "\" NumberOfCells=\"" +
               std::to_string(mesh_.tetrahedra.size()) + "\">\n<PointData>\n");
    if (dimensions) declare(in_dimension);
    declare(reference);
    out_.write("</PointData>\n<CellData>\n");
    for (Data_array* array : {&region, &ratio, &angle, &exempt, &unrefined}) declare(*array);
    out_.write("</CellData>\n<Points>\n");
    declare(points);
    out_.write("</Points>\n<Cells>\n");
    for (Data_array* array : {&connectivity, &offsets, &types}) declare(*array);
    out_.write("</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");

    data_begin_ = out_.position();
    if (dimensions)
      append<std::uint8_t>(in_dimension, mesh_.points.size(),
                           [&](std::size_t i) { return mesh_.point_dimensions[i]; });
    append<std::int32_t>(reference, mesh_.points.size(),
                         [&](std::size_t i) { return at(mesh_.point_references, i); });
    append_cell_data(region, ratio, angle, exempt, unrefined);
    append<Indexed_mesh_3::Point>(points, mesh_.points.size(),
                                  [&, unit = unit_of(mesh_)](std::size_t i) {
                                    const auto& [x, y, z] = mesh_.points[i];
                                    return Indexed_mesh_3::Point{unit * x, unit * y, unit * z};
                                  });
    if (wide_)
      append_cells<std::int64_t>(connectivity, offsets);
    else
      append_cells<std::int32_t>(connectivity, offsets);
    constexpr std::uint8_t vtk_tetra = 10;
    append<std::uint8_t>(types, mesh_.tetrahedra.size(), [](std::size_t) { return vtk_tetra; });
    out_.write("\n</AppendedData>\n</VTKFile>\n");
  }

 private:
  static std::int32_t at(const std::vector<std::int32_t>& references, std::size_t i) {
    return i < references.size() ? references[i] : 0;
  }

  void declare(Data_array& array) {
    out_.write(std::string("<DataArray type=\"") + array.type + "\" Name=\"" + array.name +
               "\" NumberOfComponents=\"" + std::to_string(array.components) +
               "\" format=\"appended\" offset=");
    array.offset_position = out_.position();
    out_.write(std::string(offset_length, ' ') + "/>\n");
  }

  void append_cell_data(const Data_array& region, const Data_array& ratio, const Data_array& angle,
                        const Data_array& exempt, const Data_array& unrefined) {
    const std::size_t count = mesh_.tetrahedra.size();
    const auto measure = [&](std::size_t i, auto function) {
      const auto& t = mesh_.tetrahedra[i];
      return static_cast<float>(
          function(mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]], mesh_.points[t[3]]));
    };
    append<std::int32_t>(region, count, [&](std::size_t i) { return at(mesh_.tetrahedron_references, i); });
    append<float>(ratio, count, [&](std::size_t i) {
      return measure(i, [](const auto&... p) { return radius_edge_ratio(p...); });
    });
    append<float>(angle, count, [&](std::size_t i) {
      return measure(i, [](const auto&... p) { return smallest_dihedral_angle_deg(p...); });
    });
    const auto append_marks = [&](const Data_array& array, const std::vector<std::uint32_t>& marked) {
      append<std::uint8_t>(array, count, [&](std::size_t i) { return std::uint8_t(std::ranges::binary_search(marked, i)); });
    };
    append_marks(exempt, mesh_.exempt);
    append_marks(unrefined, mesh_.unrefined);
  }

  template <class Integer>
  void append_cells(const Data_array& connectivity, const Data_array& offsets) {
    const std::size_t count = mesh_.tetrahedra.size();
    append<std::array<Integer, 4>>(connectivity, count, [&](std::size_t i) {
      const auto& t = mesh_.tetrahedra[i];
      return std::array<Integer, 4>{static_cast<Integer>(t[0]), static_cast<Integer>(t[1]),
                                    static_cast<Integer>(t[2]), static_cast<Integer>(t[3])};
    });
    append<Integer>(offsets, count, [](std::size_t i) { return static_cast<Integer>(4 * (i + 1)); });
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
          if (!block) block = std::make_unique<Compressor>();
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
  Atomic_file& out_;
  std::uint64_t data_begin_ = 0;
  bool wide_ = false;
};

}  // namespace

void write_vtu(const Indexed_mesh_3& mesh, const std::filesystem::path& path) {
  Atomic_file out(path);
  Vtu_writer(mesh, out).write();
  out.commit();
}

}  // namespace pgdr
