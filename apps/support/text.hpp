#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace sigmax::apps {

/// Columns of a terminal that nobody has widened.
inline constexpr std::size_t terminal_width = 80;

/// As wide as it takes.
inline constexpr std::size_t any_width = 0;

/// Columns that UTF-8 text takes on a terminal: none for combining marks, two for East Asian characters.
std::size_t display_width(std::string_view text);

/// The words of a line; a sign as in "± 95" or "− sigma's" stays with what follows it.
std::vector<std::string> words_of(std::string_view line);

/// The lines of a text, broken between words so that none is wider than this, but for words that are. Line breaks in
/// the text are kept.
std::vector<std::string> lines_of(std::string_view text, std::size_t width);

/// The same as one text that no terminal takes for commands, see `printable`; each line ends with a line break.
/// `any_width` breaks none.
std::string wrapped(std::string_view text, std::size_t width = terminal_width);

}  // namespace sigmax::apps
