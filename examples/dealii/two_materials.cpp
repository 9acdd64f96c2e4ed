// SPDX-License-Identifier: GPL-3.0-or-later
// Heat through two materials, with deal.II: a wall of two layers, warm on one side and cold on the other, from a file of pgdr's.
//
//   pgdr mesh wall.poly --size 0.2 --gmsh-format 4.1-ascii -o wall.msh && two_materials wall.msh wall.vtu
//
// Regions are material ids, and markers boundary ids. The solution is linear in each layer, so linear elements have to find it exactly.
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/data_out.h>
#include <deal.II/numerics/vector_tools.h>

#include <fstream>
#include <iostream>

using namespace dealii;

namespace {

constexpr types::material_id brick = 1;
constexpr types::boundary_id warm = 1, cold = 2;
constexpr double conductivity_of_brick = 4, conductivity_of_wool = 1;  // layers from x = 0 to 1, and from there to 2

/// The exact temperature: 1 at x = 0, 0 at x = 2, with the same flow of heat through both layers.
class Temperature : public Function<3> {
public:
  double value(const Point<3>& p, unsigned = 0) const override {
    const double flow = 1 / (1 / conductivity_of_brick + 1 / conductivity_of_wool);
    return p[0] < 1 ? 1 - flow / conductivity_of_brick * p[0] : flow / conductivity_of_wool * (2 - p[0]);
  }
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: two_materials MESH.msh [OUT.vtu]\n";
    return 2;
  }
  Triangulation<3> mesh;
  GridIn<3> reader(mesh);
  std::ifstream file(argv[1]);
  reader.read_msh(file);

  const MappingFE<3> mapping(FE_SimplexP<3>(1));
  const FE_SimplexP<3> element(1);
  const QGaussSimplex<3> quadrature(2);
  DoFHandler<3> dofs(mesh);
  dofs.distribute_dofs(element);
  AffineConstraints<double> constraints;
  VectorTools::interpolate_boundary_values(mapping, dofs, warm, Functions::ConstantFunction<3>(1), constraints);
  VectorTools::interpolate_boundary_values(mapping, dofs, cold, Functions::ZeroFunction<3>(), constraints);
  constraints.close();

  DynamicSparsityPattern pattern(dofs.n_dofs());
  DoFTools::make_sparsity_pattern(dofs, pattern, constraints);
  SparsityPattern compressed;
  compressed.copy_from(pattern);
  SparseMatrix<double> matrix(compressed);
  Vector<double> load(dofs.n_dofs()), u(dofs.n_dofs());

  FEValues<3> values(mapping, element, quadrature, update_gradients | update_JxW_values);
  const unsigned n = element.n_dofs_per_cell();
  FullMatrix<double> local(n, n);
  Vector<double> nothing(n);
  std::vector<types::global_dof_index> indices(n);
  for (const auto& cell : dofs.active_cell_iterators()) {
    values.reinit(cell);
    local = 0;
    const double k = cell->material_id() == brick ? conductivity_of_brick : conductivity_of_wool;
    for (unsigned q = 0; q < quadrature.size(); ++q)
      for (unsigned i = 0; i < n; ++i)
        for (unsigned j = 0; j < n; ++j) local(i, j) += k * values.shape_grad(i, q) * values.shape_grad(j, q) * values.JxW(q);
    cell->get_dof_indices(indices);
    constraints.distribute_local_to_global(local, nothing, indices, matrix, load);
  }
  SolverControl control(1000, 1e-12);
  PreconditionSSOR<SparseMatrix<double>> preconditioner;
  preconditioner.initialize(matrix, 1.2);
  SolverCG<Vector<double>>(control).solve(matrix, u, load, preconditioner);
  constraints.distribute(u);

  Vector<double> exact(dofs.n_dofs());
  VectorTools::interpolate(mapping, dofs, Temperature(), exact);
  exact -= u;
  if (argc > 2) {
    DataOut<3> out;
    out.attach_dof_handler(dofs);
    out.add_data_vector(u, "temperature");
    out.build_patches(mapping);
    std::ofstream picture(argv[2]);
    out.write_vtu(picture);
  }
  std::cout << mesh.n_active_cells() << " tetrahedra, " << control.last_step() << " iterations, largest error " << exact.linfty_norm() << '\n';
  return exact.linfty_norm() < 1e-8 ? 0 : 1;
}
