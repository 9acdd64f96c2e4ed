// SPDX-License-Identifier: GPL-3.0-or-later
// What python/pgdr/__init__.py is made of; users see that.
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <pgdr/domain/patches.h>
#include <pgdr/domain/reference_names.h>
#include <pgdr/domain/scale.h>
#include <pgdr/domain/valid_domain.h>
#include <pgdr/io/medit.h>
#include <pgdr/io/outer_triangles.h>
#include <pgdr/io/read_plc.h>
#include <pgdr/io/second_order.h>
#include <pgdr/io/write_mesh.h>
#include <pgdr/io/write_poly.h>
#include <pgdr/mesh/scale_mesh.h>
#include <pgdr/mesh_domain.h>
#include <pgdr/parallel/thread_arena.h>
#include <pgdr/quality/check_mesh.h>
#include <pgdr/quality/mesh_quality.h>
#include <pgdr/repair/repair.h>
#include <pgdr/report/memory.h>
#include <pgdr/report/run_summary.h>
#include <pgdr/simplify/simplify_within.h>
#include <pgdr/sizing/sizing_field.h>

#include "sizes.h"

namespace py = pybind11;

namespace {

using pgdr::Index;
using pgdr::Indexed_mesh_3;
using pgdr::Plc;
using Domain = pgdr::Domain_3<pgdr::Default_kernel>;
using Points = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Names = std::map<int, std::string>;

/// TBB's threads are not in the child of a fork, and nothing would ever be done there.
void require_same_process() {
  static const pid_t process = ::getpid();
  if (::getpid() != process) throw std::runtime_error("pgdr cannot be used in a child of fork(): start processes by 'spawn'");
}

/// Runs `work` on a thread of its own without the GIL, while this one looks for Ctrl-C; that sets the flag, and is raised when `work` has ended.
/// `look` is called now and then with the GIL.
template <class Work, class Look>
void run_interruptibly(std::atomic<bool>& cancel, const Work& work, const Look& look) {
  std::mutex mutex;
  std::condition_variable ended;
  bool is_over = false;
  std::exception_ptr error;
  std::thread worker([&] {
    try {
      work();
    } catch (...) {
      error = std::current_exception();
    }
    const std::lock_guard lock(mutex);
    is_over = true;
    ended.notify_one();
  });
  std::exception_ptr raised;
  const auto is_done = [&] {
    const py::gil_scoped_release release;
    std::unique_lock lock(mutex);
    return ended.wait_for(lock, std::chrono::milliseconds(50), [&] { return is_over; });
  };
  while (!is_done()) {
    if (raised) continue;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      look();
    } catch (...) {
      raised = std::current_exception();
      cancel = true;
    }
  }
  worker.join();
  if (raised) std::rethrow_exception(raised);
  if (error) std::rethrow_exception(error);
}

/// The same for work that nothing interrupts.
template <class Work>
auto without_gil(unsigned threads, const Work& work) {
  require_same_process();
  const py::gil_scoped_release release;
  return pgdr::with_threads(threads, work);
}

// Input.

Plc make_plc(const Points& points, const py::object& facets, const std::optional<std::vector<int>>& markers, const py::object& regions,
             const std::optional<Points>& holes, const std::string& nesting, Names marker_names, Names region_names) {
  if (points.ndim() != 2 || points.shape(1) != 3) throw py::value_error("points has to have the shape (n, 3)");
  if (nesting != "fill" && nesting != "alternate") throw py::value_error("nesting has to be 'fill' or 'alternate'");
  Plc plc;
  plc.nesting = nesting == "fill" ? pgdr::Nesting::fill : pgdr::Nesting::alternate;
  const auto p = points.unchecked<2>();
  for (py::ssize_t i = 0; i < p.shape(0); ++i) plc.vertices.emplace_back(p(i, 0), p(i, 1), p(i, 2));
  const auto add = [&](const auto& polygon) {
    auto& facet = plc.facets.emplace_back();
    auto& loop = facet.polygons.emplace_back();
    for (const std::int64_t v : polygon) {
      if (v < 0 || v >= p.shape(0))
        throw py::index_error("facet " + std::to_string(plc.facets.size() - 1) + " names vertex " + std::to_string(v) + ", which is not there");
      loop.push_back(static_cast<Index>(v));
    }
  };
  for (const py::handle& facet : facets) add(facet.cast<std::vector<std::int64_t>>());
  if (markers) {
    if (markers->size() != plc.facets.size()) throw py::value_error("markers has to have one number for each facet");
    for (std::size_t f = 0; f < plc.facets.size(); ++f) plc.facets[f].marker = (*markers)[f];
  }
  if (!regions.is_none())
    for (const py::handle& region : regions) {
      // (point, id) or (point, id, largest circumradius)
      const auto t = region.cast<py::tuple>();
      if (t.size() != 2 && t.size() != 3) throw py::value_error("a region is a point, an id and, if need be, a size");
      const auto at = t[0].cast<std::array<double, 3>>();
      pgdr::Plc_region<pgdr::Default_kernel> r;
      r.point = {at[0], at[1], at[2]};
      r.id = t[1].cast<int>();
      if (t.size() == 3) r.max_circumradius = t[2].cast<double>();
      plc.regions.push_back(r);
    }
  if (holes) {
    if (holes->ndim() != 2 || holes->shape(1) != 3) throw py::value_error("holes has to have the shape (n, 3)");
    const auto h = holes->unchecked<2>();
    for (py::ssize_t i = 0; i < h.shape(0); ++i) plc.holes.emplace_back(h(i, 0), h(i, 1), h(i, 2));
  }
  plc.names = {std::move(marker_names), std::move(region_names)};
  return pgdr::normalized(std::move(plc));
}

pgdr::Markers_from markers_from(const std::string& text) {
  if (text == "names") return pgdr::Markers_from::names;
  if (text == "colors") return pgdr::Markers_from::colors;
  if (text == "nothing") return pgdr::Markers_from::nothing;
  throw py::value_error("markers_from has to be 'names', 'colors' or 'nothing'");
}

// Output.

/// A finished mesh, and how it ended.
struct Mesh {
  Indexed_mesh_3 arrays;
  std::string stop = "finished";
  std::string message;
  std::size_t missing = 0;
};

template <class T>
struct Scalar {
  using type = T;
  static constexpr py::ssize_t columns = 0;
};
template <class T, std::size_t N>
struct Scalar<std::array<T, N>> {
  using type = T;
  static constexpr py::ssize_t columns = N;
};

/// A read-only view that keeps its owner alive.
template <class T>
py::array view(const py::object& owner, const std::vector<T>& values) {
  using S = Scalar<T>;
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(values.size())};
  if (S::columns > 0) shape.push_back(S::columns);
  py::array_t<typename S::type> array(shape, reinterpret_cast<const typename S::type*>(values.data()), owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// f of the mesh, in coordinates whose products are doubles.
template <class F>
auto in_range(const Indexed_mesh_3& mesh, const F& f) {
  const int exponent = pgdr::exponent_for(mesh);
  return exponent == 0 ? f(mesh) : f(pgdr::scaled_to(mesh, exponent));
}

py::dict statistics_of(const Mesh& mesh) {
  const pgdr::Mesh_quality q = without_gil(0, [&] { return in_range(mesh.arrays, [](const Indexed_mesh_3& m) { return pgdr::mesh_quality(m); }); });
  char checksum[17];
  std::snprintf(checksum, sizeof checksum, "%016llx", static_cast<unsigned long long>(pgdr::mesh_checksum(mesh.arrays)));
  py::dict d;
  d["vertices"] = q.vertices;
  d["tetrahedra"] = q.tetrahedra;
  d["triangles"] = q.triangles;
  d["edges"] = q.edges;
  d["volume"] = q.volume;
  d["region_volumes"] = q.region_volumes;
  d["max_radius_edge_ratio"] = q.max_radius_edge_ratio;
  d["mean_radius_edge_ratio"] = q.mean_radius_edge_ratio;
  d["max_circumradius"] = q.max_circumradius;
  d["min_dihedral_deg"] = q.min_dihedral_deg;
  d["max_dihedral_deg"] = q.max_dihedral_deg;
  d["checksum"] = checksum;
  return d;
}

pgdr::Point_placement placement_of(const std::string& text) {
  if (text == "lazy") return pgdr::Point_placement::lazy;
  if (text == "circumcenter") return pgdr::Point_placement::circumcenter;
  if (text == "type1") return pgdr::Point_placement::type1;
  if (text == "type2") return pgdr::Point_placement::type2;
  throw py::value_error("placement has to be 'lazy', 'circumcenter', 'type1' or 'type2'");
}

/// What is meshed of `input`, which is valid: what is left without what is smaller than the tolerance. Sets how widely that is fused. Throws `Input_error`.
pgdr::Understood understood(const Plc& input, double tolerance, pgdr::Parameters& p) {
  pgdr::Simplification_within done;
  const Plc plc = pgdr::simplify_as_far_as_valid(pgdr::normalized(input), tolerance, p.coplanar_tolerance, p.triangulate_facets, &done);
  if (done.understood) return std::move(*done.understood);
  pgdr::Understood result = pgdr::understand(plc, p.coplanar_tolerance, p.triangulate_facets);
  result.require_valid();
  return result;
}

Mesh make_mesh(const Plc& input, const py::object& size, const py::object& facet_sizes, const std::optional<double>& curvature,
               const std::optional<double>& cells_across, double gradation, pgdr::Parameters p, const std::string& placement, double tolerance, unsigned threads, const py::object& progress) {
  require_same_process();
  p.placement = placement_of(placement);
  if (p.max_memory == 0) p.max_memory = pgdr::attainable_memory_bytes().value_or(0) / 10 * 9;
  const auto [domain, warnings] = without_gil(threads, [&] { return understood(input, tolerance, p); });
  for (const pgdr::Input_problem& problem : warnings)
    if (PyErr_WarnEx(PyExc_UserWarning, problem.message.c_str(), 3) != 0) throw py::error_already_set();
  const auto errors = std::make_shared<pgdr_python::First_error>();
  std::atomic<bool> cancel{false};
  std::mutex mutex;
  std::optional<pgdr::Progress> last;
  p.cancel = &cancel;
  p.progress = [&](const pgdr::Progress& now) {
    const std::lock_guard lock(mutex);
    last = now;
  };
  Mesh mesh;
  {
    // Made and destroyed with the GIL; called without.
    const pgdr::Combined_sizing_field sizing = pgdr_python::sizing_of(size, facet_sizes, curvature, cells_across, gradation, domain, errors);
    const auto look = [&] {
      if (progress.is_none()) return;
      std::optional<pgdr::Progress> now;
      {
        const std::lock_guard lock(mutex);
        now = std::exchange(last, std::nullopt);
      }
      if (now) progress(now->phase, now->vertices, now->pending);
    };
    try {
      run_interruptibly(
          cancel,
          [&] {
            pgdr::with_threads(threads, [&] {
              auto [arrays, statistics] = pgdr::mesh_domain(Domain(domain), sizing, p);
              mesh.stop = pgdr::stop_reason_name(statistics.stop);
              mesh.message = statistics.stop_message;
              mesh.missing = statistics.unrecovered;
              mesh.arrays = pgdr::scaled_to(std::move(arrays), 0);
            });
          },
          look);
    } catch (const py::error_already_set&) {
      throw;
    } catch (...) {
      errors->rethrow();
      throw;
    }
  }
  errors->rethrow();
  return mesh;
}

const char* kind_name(pgdr::Input_problem::Kind kind) {
  using Kind = pgdr::Input_problem::Kind;
  switch (kind) {
    case Kind::unreadable: return "unreadable";
    case Kind::bad_coordinate: return "bad_coordinate";
    case Kind::bad_index: return "bad_index";
    case Kind::degenerate_facet: return "degenerate_facet";
    case Kind::non_planar_facet: return "non_planar_facet";
    case Kind::self_intersection: return "self_intersection";
    case Kind::open_surface: return "open_surface";
    case Kind::empty: return "empty";
    case Kind::bad_seed: return "bad_seed";
    case Kind::ambiguous_seed: return "ambiguous_seed";
  }
  return "unknown";
}

void add_errors(py::module_& m) {
  static const py::object* const input_error = new py::object(py::reinterpret_steal<py::object>(PyErr_NewExceptionWithDoc(
      "pgdr.InputError", "Input that cannot be meshed. `problems` has a dictionary for each thing that is wrong: kind, message, facets and vertices.",
      PyExc_ValueError, nullptr)));
  m.attr("InputError") = *input_error;
  py::register_exception_translator([](std::exception_ptr p) {
    try {
      if (p) std::rethrow_exception(std::move(p));
    } catch (const pgdr::Input_error& e) {
      py::object error = (*input_error)(e.what());
      py::list problems;
      for (const pgdr::Input_problem& problem : e.problems()) {
        py::dict d;
        d["kind"] = kind_name(problem.kind);
        d["message"] = problem.message;
        d["facets"] = problem.facets;
        d["vertices"] = problem.vertices;
        problems.append(d);
      }
      error.attr("problems") = problems;
      PyErr_SetObject(input_error->ptr(), error.ptr());
    } catch (const py::error_already_set&) {
      throw;
    } catch (const py::cast_error&) {
      PyErr_SetString(PyExc_TypeError, "an argument, or something in it, has a type that cannot be used here: see help(pgdr)");
    } catch (const pgdr::Sizing_error& e) {
      PyErr_SetString(PyExc_ValueError, e.what());
    }
  });
}

void add_plc(py::module_& m) {
  py::class_<Plc>(m, "Plc")
      .def(py::init(&make_plc), py::arg("points"), py::arg("facets"), py::kw_only(), py::arg("markers") = py::none(), py::arg("regions") = py::none(),
           py::arg("holes") = py::none(), py::arg("nesting") = "fill", py::arg("marker_names") = Names{}, py::arg("region_names") = Names{})
      .def_property_readonly("points",
                             [](const Plc& plc) {
                               Points points({static_cast<py::ssize_t>(plc.vertices.size()), py::ssize_t{3}});
                               auto p = points.mutable_unchecked<2>();
                               const double unit = pgdr::unit_of(plc);
                               for (std::size_t i = 0; i < plc.vertices.size(); ++i)
                                 for (int k = 0; k < 3; ++k) p(static_cast<py::ssize_t>(i), k) = unit * plc.vertices[i][k];
                               return points;
                             })
      .def_property_readonly("facets",
                             [](const Plc& plc) {
                               std::vector<std::vector<std::vector<Index>>> facets;
                               for (const auto& f : plc.facets) facets.push_back(f.polygons);
                               return facets;
                             })
      .def_property_readonly("markers",
                             [](const Plc& plc) {
                               std::vector<int> markers;
                               for (const auto& f : plc.facets) markers.push_back(f.marker);
                               return py::array_t<int>(static_cast<py::ssize_t>(markers.size()), markers.data());
                             })
      .def_property_readonly("diagonal", [](const Plc& plc) { return pgdr::bounding_diagonal(plc); })
      .def_property_readonly("is_surface", [](const Plc& plc) { return plc.nesting == pgdr::Nesting::alternate; })
      .def_readwrite("name", &Plc::name)
      .def_property(
          "marker_names", [](const Plc& plc) { return plc.names.markers; }, [](Plc& plc, Names names) { plc.names.markers = std::move(names); })
      .def_property(
          "region_names", [](const Plc& plc) { return plc.names.regions; }, [](Plc& plc, Names names) { plc.names.regions = std::move(names); })
      .def("mark_patches", [](Plc& plc, double angle) { return pgdr::mark_patches(plc, angle); }, py::arg("angle"))
      .def("write", [](const Plc& plc, const std::filesystem::path& path) {
        if (path.extension() != ".poly") throw py::value_error("'" + path.string() + "' does not end in .poly");
        pgdr::write_poly(plc, path);
      }, py::arg("path"))
      .def("__repr__", [](const Plc& plc) {
        return "<pgdr.Plc of " + std::to_string(plc.vertices.size()) + " points, " + std::to_string(plc.facets.size()) + " facets>";
      });
  m.def(
      "read",
      [](const std::filesystem::path& path, const std::string& from) {
        const pgdr::Markers_from markers = markers_from(from);
        const py::gil_scoped_release release;
        return pgdr::normalized(pgdr::read_plc(path, markers));
      },
      py::arg("path"), py::kw_only(), py::arg("markers_from") = "names");
  m.def(
      "repair",
      [](const Plc& plc, double tolerance, double largest_hole) {
        return without_gil(0, [&] { return pgdr::repair(plc, {tolerance, largest_hole}); });
      },
      py::arg("plc"), py::kw_only(), py::arg("tolerance"), py::arg("largest_hole"));
  m.def(
      "assemble",
      [](const std::vector<Plc>& parts, double tolerance, double largest_hole) {
        return without_gil(0, [&] { return pgdr::assemble(parts, {tolerance, largest_hole}); });
      },
      py::arg("parts"), py::kw_only(), py::arg("tolerance"), py::arg("largest_hole"));
}

void add_mesh(py::module_& m) {
  const auto array = [](auto Indexed_mesh_3::*values) { return [values](const py::object& self) { return view(self, self.cast<const Mesh&>().arrays.*values); }; };
  py::class_<Mesh>(m, "RawMesh")
      .def_property_readonly("points", array(&Indexed_mesh_3::points))
      .def_property_readonly("tetrahedra", array(&Indexed_mesh_3::tetrahedra))
      .def_property_readonly("regions", array(&Indexed_mesh_3::tetrahedron_references))
      .def_property_readonly("triangles", array(&Indexed_mesh_3::triangles))
      .def_property_readonly("markers", array(&Indexed_mesh_3::triangle_references))
      .def_property_readonly("edges", array(&Indexed_mesh_3::edges))
      .def_property_readonly("edge_markers", array(&Indexed_mesh_3::edge_references))
      .def_property_readonly("point_markers", array(&Indexed_mesh_3::point_references))
      .def_property_readonly("point_dimensions", array(&Indexed_mesh_3::point_dimensions))
      .def_property_readonly("exempt", array(&Indexed_mesh_3::exempt))
      .def_property_readonly("unrefined", array(&Indexed_mesh_3::unrefined))
      .def_property_readonly("tetrahedron_nodes", array(&Indexed_mesh_3::tetrahedron_nodes))
      .def_property_readonly("triangle_nodes", array(&Indexed_mesh_3::triangle_nodes))
      .def_property_readonly("marker_names", [](const Mesh& mesh) { return mesh.arrays.names.markers; })
      .def_property_readonly("region_names", [](const Mesh& mesh) { return mesh.arrays.names.regions; })
      .def_property_readonly("distinct_names",
                             [](const Mesh& mesh) {
                               const pgdr::Reference_names names = pgdr::distinct_names(mesh.arrays.names);
                               return std::pair(names.markers, names.regions);
                             })
      .def_readonly("stop", &Mesh::stop)
      .def_readonly("message", &Mesh::message)
      .def_readonly("missing", &Mesh::missing)
      .def("statistics", &statistics_of)
      .def("add_midside_nodes", [](Mesh& mesh) { without_gil(0, [&] { pgdr::add_midside_nodes(mesh.arrays); }); })
      .def(
          "write",
          [](const Mesh& mesh, const std::filesystem::path& path, bool vtu_triangles, const std::string& gmsh_format, bool outer_triangles) {
            pgdr::Write_options options;
            options.vtu.triangles = vtu_triangles;
            const auto format = pgdr::gmsh_format_named(gmsh_format);
            if (!format) throw std::invalid_argument("gmsh_format has to be '4.1', '4.1-ascii' or '2.2', not '" + gmsh_format + "'");
            options.gmsh = *format;
            without_gil(0, [&] {
              in_range(mesh.arrays, [&](const Indexed_mesh_3& scaled) {
                if (!outer_triangles) return pgdr::write_mesh(scaled, path, options);
                Indexed_mesh_3 outer = scaled;
                pgdr::keep_outer_triangles(outer);
                pgdr::write_mesh(outer, path, options);
              });
            });
          },
          py::arg("path"), py::arg("vtu_triangles"), py::arg("gmsh_format"), py::arg("outer_triangles"))
      .def(
          "check",
          [](const Mesh& mesh, const Plc* plc, double ratio, double coplanar_tolerance, bool triangulate) {
            pgdr::Check_options options;
            options.radius_edge_ratio = ratio;
            const auto lines = without_gil(0, [&] {
              std::optional<Domain> domain;
              if (plc) domain = pgdr::valid_domain(*plc, coplanar_tolerance, triangulate);
              return pgdr::check_mesh(mesh.arrays.tetrahedron_nodes.empty() ? mesh.arrays : pgdr::without_midside_nodes(mesh.arrays), domain ? &*domain : nullptr, options);
            });
            std::vector<std::tuple<std::string, bool, std::string>> result;
            for (const auto& line : lines) result.emplace_back(line.property, line.passed, line.detail);
            return result;
          },
          py::arg("plc"), py::arg("radius_edge_ratio"), py::arg("coplanar_tolerance"), py::arg("triangulate"));
  m.def(
      "mesh",
      [](const Plc& plc, const py::object& size, const py::object& facet_sizes, const std::optional<double>& curvature,
         const std::optional<double>& cells_across, double gradation, double radius_edge_ratio, double min_dihedral, std::size_t optimize, const std::string& placement, double tolerance, double coplanar_tolerance, bool triangulate, double min_edge_length,
         std::size_t max_vertices, std::size_t max_memory, double time_limit, unsigned threads, const py::object& progress) {
        pgdr::Parameters p;
        p.radius_edge_ratio = radius_edge_ratio;
        p.min_dihedral = min_dihedral;
        p.optimization_rounds = optimize;
        p.coplanar_tolerance = coplanar_tolerance;
        p.triangulate_facets = triangulate;
        p.min_edge_length = min_edge_length;
        p.max_vertices = max_vertices;
        p.max_memory = max_memory;
        p.time_limit = time_limit;
        return make_mesh(plc, size, facet_sizes, curvature, cells_across, gradation, p, placement, tolerance, threads, progress);
      },
      py::arg("plc"), py::kw_only(), py::arg("size"), py::arg("facet_sizes"), py::arg("curvature"), py::arg("cells_across"), py::arg("gradation"), py::arg("radius_edge_ratio"), py::arg("min_dihedral"),
      py::arg("optimize"), py::arg("placement"), py::arg("tolerance"), py::arg("coplanar_tolerance"), py::arg("triangulate"), py::arg("min_edge_length"),
      py::arg("max_vertices"), py::arg("max_memory"), py::arg("time_limit"), py::arg("threads"), py::arg("progress"));
}

}  // namespace

PYBIND11_MODULE(_pgdr, m) {
  require_same_process();  // remembers which
  m.attr("__version__") = PGDR_VERSION;
  add_errors(m);
  add_plc(m);
  pgdr_python::add_fields(m);
  add_mesh(m);
}
