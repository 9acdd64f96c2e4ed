// SPDX-License-Identifier: GPL-3.0-or-later
#include "size_expression.h"

#include <array>
#include <atomic>
#include <cstddef>
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

  /// How many the last evaluation had.
  int values() const { return parser_.GetNumResults(); }

 private:
  std::array<double, 3> point_{};
  mu::Parser parser_;
};

/// Whether an equals sign stands for itself, and not in ==, !=, <= or >=.
bool assigns(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    const char before = i > 0 ? text[i - 1] : ' ', after = i + 1 < text.size() ? text[i + 1] : ' ';
    if (after == '=') ++i;
    else if (before != '!' && before != '<' && before != '>') return true;
  }
  return false;
}

}  // namespace

Combined_sizing_field::Function parse_size_expression(const std::string& text) {
  try {
    if (text.find_first_not_of(" \t") == std::string::npos) throw Usage_error("--size-expression is empty");
    Evaluator evaluator(text);
    evaluator.at({});
    if (evaluator.values() != 1) throw Usage_error("--size-expression: '" + text + "' has several values; a decimal point is a point, not a comma");
    if (assigns(text)) throw Usage_error("--size-expression: '" + text + "' assigns to a variable: a size is wanted");
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
