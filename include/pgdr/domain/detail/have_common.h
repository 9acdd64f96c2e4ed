// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_DETAIL_HAVE_COMMON_H
#define PGDR_DOMAIN_DETAIL_HAVE_COMMON_H

namespace pgdr::domain_detail {

/// Whether two ascending lists, of vertices say, have a common element.
template <class List>
bool have_common(const List& a, const List& b) {
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end();) {
    if (*i == *j) return true;
    ++(*i < *j ? i : j);
  }
  return false;
}

}  // namespace pgdr::domain_detail

#endif
