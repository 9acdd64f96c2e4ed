// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SRC_QUALITY_SMALL_ANGLE_RULE_H
#define PGDR_SRC_QUALITY_SMALL_ANGLE_RULE_H

#include <array>
#include <cstddef>
#include <memory>
#include <string>

#include <pgdr/quality/measures.h>

#include "check_parts.h"

namespace pgdr::quality_detail {

/// Which tetrahedra small angles of the input excuse from a bound, by those angles alone: the rule of docs/theory.md, section 11. And those next to a
/// facet that is bent by more than their shortest edge.
class Small_angle_rule {
 public:
  enum class Case { unexcused, edge, near, protected_place, bent_facet };
  /// Angles below 14.48 degrees, 30 and 60.
  static constexpr std::size_t classes = 3;
  struct Verdict {
    Case excuse = Case::unexcused;
    std::size_t angle = 0;  ///< its class, of the first two cases
  };

  explicit Small_angle_rule(const Epick_domain& domain);
  ~Small_angle_rule();

  Verdict operator()(const std::array<P, 4>& corners, double circumradius) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// How many were excused, and why.
class Excused {
 public:
  /// False if it was not excused.
  bool add(const Small_angle_rule::Verdict& verdict);
  std::string figures() const;

 private:
  std::array<std::size_t, Small_angle_rule::classes> between_{}, near_{};
  std::size_t at_protected_ = 0, at_bent_ = 0;
};

}  // namespace pgdr::quality_detail

#endif
