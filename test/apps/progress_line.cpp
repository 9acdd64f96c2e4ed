// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>

#include <pty.h>
#include <unistd.h>

#include <pgdr/report/progress_line.h>

namespace pgdr {
namespace {

using namespace std::chrono_literals;

std::string text_of(std::FILE* file) {
  std::string text;
  std::rewind(file);
  for (int c; (c = std::fgetc(file)) != EOF;) text.push_back(static_cast<char>(c));
  return text;
}

/// Until what `file` holds contains `part`, or ten seconds have passed.
bool comes(std::FILE* file, const std::string& part) {
  for (int i = 0; i < 1000; ++i, std::this_thread::sleep_for(10ms))
    if (text_of(file).find(part) != std::string::npos) return true;
  return false;
}

TEST_CASE("Where it is known how many vertices there will be, the share that is done is told") {
  std::FILE* file = std::tmpfile();
  REQUIRE(file != nullptr);
  {
    Progress_line line(true, nullptr, file);
    line.set_pace({5ms, 5ms});
    line.update({"conforming", 100, 7});
    line.update({"refinement", 100, 7});
    CHECK_FALSE(text_of(file).find('%') != std::string::npos);
    line.expect(1100);
    std::this_thread::sleep_for(1100ms);
    line.update({"refinement", 850, 900});
    CHECK(comes(file, ": 75 %, about 1 s left, 850 vertices, 900 elements pending"));
    line.update({"refinement", 5000, 900});
    CHECK(comes(file, ": 99 %"));  // it was only an estimate
    line.update({"removing slivers", 5000, 80});
    std::this_thread::sleep_for(1100ms);
    line.update({"removing slivers", 5001, 60});
    CHECK(comes(file, ": 25 %, about 4 s left, 5,001 vertices, 60 elements pending"));
  }
  std::fclose(file);
}

TEST_CASE("A log gets a line now and then, though the program calls nothing") {
  std::FILE* file = std::tmpfile();
  REQUIRE(file != nullptr);
  {
    Progress_line line(true, nullptr, file);
    line.show("numbering");
    CHECK(text_of(file).empty());
    line.set_pace({1ms, 1ms});
    CHECK(comes(file, "numbering\n"));
    line.update({"refinement", 1234, 5});
    CHECK(comes(file, "refinement: 1,234 vertices, 5 elements pending\n"));
    CHECK(comes(file, "refinement, 1 s: 1,234 vertices, 5 elements pending\n"));
  }
  CHECK(text_of(file).find('\r') == std::string::npos);
  std::fclose(file);
}

TEST_CASE("An interrupt is confirmed at once") {
  std::FILE* file = std::tmpfile();
  REQUIRE(file != nullptr);
  std::atomic<bool> interrupt = false;
  {
    Progress_line line(true, &interrupt, file);
    line.show("refinement");
    interrupt = true;
    CHECK(comes(file, "stopping: "));
  }
  std::fclose(file);
}

TEST_CASE("A line on a narrow terminal is cut, and gone in the end") {
  struct winsize size {};
  size.ws_row = 10;
  size.ws_col = 20;
  int master = -1, slave = -1;
  REQUIRE(openpty(&master, &slave, nullptr, nullptr, &size) == 0);
  std::FILE* terminal = fdopen(slave, "w");
  {
    Progress_line line(true, nullptr, terminal);
    line.show("writing a_file_with_a_long_name.vtu");
  }
  std::fclose(terminal);
  std::string text;
  char part[256];
  // A terminal hands over what was written bit by bit, and an error when that is all.
  for (ssize_t n; (n = read(master, part, sizeof part)) > 0;) text.append(part, static_cast<std::size_t>(n));
  close(master);
  CHECK(text.starts_with("\rwriting a_file_with\x1b[K"));
  CHECK(text.ends_with("\r\x1b[K"));
}

}  // namespace
}  // namespace pgdr
