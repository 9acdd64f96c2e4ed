// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_TEST_IO_READ_FAILURE_H
#define PGDR_TEST_IO_READ_FAILURE_H

#include <iostream>
#include <sstream>
#include <string>

#include <pgdr/domain/input_error.h>
#include <pgdr/io/read_plc.h>

#include "temporary_folder.h"

namespace pgdr_test {

/// Catches what a library prints behind our back.
class Cerr_capture {
 public:
  Cerr_capture() : before_(std::cerr.rdbuf(text_.rdbuf())) {}
  ~Cerr_capture() { std::cerr.rdbuf(before_); }
  Cerr_capture(const Cerr_capture&) = delete;
  Cerr_capture& operator=(const Cerr_capture&) = delete;
  std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
  std::streambuf* before_;
};

struct Failure {
  pgdr::Input_problem::Kind kind;
  std::string message;  ///< "" when nothing was thrown

  bool says(const std::string& text) const { return message.find(text) != std::string::npos; }
};

inline std::ostream& operator<<(std::ostream& out, const Failure& failure) { return out << failure.message; }

/// What reading a file with this name and content throws; nothing may be printed meanwhile, and the message
/// is one line.
inline Failure read_failure(const std::string& name, const std::string& content) {
  const Temporary_folder folder;
  const auto path = folder.write(name, content);
  const Cerr_capture capture;
  try {
    pgdr::read_plc(path);
  } catch (const pgdr::Input_error& error) {
    std::string message = error.what();
    if (!capture.text().empty()) message = "printed: " + capture.text();
    if (message.find(name) == std::string::npos) message = "no file name in: " + message;
    if (message.find('\n') != std::string::npos) message = "more than one line";
    return {error.problems().front().kind, message};
  }
  return {pgdr::Input_problem::Kind::unreadable, ""};
}

}  // namespace pgdr_test

#endif
