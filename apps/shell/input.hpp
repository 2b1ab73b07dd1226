#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace sigmax::apps {

/// Opens a file for reading bytes. Throws InputError with the reason if it is a directory or cannot be read.
std::ifstream open_input(const std::filesystem::path& path);

/// All bytes of a file; throws InputError as `open_input` does, and if reading fails half-way.
std::string read_text(const std::filesystem::path& path);

}  // namespace sigmax::apps
