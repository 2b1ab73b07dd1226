#include "shell/text.hpp"

#include <utf8proc.h>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <system_error>

namespace sigmax::apps {

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

std::string shortest(double value) {
  std::array<char, 32> text{};
  const auto result = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), result.ptr};
}

std::string toml_number(double value) {
  std::string text = shortest(value);
  if (std::abs(value) >= 0x1p53 && text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string toml_value(std::string_view value) {
  const auto starts_word = [](char byte) {
    const auto code = static_cast<unsigned char>(byte);
    return std::isalpha(code) != 0 || byte == '_' || code >= 0x80U;
  };
  const auto continues_token = [&](char byte) {
    return starts_word(byte) || std::isdigit(static_cast<unsigned char>(byte)) != 0 ||
           std::string_view{"+-.:"}.find(byte) != std::string_view::npos;
  };
  std::string text;
  while (!value.empty()) {
    std::size_t size = 1;
    bool word = false;
    if (const char first = value[0]; first == '"' || first == '\'') {
      while (size < value.size() && value[size] != first) size += first == '"' && value[size] == '\\' ? 2U : 1U;
      size = std::min(size + 1, value.size());
    } else if (first == '#') {
      size = value.size();
    } else if (continues_token(first)) {
      while (size < value.size() && continues_token(value[size])) ++size;
      const std::string_view name = value.substr(0, size);
      // A word before '=' is a key of an inline table.
      word = starts_word(first) && name != "true" && name != "false" && name != "inf" && name != "nan" &&
             !trimmed(value.substr(size)).starts_with('=');
    }
    std::string token(value.substr(0, size));
    const bool lacks_digit = token.ends_with('.') || token.find_first_not_of("+-") == token.find('.');
    if (const auto number = lacks_digit ? parse_number(token) : std::nullopt) token = fmt::format("{}", *number);
    text.append(word ? "\"" : "").append(token).append(word ? "\"" : "");
    value.remove_prefix(size);
  }
  return text;
}

std::size_t display_width(std::string_view text) {
  std::size_t width = 0;
  while (!text.empty()) {
    utf8proc_int32_t character = 0;
    const auto size = utf8proc_iterate(reinterpret_cast<const utf8proc_uint8_t*>(text.data()),
                                       static_cast<utf8proc_ssize_t>(text.size()), &character);
    width += size > 0 ? static_cast<std::size_t>(utf8proc_charwidth(character)) : 1;  // or a byte that is no text
    text.remove_prefix(size > 0 ? static_cast<std::size_t>(size) : 1);
  }
  return width;
}

std::size_t widest(const std::vector<std::string>& lines) {
  std::size_t width = 0;
  for (const std::string& line : lines) width = std::max(width, display_width(line));
  return width;
}

std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> words;
  bool joined = false;
  while (!line.empty()) {
    const auto blank = std::min(line.find(' '), line.size());
    const std::string_view word = line.substr(0, blank);
    line.remove_prefix(std::min(blank + 1, line.size()));
    if (!words.empty() && (joined || word == "±" || word == "="))
      words.back().append(" ").append(word);
    else
      words.emplace_back(word);
    joined = word == "±" || word == "−" || word == "=";
  }
  return words;
}

std::vector<std::string> lines_of(std::string_view text, std::size_t width) {
  std::vector<std::string> lines;
  for (bool more = true; more;) {
    const auto end = text.find('\n');
    more = end != std::string_view::npos;
    const std::string_view line = text.substr(0, end);
    if (more) text.remove_prefix(end + 1);
    if (width == any_width || display_width(line) <= width) {
      lines.emplace_back(line);
      continue;
    }
    const std::string indent(std::min(line.find_first_not_of(' '), line.size()), ' ');
    std::string current;
    for (const std::string& word : words_of(line.substr(indent.size()))) {
      if (!current.empty() && display_width(current) + 1 + display_width(word) > width)
        lines.push_back(std::exchange(current, {}));
      current += (current.empty() ? indent : " ") + word;
    }
    lines.push_back(current);
  }
  return lines;
}

std::string wrapped(std::string_view text, std::size_t width) {
  std::string result;
  if (text.ends_with('\n')) text.remove_suffix(1);
  for (const std::string& line : lines_of(printable(text, true), width)) result += line + "\n";
  return result;
}

std::string lower_case(std::string_view text) {
  std::string result(text);
  for (char& letter : result)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return result;
}

std::string in_shell(std::string_view word) {
  if (word.find_first_of(" \"'#?*!$&|;<>()[]{}~`\\") == word.npos) return std::string(word);
  const bool takes_single = word.find('\'') == word.npos || word.find_first_of("$`\\!\"") != word.npos;
  return fmt::format("{0}{1}{0}", takes_single ? '\'' : '"', word);
}

namespace {

constexpr std::size_t longest_quote = 60;

bool continues_a_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }

}  // namespace

std::string message(const Complaint& complaint) {
  std::string text;
  const auto append = [&text](std::string_view separator, std::string_view prefix, std::string_view part) {
    if (part.empty()) return;
    if (!text.empty()) text += separator;
    text.append(prefix).append(part);
  };
  append("", "", complaint.where);
  append(": ", "", complaint.what);
  append(": ", "found ", complaint.found);
  append(complaint.found.empty() ? ": " : ", ", "expected ", complaint.expected);
  append("; ", "", complaint.remedy);
  return text;
}

std::string in_quotes(std::string_view text) {
  const bool cut = text.size() > longest_quote;
  if (cut) {
    std::size_t size = longest_quote;
    while (size > 0 && continues_a_character(text[size])) --size;
    text = text.substr(0, size);
  }
  return "'" + printable(text) + (cut ? "…'" : "'");
}

std::string escaped(std::string_view text, std::string_view format, std::string_view kept) {
  std::string shown;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto code = static_cast<unsigned char>(text[i]);
    const auto next = i + 1 < text.size() ? static_cast<unsigned char>(text[i + 1]) : 0U;
    if (code == 0xC2U && next >= 0x80U && next < 0xA0U) {  // U+0080 … U+009F are control characters too
      shown += fmt::format(fmt::runtime(format), next);
      ++i;
    } else if ((code < 0x20U || code == 0x7FU) && kept.find(text[i]) == std::string_view::npos) {
      shown += fmt::format(fmt::runtime(format), unsigned{code});
    } else {
      shown += text[i];
    }
  }
  return shown;
}

std::string reason(int error_number) { return std::generic_category().message(error_number); }

}  // namespace sigmax::apps
