// SPDX-License-Identifier: GPL-3.0-or-later
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>
#include <string>

#include <pgdr/io/atomic_file.h>
#include <pgdr/io/output_error.h>
#include <pgdr/io/write_mesh.h>

#include "../catch.h"
#include "temporary_folder.h"

using pgdr::Atomic_file;
using pgdr::Output_error;
using pgdr_test::content_of;
using pgdr_test::Temporary_folder;

namespace {

std::string writable_failure(const std::filesystem::path& path) {
  try {
    pgdr::check_writable(path);
  } catch (const Output_error& error) {
    return error.what();
  }
  return "";
}

bool says(const std::string& message, const std::string& text) {
  return message.find(text) != std::string::npos;
}

/// No file may grow beyond this many bytes while it lives: a full disk in small.
class File_size_limit {
 public:
  explicit File_size_limit(rlim_t bytes) {
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~File_size_limit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  File_size_limit(const File_size_limit&) = delete;
  File_size_limit& operator=(const File_size_limit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

}  // namespace

TEST_CASE("Atomic_file: appears on commit only, and replaces whole") {
  const Temporary_folder folder;
  const auto target = folder.write("a.txt", "old");
  {
    Atomic_file file(target);
    file.write("new content");
    CHECK(file.position() == 11);
    CHECK(content_of(target) == "old");
    file.commit();
  }
  CHECK(content_of(target) == "new content");
  CHECK(folder.size() == 1);
}

TEST_CASE("Atomic_file: without commit nothing is left and the target is as before") {
  const Temporary_folder folder;
  const auto target = folder.write("a.txt", "old");
  try {
    Atomic_file file(target);
    file.write(std::string(5 << 20, 'x'));
    CHECK(folder.size() == 2);
    throw std::runtime_error("stop");
  } catch (const std::runtime_error&) {
  }
  CHECK(folder.size() == 1);
  CHECK(content_of(target) == "old");
}

TEST_CASE("Atomic_file: overwrite reaches flushed and buffered bytes") {
  const Temporary_folder folder;
  std::string expected;
  Atomic_file file(folder / "a.bin");
  for (int i = 0; i < 400000; ++i) {
    const std::string text = std::to_string(i) + "\n";
    file.write(text);
    expected += text;
  }
  file.overwrite(3, "abc", 3);
  expected.replace(3, 3, "abc");
  file.write("tail");
  expected += "tail";
  file.overwrite(expected.size() - 4, "T", 1);
  expected[expected.size() - 4] = 'T';
  file.commit();
  CHECK(content_of(folder / "a.bin") == expected);
}

TEST_CASE("Atomic_file: a full disk is an error that leaves nothing behind") {
  const Temporary_folder folder;
  const auto target = folder.write("a.mesh", "old");
  pgdr::Indexed_mesh_3 mesh;
  mesh.points.assign(100000, {0.1, 0.2, 0.3});
  mesh.tetrahedra.assign(100000, {0, 1, 2, 3});
  std::string message;
  for (const char* name : {"a.mesh", "b.mesh", "b.vtu"}) {
    const File_size_limit limit(1000);
    try {
      pgdr::write_mesh(mesh, folder / name);
      FAIL("written");
    } catch (const Output_error& error) {
      message = error.what();
    }
    CHECK(says(message, name));
    CHECK(says(message, "File too large"));
  }
  CHECK(folder.size() == 1);
  CHECK(content_of(target) == "old");
}

TEST_CASE("Atomic_file: keeps permissions and writes through links") {
  const Temporary_folder folder;
  const auto target = folder.write("a.txt", "old");
  ::chmod(target.c_str(), 0600);
  std::filesystem::create_symlink(target, folder / "link.txt");
  Atomic_file file(folder / "link.txt");
  file.write("new");
  file.commit();
  CHECK(std::filesystem::is_symlink(folder / "link.txt"));
  CHECK(content_of(target) == "new");
  std::filesystem::create_symlink("later.txt", folder / "early.txt");  // to what is not there yet
  Atomic_file early(folder / "early.txt");
  early.write("late");
  early.commit();
  CHECK(std::filesystem::is_symlink(folder / "early.txt"));
  CHECK(content_of(folder / "later.txt") == "late");
  struct stat status;
  REQUIRE(::stat(target.c_str(), &status) == 0);
  CHECK((status.st_mode & 0777) == 0600);
}

TEST_CASE("check_writable: finds out before the work starts") {
  const Temporary_folder folder;
  const auto file = folder.write("a.vtu", "old");
  CHECK(writable_failure(file).empty());
  CHECK(writable_failure(folder / "new.vtu").empty());
  CHECK(content_of(file) == "old");
  CHECK(folder.size() == 1);

  CHECK(says(writable_failure(folder / "no/such/out.vtu"), "does not exist"));
  CHECK(says(writable_failure(folder / "a.vtu/out.vtu"), "is not a folder"));
  CHECK(says(writable_failure(folder.path()), "it is a folder"));
  CHECK(says(writable_failure(folder.path().string() + "/"), "names no file"));
  CHECK(says(writable_failure("/dev/null"), "not a regular file"));
  CHECK(says(writable_failure(""), "names no file"));
  if (::geteuid() != 0) {
    ::chmod(folder.path().c_str(), 0500);
    CHECK(says(writable_failure(folder / "new.vtu"), "ermission"));
    ::chmod(folder.path().c_str(), 0700);
  }
}

TEST_CASE("write_mesh: goes by the extension") {
  CHECK(pgdr::is_known_mesh_extension("a/b.mesh"));
  CHECK(pgdr::is_known_mesh_extension("b.VTU"));
  CHECK_FALSE(pgdr::is_known_mesh_extension("b.stl"));
  CHECK_FALSE(pgdr::is_known_mesh_extension("mesh"));
  CHECK_THROWS_AS(pgdr::write_mesh({}, "b.stl"), std::invalid_argument);
}
