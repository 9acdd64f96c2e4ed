// SPDX-License-Identifier: GPL-3.0-or-later
// Private to src/io: VTK's XML files, read. K. Martin et al., VTK file formats, "XML file formats".
#ifndef PGDR_SRC_IO_VTK_XML_H
#define PGDR_SRC_IO_VTK_XML_H

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pgdr::io_detail {

/// A file of one piece, little endian, in any of the encodings: ASCII, base64 or raw, compressed by zlib or not. What is wrong is thrown as `Input_error`.
class Vtk_xml {
 public:
  /// \param text the whole file; it has to outlive the object
  Vtk_xml(std::string_view text, const std::filesystem::path& path);

  /// "UnstructuredGrid", "ImageData", ...
  std::string_view type() const { return type_; }

  /// The numbers of an array in a section, such as "PointData"; the first one where `name` is empty. Nothing if there is none, or it has another number of components.
  std::optional<std::vector<double>> array(const std::string& section, const std::string& name, std::size_t components = 1) const;

  /// The names of a section's arrays.
  std::vector<std::string> names(const std::string& section) const;

  /// Names of groups, as `write_vtu` and meshio have them: arrays of field data with a number and a dimension.
  struct Group {
    std::string name;
    int number, dimension;
  };
  std::vector<Group> groups() const;

  /// The numbers in an attribute of an element; none where it is not there.
  std::vector<double> attribute_numbers(const std::string& element, const std::string& name) const;

  [[noreturn]] void fail(const std::string& what) const;

 private:
  struct Element;
  static std::string_view attribute(std::string_view tag, const std::string& name);
  static std::optional<Element> find_element(std::string_view text, const std::string& name, std::size_t from = 0);
  template <class Visit>
  void for_each_array(const std::string& section, const Visit& visit) const;
  std::vector<double> numbers(const Element& array) const;
  class Bytes;
  std::vector<double> decoded(Bytes bytes, std::string_view type) const;
  std::vector<double> converted(const std::string& data, std::string_view type) const;
  std::uint64_t header_number(const std::string& bytes, std::size_t i) const;
  std::size_t header_size() const { return wide_ ? 8 : 4; }
  [[noreturn]] void fail_short() const { fail("an array ends before it should"); }

  std::filesystem::path path_;
  std::string_view text_, appended_, type_;
  bool appended_base64_ = false, is_compressed_ = false, wide_ = false;
};

}  // namespace pgdr::io_detail

#endif
