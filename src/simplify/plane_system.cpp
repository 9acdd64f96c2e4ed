// SPDX-License-Identifier: GPL-3.0-or-later
#include "plane_system.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>

namespace pgdr {

namespace {

/// How cheap it is to move a plane, beside a vertex: so that only vertices count.
constexpr double plane_weight = 1e-6;
/// What keeps the system regular where planes are nearly parallel (Levenberg, Marquardt): a step takes away all of an error but this part
/// divided by the square of the angle between them.
constexpr double damping = 1e-8;
/// A step that leaves less of the error than this is followed by one with the same decomposition.
constexpr double much_closer = 0.1;
/// Where points only have to come near: so many steps where there are few facets, of 94,000 each takes 17 seconds.
constexpr int decomposed_steps = 2;
constexpr std::size_t most_decomposed = 10000;
/// For a rough step: planes at less than a hundredth of a radian to each other are left apart, which keeps the number of iterations low (some
/// 100 for 100,000 facets).
constexpr double rough_damping = 1e-4;
constexpr double rough_error = 1e-2;
constexpr int rough_iterations = 200;
constexpr std::size_t most_for_rough_step = 100;  ///< facets at one vertex, whose pairs fill memory

/// A plane through points, with coordinates in it that are at most 1.
struct Frame {
  using Positions = Eigen::Matrix<double, Eigen::Dynamic, 3>;
  Positions positions;  ///< one row per vertex: coordinates in the plane, and the distance from it

  Vec_3 normal;

  Frame(const Plane_system::Vertices& facet, const std::vector<Vec_3>& points) {
    Positions p(facet.size(), 3);
    for (std::size_t i = 0; i < facet.size(); ++i)
      for (int d = 0; d < 3; ++d) p(i, d) = points[facet[i]][d];
    p.rowwise() -= p.colwise().mean().eval();
    // Of the points themselves, not of their covariance, which would have half of the digits.
    const Eigen::HouseholderQR<Positions> qr(p);
    const Eigen::Matrix3d r = qr.matrixQR().topRows<3>().triangularView<Eigen::Upper>();
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(r, Eigen::ComputeFullV);
    const Eigen::Matrix3d& axes = svd.matrixV();
    positions.noalias() = p * axes;
    for (int d = 0; d < 2; ++d) {
      const double size = positions.col(d).cwiseAbs().maxCoeff();
      if (size > 0) positions.col(d) /= size;
    }
    normal = {axes(0, 2), axes(1, 2), axes(2, 2)};
  }
};

}  // namespace

Vec_3 Plane_system::movable(Index vertex, Vec_3 normal) const {
  for (int d = 0; d < 3; ++d)
    if (fixed_[vertex][d]) normal[d] = 0;
  return normal;
}

double Plane_system::bend(const Vertices& facet, const std::vector<Vec_3>& points) {
  return facet.size() > 3 ? Frame(facet, points).positions.col(2).cwiseAbs().maxCoeff() : 0;
}

/// Least squares with constraints: the smallest move x of vertices and y of planes with A x + B y = b. With the vertices eliminated, the
/// multipliers l are the solution of
///
///     (A A^T + damping)  B              l     b
///     B^T               -plane_weight   y  =  0        and x = A^T l,
///
/// which is quasidefinite: it has an L D L^T decomposition in any order of its rows (Vanderbei 1995).
class Plane_system::Linearization {
 public:
  /// A and B are made of planes that fit the points of these facets.
  bool make(const Plane_system& system, const std::vector<Index>& facets, const std::vector<Frame>& frames) {
    std::vector<Eigen::Triplet<double>> entries;  // of the lower triangle
    std::size_t rows = 0;
    for (const Index f : facets) rows += system.facets_[f].size();
    const Index unknowns = static_cast<Index>(rows + 3 * facets.size());
    uses_.clear();
    normals_.clear();
    for (std::size_t k = 0; k < facets.size(); ++k) {
      const Vertices& facet = system.facets_[facets[k]];
      const Index plane = static_cast<Index>(rows + 3 * k);
      for (Index d = 0; d < 3; ++d) entries.emplace_back(plane + d, plane + d, -plane_weight);
      for (std::size_t i = 0; i < facet.size(); ++i) {
        const Index row = static_cast<Index>(uses_.size());
        entries.emplace_back(row, row, damping);
        entries.emplace_back(plane, row, 1);
        for (Index d = 0; d < 2; ++d) entries.emplace_back(plane + 1 + d, row, frames[k].positions(i, d));
        uses_.push_back({facet[i], row, system.movable(facet[i], frames[k].normal)});
      }
      normals_.push_back(frames[k].normal);
    }
    std::ranges::stable_sort(uses_, {}, &Use::vertex);
    for (std::size_t i = 0; i < uses_.size(); ++i)
      for (std::size_t j = i; j < uses_.size() && uses_[j].vertex == uses_[i].vertex; ++j)
        entries.emplace_back(uses_[j].row, uses_[i].row, dot(uses_[i].normal, uses_[j].normal));

    Matrix matrix(unknowns, unknowns);
    matrix.setFromTriplets(entries.begin(), entries.end());
    if (!is_analyzed_) ldlt_.analyzePattern(matrix);  // every matrix has its entries at the same places
    is_analyzed_ = true;
    ldlt_.factorize(matrix);
    return ldlt_.info() == Eigen::Success;
  }

  /// Moves the points towards planes with these frames, which may be later ones.
  void step(std::vector<Vec_3>& points, const std::vector<Frame>& frames) const {
    Eigen::VectorXd right = Eigen::VectorXd::Zero(ldlt_.rows());
    Eigen::Index row = 0;
    for (std::size_t k = 0; k < frames.size(); ++k) {
      const double side = dot(normals_[k], frames[k].normal) < 0 ? -1 : 1;
      for (Eigen::Index i = 0; i < frames[k].positions.rows(); ++i) right[row++] = -side * frames[k].positions(i, 2);
    }
    const Eigen::VectorXd multipliers = ldlt_.solve(right);
    for (const Use& use : uses_) points[use.vertex] = points[use.vertex] + multipliers[use.row] * use.normal;
  }

 private:
  using Matrix = Eigen::SparseMatrix<double>;

  struct Use {
    Index vertex, row;
    Vec_3 normal;  ///< without the axes along which the vertex may not move
  };

  std::vector<Use> uses_;
  std::vector<Vec_3> normals_;  ///< of the facets
  Eigen::SimplicialLDLT<Matrix> ldlt_;
  bool is_analyzed_ = false;
};

/// The same system with the multipliers eliminated instead: those of a vertex depend on no others, and what is left,
///
///     (B^T (A A^T + damping)^-1 B + plane_weight) y = B^T (A A^T + damping)^-1 b,
///
/// is symmetric and positive definite, so that conjugate gradients need no decomposition.
class Plane_system::Rough_step {
 public:
  Rough_step(const Plane_system& system, const std::vector<Index>& facets, const std::vector<Frame>& frames) : frames_(frames) {
    for (Index k = 0; k < facets.size(); ++k) {
      const Vertices& facet = system.facets_[facets[k]];
      for (Index i = 0; i < facet.size(); ++i) uses_.push_back({facet[i], k, i, system.movable(facet[i], frames[k].normal)});
    }
    std::ranges::stable_sort(uses_, {}, &Use::vertex);
    for (std::size_t i = 0, j = 0; i < uses_.size(); i = j) {
      while (j < uses_.size() && uses_[j].vertex == uses_[i].vertex) ++j;
      vertices_.push_back({std::span(uses_).subspan(i, j - i), {}});
    }
  }

  /// How many of the facets are at one vertex: each pair of them is nine entries of the system.
  std::size_t most_at_vertex() const {
    return vertices_.empty() ? 0 : std::ranges::max_element(vertices_, {}, [](const Vertex& v) { return v.uses.size(); })->uses.size();
  }

  void move(std::vector<Vec_3>& points) {
    const auto unknowns = static_cast<Eigen::Index>(3 * frames_.size());
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns);
    for (Eigen::Index i = 0; i < unknowns; ++i) entries.emplace_back(i, i, plane_weight);
    for (Vertex& v : vertices_) {
      const auto n = static_cast<Eigen::Index>(v.uses.size());
      Eigen::MatrixXd gram(n, n), planes(n, 3);
      for (Eigen::Index i = 0; i < n; ++i) {
        planes.row(i) = plane(v.uses[i]);
        for (Eigen::Index j = 0; j < n; ++j) gram(i, j) = dot(v.uses[i].normal, v.uses[j].normal) + (i == j ? rough_damping : 0);
      }
      v.inverse = gram.inverse();
      const Eigen::VectorXd multipliers = v.inverse * offsets(v);
      for (Eigen::Index i = 0; i < n; ++i) {
        const Eigen::Index row = 3 * v.uses[i].plane;
        right.segment<3>(row) += multipliers[i] * planes.row(i).transpose();
        for (Eigen::Index j = 0; j < n; ++j)
          for (Eigen::Index c = 0; c < 3; ++c)
            for (Eigen::Index d = 0; d < 3; ++d)
              entries.emplace_back(row + c, 3 * v.uses[j].plane + d, v.inverse(i, j) * planes(i, c) * planes(j, d));
      }
    }
    Matrix matrix(unknowns, unknowns);
    matrix.setFromTriplets(entries.begin(), entries.end());
    Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper> gradients(matrix);
    gradients.setMaxIterations(rough_iterations);
    gradients.setTolerance(rough_error);
    const Eigen::VectorXd moved = gradients.solve(right);
    for (const Vertex& v : vertices_) {
      Eigen::VectorXd left = offsets(v);
      for (Eigen::Index i = 0; i < left.size(); ++i) left[i] -= plane(v.uses[i]) * moved.segment<3>(3 * v.uses[i].plane);
      const Eigen::VectorXd multipliers = v.inverse * left;
      for (Eigen::Index i = 0; i < left.size(); ++i) points[v.uses[i].vertex] = points[v.uses[i].vertex] + multipliers[i] * v.uses[i].normal;
    }
  }

 private:
  using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  struct Use {
    Index vertex, plane, row;  ///< the row in the frame of that plane
    Vec_3 normal;
  };
  struct Vertex {
    std::span<const Use> uses;
    Eigen::MatrixXd inverse;
  };

  /// How far this vertex moves off the plane as that moves and turns.
  Eigen::RowVector3d plane(const Use& u) const {
    const Frame::Positions& p = frames_[u.plane].positions;
    return {1, p(u.row, 0), p(u.row, 1)};
  }

  Eigen::VectorXd offsets(const Vertex& v) const {
    Eigen::VectorXd result(v.uses.size());
    for (std::size_t i = 0; i < v.uses.size(); ++i) result[i] = -frames_[v.uses[i].plane].positions(v.uses[i].row, 2);
    return result;
  }

  const std::vector<Frame>& frames_;
  std::vector<Use> uses_;
  std::vector<Vertex> vertices_;
};

void Plane_system::approach(std::vector<Vec_3>& points, const std::vector<Index>& facets) const {
  if (facets.size() > most_decomposed) {
    std::vector<Frame> frames;
    for (const Index f : facets) frames.emplace_back(facets_[f], points);
    Rough_step step(*this, facets, frames);
    if (step.most_at_vertex() <= most_for_rough_step) return step.move(points);
  }
  solve(points, facets, decomposed_steps);
}

void Plane_system::solve(std::vector<Vec_3>& points, const std::vector<Index>& facets, int most_steps) const {
  Linearization linearization;
  double last = std::numeric_limits<double>::infinity();
  bool is_old = false;
  for (int step = 0; step < most_steps; ++step) {
    std::vector<Frame> frames;
    double error = 0;
    for (const Index f : facets) {
      frames.emplace_back(facets_[f], points);
      error = std::max(error, frames.back().positions.col(2).cwiseAbs().maxCoeff());
    }
    if (error < enough_) return;
    const bool is_last = !is_old && error > last / 2;
    // Most of the time goes into decompositions, and where points move little beside the size of facets an old one is as good.
    is_old = step > 0 && error < much_closer * last;
    if (!is_old && !linearization.make(*this, facets, frames)) return;
    linearization.step(points, frames);
    if (is_last) return;
    last = error;
  }
}

}  // namespace pgdr
