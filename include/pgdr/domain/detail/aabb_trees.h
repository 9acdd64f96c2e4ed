// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_DOMAIN_DETAIL_AABB_TREES_H
#define PGDR_DOMAIN_DETAIL_AABB_TREES_H

#include <vector>

#include <CGAL/AABB_tree.h>
#include <CGAL/version.h>
#if CGAL_VERSION_MAJOR >= 6
#include <CGAL/AABB_segment_primitive_3.h>
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_segment_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif

namespace pgdr::domain_detail {

// CGAL's names, one for CGAL 5 and 6.
#if CGAL_VERSION_MAJOR >= 6
template <class K, class Primitive>
using Aabb_traits = CGAL::AABB_traits_3<K, Primitive>;
template <class K, class Iterator>
using Aabb_triangle_primitive = CGAL::AABB_triangle_primitive_3<K, Iterator>;
template <class K, class Iterator>
using Aabb_segment_primitive = CGAL::AABB_segment_primitive_3<K, Iterator>;
#else
template <class K, class Primitive>
using Aabb_traits = CGAL::AABB_traits<K, Primitive>;
template <class K, class Iterator>
using Aabb_triangle_primitive = CGAL::AABB_triangle_primitive<K, Iterator>;
template <class K, class Iterator>
using Aabb_segment_primitive = CGAL::AABB_segment_primitive<K, Iterator>;
#endif

/// Over a vector of triangles that outlives it.
template <class K>
using Aabb_triangle_tree =
    CGAL::AABB_tree<Aabb_traits<K, Aabb_triangle_primitive<K, typename std::vector<typename K::Triangle_3>::const_iterator>>>;

/// Over a vector of segments that outlives it.
template <class K>
using Aabb_segment_tree = CGAL::AABB_tree<Aabb_traits<K, Aabb_segment_primitive<K, typename std::vector<typename K::Segment_3>::const_iterator>>>;

}  // namespace pgdr::domain_detail

#endif
