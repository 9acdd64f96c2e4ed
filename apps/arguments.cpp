// SPDX-License-Identifier: GPL-3.0-or-later
#include "arguments.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <system_error>
#include <utility>

#include <CLI/CLI.hpp>

#include <pgdr/report/format.h>

namespace pgdr::app {

namespace {

/// Whether all of `text` is one number, which goes to `value`. Independent of the locale.
template <class Number>
bool read_all(std::string_view text, Number& value) {
  const char* end = text.data() + text.size();
  const auto [position, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && position == end;
}

/// Reads as many finite numbers as `values` has, with commas between them, from all of `text`.
template <std::size_t N>
bool read_numbers(std::string_view text, std::array<double, N>& values) {
  for (std::size_t i = 0; i < N; ++i) {
    const std::size_t comma = i + 1 < N ? text.find(',') : text.size();
    if (comma == std::string_view::npos || !read_all(text.substr(0, comma), values[i]) || !std::isfinite(values[i]))
      return false;
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  return true;
}

bool same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code ignored;
  if (std::filesystem::equivalent(a, b, ignored)) return true;
  // Neither need exist yet.
  const auto canonical = [](const std::filesystem::path& path) {
    std::error_code error;
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path, error), error);
  };
  return canonical(a) == canonical(b);
}

}  // namespace

double parse_number(const std::string& option, const std::string& text) {
  double value = 0;
  if (!read_all(text, value) || std::isnan(value))
    throw Usage_error(option + ": '" + text + "' is not a number");
  return value;
}

double parse_positive(const std::string& option, const std::string& text) {
  const double value = parse_number(option, text);
  if (!(value > 0) || std::isinf(value))
    throw Usage_error(option + " must be a positive number, not " + text);
  return value;
}

double parse_tolerance(const std::string& option, const std::string& text) {
  const double value = parse_number(option, text);
  if (!(value >= 0 && value < 1))
    throw Usage_error(option + " must be from 0 to less than 1, a part of the bounding box's diagonal, not " +
                      text);
  return value;
}

Length parse_length(const std::string& option, const std::string& text) {
  const bool is_relative = text.ends_with('d') || text.ends_with('D');
  const double value = parse_number(option, is_relative ? text.substr(0, text.size() - 1) : text);
  if (!(value >= 0 && value < std::numeric_limits<double>::infinity()))
    throw Usage_error(option + " must be a length like 0.1, or a part of the bounding box's diagonal like 1e-4d, not " + text);
  return {value, is_relative};
}

double parse_ratio_bound(const std::string& option, const std::string& text) {
  const double value = parse_positive(option, text);
  if (value < 2)
    throw Usage_error(option + " must be at least 2, because no smaller bound is sure to be reached, not " +
                      text);
  return value;
}

double parse_dihedral_angle(const std::string& option, const std::string& text) {
  const double value = parse_number(option, text);
  if (!(value >= 0 && value <= Parameters::largest_min_dihedral))
    throw Usage_error(option + " must be an angle from 0 to 60 degrees, not " + text);
  return value;
}

double parse_patch_angle(const std::string& text) {
  const double value = parse_number("--patch-angle", text);
  if (!(value >= 0 && value <= 180)) throw Usage_error("--patch-angle must be an angle from 0 to 180 degrees, not " + text);
  return value;
}

std::map<int, std::string> parse_names(const std::string& option, const std::vector<std::string>& texts) {
  std::map<int, std::string> names;
  for (const std::string& text : texts) {
    const std::size_t sign = text.find('=');
    int number = 0;
    if (sign == std::string::npos || sign + 1 == text.size() || !read_all(std::string_view(text).substr(0, sign), number))
      throw Usage_error(std::string(option).append(": '").append(text).append("' is not a whole number, '=' and a name"));
    if (!names.try_emplace(number, text.substr(sign + 1)).second) throw Usage_error(option + ": " + std::to_string(number) + " gets two names");
  }
  return names;
}

int parse_order(const std::string& text) {
  if (text == "1") return 1;
  if (text == "2") return 2;
  throw Usage_error("--order must be 1 or 2, not " + text);
}

std::size_t parse_count(const std::string& option, const std::string& text) {
  std::size_t value = 0;
  if (!read_all(text, value) || value == 0)
    throw Usage_error(option + " must be a whole number of at least 1, not " + text);
  return value;
}

std::size_t parse_count(const std::string& option, const std::string& text, std::size_t most) {
  const std::size_t value = parse_count(option, text);
  if (value > most) throw Usage_error(option + " must be at most " + std::to_string(most) + ", not " + text);
  return value;
}

std::size_t parse_count_or_none(const std::string& option, const std::string& text) {
  std::size_t value = 0;
  if (!read_all(text, value)) throw Usage_error(option + " must be a whole number of at least 0, not " + text);
  return value;
}

std::size_t parse_memory(const std::string& option, const std::string& text) {
  std::string bytes = text;
  std::size_t value = 0;
  bool is_read = false;
  try {
    is_read = CLI::AsSizeValue(false)(bytes).empty() && read_all(bytes, value);
  } catch (const CLI::Error&) {
    // Said below.
  }
  if (!is_read || value == 0) throw Usage_error(option + " must be an amount of memory like 500M or 4G, not " + text);
  return value;
}

unsigned parse_threads(const std::string& option, const std::string& text) {
  unsigned value = 0;
  if (!read_all(text, value) || value > 1024)
    throw Usage_error(option + " must be a whole number from 1 to 1024, or 0 for one thread per core, not " + text);
  return value;
}

Point_placement parse_placement(const std::string& text) {
  if (text == "circumcenter") return Point_placement::circumcenter;
  if (text == "type1") return Point_placement::type1;
  if (text == "type2") return Point_placement::type2;
  if (text == "lazy") return Point_placement::lazy;
  throw Usage_error("--placement must be lazy, circumcenter, type1 or type2, not '" + text + "'");
}

Gmsh_format parse_gmsh_format(const std::string& text) {
  if (const auto format = gmsh_format_named(text)) return *format;
  throw Usage_error("--gmsh-format must be 4.1, 4.1-ascii or 2.2, not '" + text + "'");
}

std::array<double, 3> parse_point(const std::string& option, const std::string& text) {
  std::array<double, 3> p{};
  if (!read_numbers(std::string_view(text), p))
    throw Usage_error(option + ": '" + text + "' is not of the form x,y,z with finite numbers");
  return p;
}

Plc_region<Default_kernel> parse_region(const std::string& text) {
  const auto fail = [&text](const std::string& why) -> Usage_error {
    return Usage_error("--region: '" + text + "' " + why);
  };
  const std::size_t first = text.find(':');
  if (first == std::string::npos) throw fail("is not of the form x,y,z:id or x,y,z:id:R");
  const std::size_t second = text.find(':', first + 1);
  const std::array<double, 3> p = parse_point("--region", text.substr(0, first));
  Plc_region<Default_kernel> region;
  region.point = {p[0], p[1], p[2]};
  if (!read_all(std::string_view(text).substr(first + 1, second == std::string::npos ? second : second - first - 1), region.id))
    throw fail("has an id that is not a whole number");
  if (second != std::string::npos) {
    if (!read_all(std::string_view(text).substr(second + 1), region.max_circumradius) ||
        !(region.max_circumradius > 0) || std::isinf(region.max_circumradius))
      throw fail("has a size R that is not a positive number");
  }
  return region;
}

namespace {

/// A place and the size in it, as `form` says: N numbers with commas, a colon, R.
template <std::size_t N>
std::pair<std::array<double, N>, double> parse_sized_place(const std::string& option, const std::string& form, const std::string& text) {
  const auto fail = [&](const std::string& why) { return Usage_error(option + ": '" + text + "' " + why); };
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) throw fail("is not of the form " + form);
  std::array<double, N> c{};
  if (!read_numbers(std::string_view(text.data(), colon), c)) throw fail("is not of the form " + form + " with finite numbers");
  double radius = 0;
  if (!read_all(std::string_view(text).substr(colon + 1), radius)) throw fail("is not of the form " + form);
  if (!(radius > 0) || std::isinf(radius)) throw fail("has a size R that is not positive");
  return {c, radius};
}

}  // namespace

Sizing_box parse_sizing_box(const std::string& text) {
  const auto [c, radius] = parse_sized_place<6>("--refine-box", "x0,y0,z0,x1,y1,z1:R", text);
  const Sizing_box box{{c[0], c[1], c[2]}, {c[3], c[4], c[5]}, radius};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(box.lower[axis] < box.upper[axis]))
      throw Usage_error("--refine-box: '" + text + "' is empty: the first corner must be below the second one");
  }
  return box;
}

Sizing_ball parse_sizing_ball(const std::string& text) {
  const auto [c, radius] = parse_sized_place<4>("--size-ball", "x,y,z,r:R", text);
  if (!(c[3] >= 0)) throw Usage_error("--size-ball: '" + text + "' has a radius r below 0");
  return {{c[0], c[1], c[2]}, c[3], radius};
}

Sizes_near_surface parse_sizes_near_surface(const std::string& text) {
  const auto fail = [&text](const std::string& why) { return Usage_error("--size-near-surface: '" + text + "' " + why); };
  std::string numbers = text;
  const bool has_two_colons = std::ranges::count(numbers, ':') == 2 && numbers.find(',') == std::string::npos;
  std::ranges::replace(numbers, ':', ',');
  std::array<double, 3> c{};
  if (!has_two_colons || !read_numbers(numbers, c)) throw fail("is not of the form R0:R1:D with finite numbers");
  if (!(0 < c[0] && c[0] <= c[1])) throw fail("needs sizes 0 < R0 <= R1");
  if (!(c[1] - c[0] < c[2])) throw fail("lets sizes grow by as much as the distance or more: R1 - R0 has to be less than D");
  return {c[0], c[1], c[2]};
}

namespace {

bool ends_in(const std::filesystem::path& path, const std::vector<std::string>& extensions) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return std::ranges::find(extensions, extension) != extensions.end();
}

}  // namespace

void require_extension(const std::string& option, const std::filesystem::path& path,
                       const std::vector<std::string>& extensions) {
  if (!ends_in(path, extensions)) throw Usage_error(option + ": '" + path.string() + "' does not end in " + joined(extensions, " or "));
}

void require_one_of_format(const std::string& option, const std::vector<std::string>& files, const std::vector<std::string>& extensions) {
  if (std::ranges::none_of(files, [&](const std::string& file) { return ends_in(file, extensions); }))
    throw Usage_error(option + " goes with a file that ends in " + joined(extensions, " or "));
}

void require_distinct_files(const std::vector<std::filesystem::path>& inputs,
                            const std::vector<std::filesystem::path>& outputs) {
  for (std::size_t i = 0; i < inputs.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (same_file(inputs[i], inputs[j])) throw Usage_error("'" + inputs[i].string() + "' is named as input twice");
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    for (const auto& input : inputs) {
      if (same_file(input, outputs[i]))
        throw Usage_error("'" + outputs[i].string() + "' is the input and would be overwritten");
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (same_file(outputs[j], outputs[i]))
        throw Usage_error("'" + outputs[i].string() + "' is named as output twice");
    }
  }
}

}  // namespace pgdr::app
