#pragma once

#include <concepts>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace sigmax::apps {

/// The parts of a message to the user; empty parts are left out.
struct Complaint {
  std::string_view where{};     ///< "flight.csv:12"
  std::string_view what{};      ///< "column 'x_m'"
  std::string_view found{};     ///< "'abc'", see `in_quotes`
  std::string_view expected{};  ///< "a number"
  std::string_view remedy{};    ///< "correct the cell"
};

/// Reads "flight.csv:12: column 'x_m': found 'abc', expected a number; correct the cell".
std::string message(const Complaint& complaint);

/// What the user is told.
class UserError : public std::runtime_error {
 public:
  explicit UserError(const std::convertible_to<std::string> auto& text) : runtime_error(text) {}
  explicit UserError(const Complaint& complaint) : runtime_error(message(complaint)) {}

  template <class First, class... Rest>
  explicit UserError(fmt::format_string<First, Rest...> format, First&& first, Rest&&... rest)
      : runtime_error(fmt::format(format, std::forward<First>(first), std::forward<Rest>(rest)...)) {}
};

/// Bad data, a bad setting or an output that cannot be written; the program exits with 3.
class InputError : public UserError {
 public:
  using UserError::UserError;
};

/// A command line that means nothing; the program exits with 2.
class UsageError : public UserError {
 public:
  using UserError::UserError;
};

/// Text from a file as a message may show it: in quotes, control characters as \xNN, long text cut with an ellipsis.
std::string in_quotes(std::string_view text);

/// Text in which control characters, but for those that are kept, stand as a format says.
std::string escaped(std::string_view text, std::string_view format, std::string_view kept = {});

/// Text without control characters, which may be commands to a terminal: they are shown as \xNN. Line breaks stay if
/// they may.
inline std::string printable(std::string_view text, bool keep_line_breaks = false) {
  return escaped(text, "\\x{:02X}", keep_line_breaks ? "\n" : "");
}

/// The words of the operating system for an error number.
std::string reason(int error_number);

}  // namespace sigmax::apps
