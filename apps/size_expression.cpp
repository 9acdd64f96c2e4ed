// SPDX-License-Identifier: GPL-3.0-or-later
#include "size_expression.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>

#include <muParser.h>

#include "arguments.h"

namespace pgdr::app {

namespace {

/// A parser and the place of its variables.
class Evaluator {
 public:
  explicit Evaluator(const std::string& text) {
    parser_.DefineVar("x", &point_[0]);
    parser_.DefineVar("y", &point_[1]);
    parser_.DefineVar("z", &point_[2]);
    parser_.SetExpr(text);
  }
  Evaluator(const Evaluator&) = delete;
  Evaluator& operator=(const Evaluator&) = delete;

  double at(const std::array<double, 3>& p) {
    point_ = p;
    return parser_.Eval();
  }

 private:
  std::array<double, 3> point_{};
  mu::Parser parser_;
};

}  // namespace

Command_line_sizing::Function parse_size_expression(const std::string& text) {
  try {
    Evaluator(text).at({});
  } catch (const mu::Parser::exception_type& error) {
    throw Usage_error("--size-expression: '" + text + "' is not an expression in x, y and z: " + error.GetMsg());
  }
  static std::atomic<std::uint64_t> last{0};
  return [text, number = ++last](const std::array<double, 3>& p) {
    thread_local std::uint64_t number_here = 0;
    thread_local std::unique_ptr<Evaluator> evaluator;
    if (number_here != number) {
      evaluator = std::make_unique<Evaluator>(text);
      number_here = number;
    }
    return evaluator->at(p);
  };
}

}  // namespace pgdr::app
