#include "support/error.hpp"

#include <cstddef>
#include <system_error>

#include <fmt/core.h>

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
  std::string shown = "'";
  for (const char byte : text) {
    const auto code = static_cast<unsigned char>(byte);
    if (code < 0x20U || code == 0x7FU)
      shown += fmt::format("\\x{:02X}", code);
    else
      shown += byte;
  }
  return shown += cut ? "…'" : "'";
}

std::string reason(int error_number) { return std::generic_category().message(error_number); }

}  // namespace sigmax::apps
