// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_TEST_APPS_PROGRAM_H
#define PGDR_TEST_APPS_PROGRAM_H

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "catch.h"
#include "inputs.h"

namespace pgdr_test {

/// `text` as one word of the shell.
inline std::string quoted(const std::string& text) {
  std::string word = "'";
  for (char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

inline std::string file_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// What one run of the program left behind.
struct Run {
  int exit_code = -1;  ///< 128 + n when signal n ended it
  std::string out;
  std::string err;
};

/// An empty folder in which the program runs; gone with the object.
class Sandbox {
 public:
  Sandbox() {
    std::string name = (std::filesystem::temp_directory_path() / "pgdr-test-XXXXXX").string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    root_ = name;
    std::filesystem::create_directory(folder());
  }
  ~Sandbox() {
    std::error_code ignored;
    std::filesystem::remove_all(root_, ignored);
  }
  Sandbox(const Sandbox&) = delete;
  Sandbox& operator=(const Sandbox&) = delete;

  std::filesystem::path folder() const { return root_ / "work"; }
  std::filesystem::path operator/(const std::string& name) const { return folder() / name; }

  /// Writes a file and returns its name.
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder() / name, std::ios::binary) << text;
    return name;
  }

  /// Runs `pgdr ARGUMENTS` (as typed into a shell) inside the folder.
  Run run(const std::string& arguments) const {
    REQUIRE(std::filesystem::exists(app()));
    const auto out = root_ / "stdout", err = root_ / "stderr";
    const std::string command = "cd " + quoted(folder().string()) + " && " + quoted(app().string()) + " " +
                                arguments + " >" + quoted(out.string()) + " 2>" + quoted(err.string()) +
                                " </dev/null";
    const int status = std::system(command.c_str());
    Run run;
    run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    run.out = file_text(out);
    run.err = file_text(err);
    return run;
  }

  /// The names in the folder.
  std::set<std::string> names() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder()))
      names.insert(entry.path().filename().string());
    return names;
  }

 private:
  std::filesystem::path root_;
};

/// Whether it says that a phase has been at work for some seconds, as every ten seconds.
inline bool is_progress(const std::string& line) {
  return line.rfind("pgdr: ", 0) != 0 && line.size() > 2 && line.compare(line.size() - 2, 2, " s") == 0;
}

/// Runs the program and checks that it fails as promised: the exit code, some lines on stderr that begin
/// with "pgdr: ", but for progress, nothing on stdout, no file more or less, and all of `words` in the message.
inline Run check_fails(const Sandbox& sandbox, const std::string& arguments, int exit_code,
                       const std::vector<std::string>& words, bool one_line = true) {
  const std::set<std::string> before = sandbox.names();
  const Run run = sandbox.run(arguments);
  INFO("pgdr " << arguments << "\n" << run.err);
  CHECK(run.exit_code == exit_code);
  CHECK(run.out.empty());
  CHECK(sandbox.names() == before);
  std::istringstream lines(run.err);
  std::string line;
  int count = 0;
  while (std::getline(lines, line)) {
    if (is_progress(line)) continue;
    CHECK(line.rfind("pgdr: ", 0) == 0);
    ++count;
  }
  CHECK(count >= 1);
  if (one_line) CHECK(count == 1);
  for (const std::string& word : words) {
    INFO("expected: " << word);
    CHECK(run.err.find(word) != std::string::npos);
  }
  return run;
}

/// A shape of the project as a word of the shell.
inline std::string shape(const std::string& name) { return quoted(data_file(name).string()); }

}  // namespace pgdr_test

#endif
