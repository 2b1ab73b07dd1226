#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

namespace sigmax::apps {

/// Opens a file for reading bytes. Throws InputError with the reason if it is a directory or cannot be read.
std::ifstream open_input(const std::filesystem::path& path);

/// All bytes of a file; throws InputError as `open_input` does, and if reading fails half-way.
std::string read_text(const std::filesystem::path& path);

/// Text without the blanks and tabs around it.
std::string_view trimmed(std::string_view text);

/// A finite decimal number, whatever the locale; a leading '+' and blanks around it are allowed, and nothing else.
std::optional<double> parse_number(std::string_view text);

}  // namespace sigmax::apps
