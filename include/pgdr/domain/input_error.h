// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_INPUT_ERROR_H
#define PGDR_DOMAIN_INPUT_ERROR_H

#include <array>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <pgdr/domain/plc.h>

namespace pgdr {

/// One thing that is wrong with an input, with the ids that it concerns.
struct Input_problem {
  enum class Kind {
    unreadable,         ///< missing, truncated or malformed file
    bad_coordinate,     ///< NaN or infinite
    bad_index,          ///< a facet names a vertex that is not there
    degenerate_facet,   ///< no area, or fewer than three distinct vertices
    non_planar_facet,   ///< farther from planar than the tolerance
    self_intersection,  ///< two facets meet other than in common vertices and segments
    open_surface,       ///< nothing is enclosed
    empty,              ///< no facets, or no volume left after holes
    bad_seed,           ///< a hole or region seed outside of every enclosed volume, or overruled by another one; left out
    ambiguous_seed      ///< a hole or region seed on a facet
  };
  Kind kind;
  /// One sentence that names the file, the line or the facet, in the numbering of the input file.
  std::string message;
  std::vector<Index> facets = {};  ///< input facets, 0-based
  std::vector<Index> vertices = {};  ///< input vertices, 0-based

  /// Whether the input can be meshed all the same.
  bool is_warning() const { return kind == Kind::bad_seed; }
};

/// Thrown for input that cannot be meshed; `what()` is the first problem's message.
class Input_error : public std::runtime_error {
 public:
  explicit Input_error(std::vector<Input_problem> problems)
      : std::runtime_error(problems.empty() ? std::string("bad input") : problems.front().message),
        problems_(std::move(problems)) {}
  Input_error(Input_problem::Kind kind, const std::string& message)
      : Input_error(std::vector<Input_problem>{{kind, message}}) {}

  const std::vector<Input_problem>& problems() const { return problems_; }

 private:
  std::vector<Input_problem> problems_;
};

}  // namespace pgdr

#endif
