#include "shell/error.hpp"

#include <cstddef>
#include <system_error>

namespace sigmax::apps {
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
