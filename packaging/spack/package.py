# SPDX-License-Identifier: GPL-3.0-or-later
# A Spack recipe; `git` has to name where the project is kept. Not tried: there was no Spack where it was written.
from spack.package import *


class Pgdr(CMakePackage):
    """Tetrahedral meshes by parallel Delaunay refinement."""

    git = "file:///path/to/pgdr"
    license("GPL-3.0-or-later")
    version("main", branch="main")

    variant("python", default=True, description="Build the Python module")
    depends_on("cmake@3.22:", type="build")
    depends_on("cgal@5.5:")
    depends_on("intel-oneapi-tbb")
    depends_on("boost")
    depends_on("eigen@3.3:", type="build")
    depends_on("zlib-api")
    depends_on("cli11")
    depends_on("nlohmann-json")
    depends_on("muparser")
    depends_on("python", type=("build", "run"), when="+python")
    depends_on("py-pybind11", type="build", when="+python")
    depends_on("py-numpy", type=("build", "run"), when="+python")

    def cmake_args(self):
        return [self.define_from_variant("PGDR_BUILD_PYTHON", "python"), self.define("PGDR_BUILD_TESTS", False), self.define("PGDR_BUILD_BENCH", False)]
