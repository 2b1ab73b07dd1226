#include "shell/input.hpp"

#include <array>
#include <cerrno>
#include <system_error>

#include "shell/error.hpp"

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

}  // namespace sigmax::apps
