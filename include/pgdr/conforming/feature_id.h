// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_FEATURE_ID_H
#define PGDR_CONFORMING_FEATURE_ID_H

#include <pgdr/domain/domain_3.h>

namespace pgdr {

/// A segment or a facet.
struct Feature_id {
  int dimension = 0;  ///< 1: segment, 2: facet
  Index index = 0;
};

}  // namespace pgdr

#endif
