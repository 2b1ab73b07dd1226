#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

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

inline constexpr double degree = std::numbers::pi / 180.0;  ///< in rad

/// A number that is not known: a gap in a curve, an empty cell.
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Text without the blanks and tabs around it.
std::string_view trimmed(std::string_view text);

/// A finite decimal number, whatever the locale; a leading '+' and blanks around it are allowed, and nothing else.
std::optional<double> parse_number(std::string_view text);

/// The shortest decimal number that reads back as the same double.
std::string shortest(double value);

/// The same as TOML reads it back: with a point where it would be an integer that no double may stand for.
std::string toml_number(double value);

/// A value as TOML takes it: words in quotes, so that a shell need not carry them, and digits to points.
std::string toml_value(std::string_view value);

/// Columns of a terminal that nobody has widened.
inline constexpr std::size_t terminal_width = 80;

/// As wide as it takes.
inline constexpr std::size_t any_width = 0;

/// Columns that UTF-8 text takes on a terminal: none for combining marks, two for East Asian characters.
std::size_t display_width(std::string_view text);

/// Those of the widest line.
std::size_t widest(const std::vector<std::string>& lines);

/// The words of a line; a sign as in "± 95" or "− sigma's" stays with what follows it.
std::vector<std::string> words_of(std::string_view line);

/// The lines of a text, broken between words so that none is wider than this, but for words that are. Line breaks in
/// the text are kept.
std::vector<std::string> lines_of(std::string_view text, std::size_t width);

/// The same as one text that no terminal takes for commands, see `printable`; each line ends with a line break.
/// `any_width` breaks none.
std::string wrapped(std::string_view text, std::size_t width = terminal_width);

/// With the letters A to Z as a to z.
std::string lower_case(std::string_view text);

/// What a function or a member tells of each of several things.
template <class Range, class Of>
auto each(const Range& range, const Of& of) {
  std::vector<std::remove_cvref_t<std::invoke_result_t<const Of&, decltype(*std::begin(range))>>> results;
  for (const auto& one : range) results.push_back(std::invoke(of, one));
  return results;
}

/// What a function tells of each of 0, 1, … below a number.
template <class Of>
auto each_below(std::size_t end, const Of& of) {
  std::vector<std::remove_cvref_t<std::invoke_result_t<const Of&, std::size_t>>> results;
  for (std::size_t i = 0; i < end; ++i) results.push_back(of(i));
  return results;
}

/// What a function or a member tells of each of several things, as words with commas between.
template <class Range, class Of = std::identity>
std::string list_of(const Range& range, const Of& of = {}) {
  return fmt::format("{}", fmt::join(each(range, of), ", "));
}

/// Letters to change, to add or to leave out until one word is the other (Levenshtein).
inline std::size_t spelling_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i] == b[j] ? 0U : 1U);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, diagonal + 1, row[j] + 1});
    }
  }
  return row.back();
}

/// "did you mean …?" where a known word is near, else nothing.
template <class Words>
std::string nearest_word(std::string_view word, const Words& known, std::string_view prefix = {}) {
  std::string_view nearest;
  std::size_t least = (word.size() + 2) / 3 + 1;
  for (const std::string_view candidate : known)
    if (const std::size_t distance = spelling_distance(word, candidate); distance < least) {
      least = distance;
      nearest = candidate;
    }
  return nearest.empty() ? "" : fmt::format("did you mean {}?", in_quotes(fmt::format("{}{}", prefix, nearest)));
}

/// As `nearest_word`, but all words where none is near.
template <class Words>
std::string suggestion(std::string_view word, const Words& known, std::string_view prefix = {}) {
  std::string text = nearest_word(word, known, prefix);
  return !text.empty() || known.empty() ? text : fmt::format("the known ones are {}", fmt::join(known, ", "));
}

/// A word as a shell takes it.
std::string in_shell(std::string_view word);

}  // namespace sigmax::apps
