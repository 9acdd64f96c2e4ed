// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_APPS_ARGUMENTS_H
#define PGDR_APPS_ARGUMENTS_H

#include <array>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <pgdr/domain/default_kernel.h>
#include <pgdr/domain/plc.h>
#include <pgdr/io/gmsh.h>
#include <pgdr/parameters.h>
#include <pgdr/sizing/sizing_places.h>

namespace pgdr::app {

/// Options that parse but make no sense; `what()` is one sentence that names the option.
class Usage_error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The number in the option's text. Throws `Usage_error` unless all of it is a decimal number other than NaN.
double parse_number(const std::string& option, const std::string& text);

/// `parse_number`, which must be positive and finite.
double parse_positive(const std::string& option, const std::string& text);

/// A relative tolerance: `parse_number`, from 0 to less than 1.
double parse_tolerance(const std::string& option, const std::string& text);

/// A length in the units of the input, or a part of its bounding box's diagonal.
struct Length {
  double value = 0;
  bool is_relative = false;
  double in_units(double diagonal) const { return is_relative ? value * diagonal : value; }
};

/// "0.1", in the units of the input, or "1e-4d", times the diagonal; at least 0 and finite.
Length parse_length(const std::string& option, const std::string& text);

/// A bound that the mesher is asked for: `parse_number`, at least 2 and finite.
double parse_ratio_bound(const std::string& option, const std::string& text);

/// A dihedral angle that tetrahedra are to have at least, in degrees: from 0 to 60. (The regular one has 70.5.)
double parse_dihedral_angle(const std::string& option, const std::string& text);

/// A whole number, at least 1.
std::size_t parse_count(const std::string& option, const std::string& text);

/// A whole number from 1 to `most`.
std::size_t parse_count(const std::string& option, const std::string& text, std::size_t most);
/// 0 as well.
std::size_t parse_count_or_none(const std::string& option, const std::string& text);

/// An amount of memory in bytes, at least 1: "500000000", "500M", "4GiB"; K, M, G and T are powers of 1024.
std::size_t parse_memory(const std::string& option, const std::string& text);

/// A number of threads: a whole number from 0, for all that the machine has, to 1024.
unsigned parse_threads(const std::string& option, const std::string& text);

/// The value of `--placement`.
Point_placement parse_placement(const std::string& text);
/// "4.1", "4.1-ascii" or "2.2".
Gmsh_format parse_gmsh_format(const std::string& text);

/// The value of `--hole`: "x,y,z".
std::array<double, 3> parse_point(const std::string& option, const std::string& text);

/// The value of `--patch-angle`: from 0 to 180 degrees.
double parse_patch_angle(const std::string& text);

/// The values of `--name-marker` and `--name-region`: "3=inlet", each number once.
std::map<int, std::string> parse_names(const std::string& option, const std::vector<std::string>& texts);

/// The value of `--order`: 1 or 2.
int parse_order(const std::string& text);

/// The value of `--region`: "x,y,z:id" or "x,y,z:id:R" with a whole number id and R > 0.
Plc_region<Default_kernel> parse_region(const std::string& text);

/// The value of `--refine-box`: "x0,y0,z0,x1,y1,z1:R" with x0 < x1, y0 < y1, z0 < z1 and R > 0.
Sizing_box parse_sizing_box(const std::string& text);

/// The value of `--size-ball`: "x,y,z,r:R" with r >= 0 and R > 0.
Sizing_ball parse_sizing_ball(const std::string& text);

/// Sizes by the distance from the input's facets.
struct Sizes_near_surface {
  double near = 0, far = 0, reach = 0;
};

/// The value of `--size-near-surface`: "R0:R1:D" with 0 < R0 <= R1 and R1 - R0 < D, all finite.
Sizes_near_surface parse_sizes_near_surface(const std::string& text);

/// Throws `Usage_error` unless `path` ends in one of `extensions`, like ".vtu" (in any case).
void require_extension(const std::string& option, const std::filesystem::path& path,
                       const std::vector<std::string>& extensions);

/// Throws `Usage_error` unless one of `files` ends in one of `extensions`, without which the option would do nothing.
void require_one_of_format(const std::string& option, const std::vector<std::string>& files, const std::vector<std::string>& extensions);

/// Throws `Usage_error` if two of `outputs` are one file, or one of them is one of `inputs`.
void require_distinct_files(const std::vector<std::filesystem::path>& inputs,
                            const std::vector<std::filesystem::path>& outputs);

}  // namespace pgdr::app

#endif
