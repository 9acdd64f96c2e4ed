// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_CONFORMING_ENCROACHMENT_3_H
#define PGDR_CONFORMING_ENCROACHMENT_3_H

#include <pgdr/conforming/constraint_complex_3.h>
#include <pgdr/mesh/in_ball_filter.h>

namespace pgdr {

/// Whether p lies in the open diametral ball of a subsegment. Exact.
template <class Subsegment, class Point>
bool is_encroached(const Subsegment& s, const Point& p)
  requires requires { s.segment; }
{
  using Kernel = typename CGAL::Kernel_traits<Point>::Kernel;
  return typename Kernel::Side_of_bounded_sphere_3()(s.vertices[0]->point(), s.vertices[1]->point(), p) ==
         CGAL::ON_BOUNDED_SIDE;
}

/// Whether p lies in the open equatorial ball of a subfacet. Exact.
template <class Subfacet, class Point>
bool is_encroached(const Subfacet& t, const Point& p)
  requires requires { t.facet; }
{
  using Kernel = typename CGAL::Kernel_traits<Point>::Kernel;
  const Point &a = t.vertices[0]->point(), &b = t.vertices[1]->point(), &c = t.vertices[2]->point();
  if (const int side = side_of_ball(to_vec(a), to_vec(b), to_vec(c), to_vec(p)); side != 0) return side > 0;
  return typename Kernel::Side_of_bounded_sphere_3()(a, b, c, p) == CGAL::ON_BOUNDED_SIDE;
}

/// Whether a vertex encroaches a subsegment. Vertices of its own segment do not, whatever rounding says.
template <class Tr>
bool encroaches(const Constraint_complex_3<Tr>& complex,
                const typename Constraint_complex_3<Tr>::Subsegment& s, typename Tr::Vertex_handle v) {
  return v != s.vertices[0] && v != s.vertices[1] && !complex.is_on_segment(v, s.segment) &&
         is_encroached(s, v->point());
}

/// Whether a vertex encroaches a subfacet. Vertices of its own facet do not, whatever rounding says.
template <class Tr>
bool encroaches(const Constraint_complex_3<Tr>& complex,
                const typename Constraint_complex_3<Tr>::Subfacet& t, typename Tr::Vertex_handle v) {
  return !complex.is_on_facet(v, t.facet) && is_encroached(t, v->point());
}

}  // namespace pgdr

#endif
