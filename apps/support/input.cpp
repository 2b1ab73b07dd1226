#include "support/input.hpp"

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <system_error>

#include "support/error.hpp"

namespace sigmax::apps {

std::ifstream open_input(const std::filesystem::path& path) {
  std::error_code unknown;
  if (std::filesystem::is_directory(path, unknown))
    throw InputError("{}: found a directory, expected a file; name one of the files in it", path.native());
  errno = 0;
  std::ifstream stream{path, std::ios::binary};
  if (!stream)
    throw InputError("{}: cannot be read: {}; see whether its name and permissions are right", path.native(),
                     reason(errno));
  return stream;
}

std::string read_text(const std::filesystem::path& path) {
  auto stream = open_input(path);
  std::string text;
  std::array<char, 1 << 14> block{};
  errno = 0;
  while (stream.read(block.data(), block.size()) || stream.gcount() > 0)
    text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
  if (stream.bad()) throw InputError("{}: cannot be read: {}", path.native(), reason(errno));
  return text;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t";
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::optional<double> parse_number(std::string_view text) {
  text = trimmed(text);
  // std::from_chars takes no '+', and after one it must not be offered a '-'.
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  if (result.ec != std::errc{} || result.ptr != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace sigmax::apps
