// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef PGDR_SRC_IO_NUMBERS_H
#define PGDR_SRC_IO_NUMBERS_H

#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>

namespace pgdr::io_detail {

/// No double and no 64-bit integer needs more characters than this.
constexpr std::size_t max_number_length = 26;

/// Writes a number in the fewest digits that read back to the same bits; returns the end.
template <class T>
char* put_number(char* out, T value) {
  return std::to_chars(out, out + max_number_length, value).ptr;
}

inline char* put_char(char* out, char c) {
  *out = c;
  return out + 1;
}

/// Reads a whole token as a double; false when it is no number. The value can be infinite or NaN.
inline bool parse_real(std::string_view token, double& value) {
  if (token.size() > 1 && token.front() == '+' && token[1] != '-') token.remove_prefix(1);
  const char* const last = token.data() + token.size();
  const auto [end, error] = std::from_chars(token.data(), last, value);
  if (end != last || error == std::errc::invalid_argument) return false;
  // Too large or too small for a double: strtod says which, and rounds to infinity or zero.
  if (error == std::errc::result_out_of_range) value = std::strtod(std::string(token).c_str(), nullptr);
  return true;
}

/// Reads a whole token as an integer; false when it is none or does not fit.
template <class T>
bool parse_integer(std::string_view token, T& value) {
  if (token.size() > 1 && token.front() == '+' && token[1] != '-') token.remove_prefix(1);
  const char* const last = token.data() + token.size();
  const auto [end, error] = std::from_chars(token.data(), last, value);
  return end == last && error == std::errc();
}

}  // namespace pgdr::io_detail

#endif
