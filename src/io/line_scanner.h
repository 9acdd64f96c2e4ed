// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SRC_IO_LINE_SCANNER_H
#define PGDR_SRC_IO_LINE_SCANNER_H

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "file_text.h"
#include "numbers.h"

namespace pgdr::io_detail {

/// What a number belongs to, put into words only when it is wrong: "vertex 12", or nothing.
struct Label {
  const char* noun = "";
  std::size_t number = 0;

  std::string text() const { return noun + (" " + std::to_string(number)); }
  std::string of(const std::string& what) const { return *noun == 0 ? what : what + " of " + text(); }
};

/// Steps through the lines of a text and the blank-separated words of a line; everything from '#' to
/// the end of the line is a comment, lines without words are skipped. Failures name file and line.
class Line_scanner {
 public:
  using Kind = Input_problem::Kind;

  Line_scanner(std::string_view text, const std::filesystem::path& path) : text_(text), path_(path) {
    if (text_.substr(0, 3) == "\xEF\xBB\xBF") next_ = 3;  // byte order mark
  }

  /// To the next line that has a word; false at the end of the text.
  bool next_line() {
    while (next_ < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', next_), text_.size());
      line_text_ = rest_ = text_.substr(next_, end - next_);
      next_ = end + 1;
      ++line_;
      rest_ = rest_.substr(0, rest_.find('#'));
      comment_length_ = line_text_.size() - rest_.size();
      skip_blanks();
      if (!rest_.empty()) return true;
    }
    rest_ = {};
    return false;
  }

  /// As `next_line()`, and the text must not end here: `missing` says what should follow.
  void need_line(const char* missing, Label owner = {}) {
    if (!next_line()) fail(Kind::unreadable, "the file ends before " + owner.of(missing));
  }
  void need_line(Label missing) {
    if (!next_line()) fail(Kind::unreadable, "the file ends before " + missing.text());
  }

  bool at_end_of_line() const { return rest_.empty(); }

  /// The next word of the line, empty when there is none.
  std::string_view word() {
    std::size_t length = 0;
    while (length < rest_.size() && !is_blank(rest_[length])) ++length;
    const std::string_view result = rest_.substr(0, length);
    rest_.remove_prefix(length);
    skip_blanks();
    return result;
  }

  /// All that is left of the line, without blanks around it.
  std::string_view rest() {
    std::string_view result = rest_;
    rest_ = {};
    while (!result.empty() && is_blank(result.back())) result.remove_suffix(1);
    return result;
  }

  /// The same with what looks like a comment: for texts that may hold '#'.
  std::string_view rest_with_comment() {
    rest_ = line_text_.substr(line_text_.size() - rest_.size() - comment_length_);
    comment_length_ = 0;
    return rest();
  }

  double real(const char* what, Label owner = {}) {
    const std::string_view token = word();
    double value = 0;
    if (token.empty()) fail(Kind::unreadable, "the line ends before " + owner.of(what));
    if (!parse_real(token, value)) not_a(owner.of(what), token, "a number");
    return value;
  }

  /// Three finite coordinates, with blanks or commas between them; not with both, as where commas are meant as decimal points.
  std::array<double, 3> point(Label owner) {
    static constexpr const char* names[3] = {"the x coordinate", "the y coordinate", "the z coordinate"};
    std::array<double, 3> p;
    std::array<bool, 2> is_comma{};  // without a blank
    for (std::size_t i = 0; i < 3; ++i) {
      const char* const begin = rest_.data();
      p[i] = real(names[i], owner);
      if (i < 2) is_comma[i] = rest_.data() > begin && rest_.data()[-1] == ',' && std::none_of(begin, rest_.data(), [](char c) { return c == ' ' || c == '\t'; });
      if (!std::isfinite(p[i])) {
        fail(Kind::bad_coordinate,
             owner.of(names[i]) + (std::isnan(p[i]) ? " is not a number" : " is infinite"));
      }
    }
    if (is_comma[0] != is_comma[1]) fail(Kind::unreadable, owner.text() + " has a number with a comma; decimals are written with a point");
    return p;
  }

  template <class T>
  T integer(const char* what, Label owner = {}) {
    const std::string_view token = word();
    T value = 0;
    if (token.empty()) fail(Kind::unreadable, "the line ends before " + owner.of(what));
    if (!parse_integer(token, value)) not_a(owner.of(what), token, "an integer in range");
    return value;
  }

  /// A count of things that take at least two bytes each: a wrong one fails before memory is asked for.
  std::size_t count(const char* what, Label owner = {}) {
    const auto value = integer<long long>(what, owner);
    if (value < 0) fail(Kind::unreadable, owner.of(what) + " is negative");
    if (static_cast<std::size_t>(value) > text_.size() / 2) {
      fail(Kind::unreadable,
           owner.of(what) + " is " + std::to_string(value) + ", but the file is too short for that");
    }
    return static_cast<std::size_t>(value);
  }

  std::size_t line() const { return line_; }
  const std::filesystem::path& path() const { return path_; }

  [[noreturn]] void fail(Kind kind, const std::string& what) const { fail_at(path_, line_, kind, what); }

 private:
  static bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == ',' || c == '\v' || c == '\f';
  }

  void skip_blanks() {
    std::size_t length = 0;
    while (length < rest_.size() && is_blank(rest_[length])) ++length;
    rest_.remove_prefix(length);
  }

  [[noreturn]] void not_a(const std::string& what, std::string_view token, const char* expected) const {
    std::string shown;
    for (const char c : token.substr(0, 40)) shown += std::isprint(static_cast<unsigned char>(c)) ? c : '?';
    fail(Kind::unreadable, what + " is '" + shown + "', not " + expected);
  }

  std::string_view text_;
  std::filesystem::path path_;
  std::string_view line_text_;  ///< the line as it stands
  std::string_view rest_;       ///< what is left of it, without the comment
  std::size_t comment_length_ = 0;
  std::size_t next_ = 0;
  std::size_t line_ = 0;
};

}  // namespace pgdr::io_detail

#endif
