// SPDX-License-Identifier: GPL-3.0-or-later
#include "plane_system.h"

#include <algorithm>
#include <cstddef>
#include <limits>

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>

namespace pgdr {

namespace {

/// How cheap it is to move a plane, beside a vertex: so that only vertices count.
constexpr double plane_weight = 1e-6;
/// What keeps the system regular where planes are nearly parallel (Levenberg, Marquardt): a step takes away all of an error but this part
/// divided by the square of the angle between them.
constexpr double damping = 1e-8;

/// A plane through points, with coordinates in it that are at most 1.
struct Frame {
  Eigen::MatrixXd positions;  ///< one row per vertex: coordinates in the plane, and the distance from it

  Vec_3 normal;

  Frame(const Plane_system::Vertices& facet, const std::vector<Vec_3>& points) {
    Eigen::MatrixXd p(facet.size(), 3);
    for (std::size_t i = 0; i < facet.size(); ++i)
      for (int d = 0; d < 3; ++d) p(i, d) = points[facet[i]][d];
    p.rowwise() -= p.colwise().mean().eval();
    // Of the points themselves, not of their covariance, which would have half of the digits.
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(p, Eigen::ComputeThinV);
    const Eigen::Matrix3d axes = svd.matrixV();
    positions = p * axes;
    for (int d = 0; d < 2; ++d) {
      const double size = positions.col(d).cwiseAbs().maxCoeff();
      if (size > 0) positions.col(d) /= size;
    }
    normal = {axes(0, 2), axes(1, 2), axes(2, 2)};
  }
};

}  // namespace

double Plane_system::bend(const Vertices& facet, const std::vector<Vec_3>& points) {
  return facet.size() > 3 ? Frame(facet, points).positions.col(2).cwiseAbs().maxCoeff() : 0;
}

void Plane_system::solve(std::vector<Vec_3>& points, const std::vector<bool>& is_on, int most_steps) const {
  std::vector<Index> facets;
  for (Index f = 0; f < facets_.size(); ++f)
    if (is_on[f] && facets_[f].size() > 3) facets.push_back(f);
  if (facets.empty()) return;
  double last = std::numeric_limits<double>::infinity();
  for (int step = 0; step < most_steps; ++step) {
    const double error = newton_step(points, facets);
    if (error < enough_ || error > last / 2) return;
    last = error;
  }
}

/// Least squares with constraints: the smallest move x of vertices and y of planes with A x + B y = b. With the vertices eliminated, the
/// multipliers l are the solution of
///
///     (A A^T + damping)  B              l     b
///     B^T               -plane_weight   y  =  0        and x = A^T l,
///
/// which is quasidefinite: it has an L D L^T decomposition in any order of its rows (Vanderbei 1995).
/// \return the largest error before the step
double Plane_system::newton_step(std::vector<Vec_3>& points, const std::vector<Index>& facets) const {
  struct Use {
    Index vertex, row;
    Vec_3 normal;  ///< without the axes along which the vertex may not move
  };
  std::vector<Use> uses;
  std::vector<Eigen::Triplet<double>> entries;  // of the lower triangle
  std::size_t rows = 0;
  for (const Index f : facets) rows += facets_[f].size();
  const Index unknowns = static_cast<Index>(rows + 3 * facets.size());
  Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns);

  double error = 0;
  for (std::size_t k = 0; k < facets.size(); ++k) {
    const Vertices& facet = facets_[facets[k]];
    const Frame frame(facet, points);
    error = std::max(error, frame.positions.col(2).cwiseAbs().maxCoeff());
    const Index plane = static_cast<Index>(rows + 3 * k);
    for (Index d = 0; d < 3; ++d) entries.emplace_back(plane + d, plane + d, -plane_weight);
    for (std::size_t i = 0; i < facet.size(); ++i) {
      const Index row = static_cast<Index>(uses.size());
      right[row] = -frame.positions(i, 2);
      entries.emplace_back(row, row, damping);
      entries.emplace_back(plane, row, 1);
      for (Index d = 0; d < 2; ++d) entries.emplace_back(plane + 1 + d, row, frame.positions(i, d));
      Vec_3 normal = frame.normal;
      for (int d = 0; d < 3; ++d)
        if (fixed_[facet[i]][d]) normal[d] = 0;
      uses.push_back({facet[i], row, normal});
    }
  }
  if (error < enough_) return error;

  std::stable_sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) { return a.vertex < b.vertex; });
  for (std::size_t i = 0; i < uses.size(); ++i)
    for (std::size_t j = i; j < uses.size() && uses[j].vertex == uses[i].vertex; ++j)
      entries.emplace_back(uses[j].row, uses[i].row, dot(uses[i].normal, uses[j].normal));

  Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> decomposition(matrix);
  if (decomposition.info() != Eigen::Success) return 0;
  const Eigen::VectorXd multipliers = decomposition.solve(right);
  for (const Use& use : uses) points[use.vertex] = points[use.vertex] + multipliers[use.row] * use.normal;
  return error;
}

}  // namespace pgdr
