// <sigmax/sigmax.hpp> leads to every public header.

#include "support/test.hpp"

namespace umbrella_test {

namespace fs = std::filesystem;

TEST(Umbrella, LeadsToEveryPublicHeader) {
  const fs::path source = SIGMAX_SOURCE;
  std::map<std::string, fs::path> headers;
  for (const char* const room : {"", "core", "recognition", "estimation", "hybrid"}) {
    const fs::path root = source / room / "include";
    for (const auto& entry : fs::recursive_directory_iterator(root))
      if (entry.path().extension() == ".hpp") headers[entry.path().lexically_relative(root)] = entry.path();
  }
  std::set<std::string> reached;
  std::vector<std::string> next = {"sigmax/sigmax.hpp"};
  while (!next.empty()) {
    const std::string header = next.back();
    next.pop_back();
    if (headers.count(header) == 0 || !reached.insert(header).second) continue;
    std::ifstream text(headers[header]);
    const std::string begin = "#include <";
    for (std::string line; std::getline(text, line);)
      if (line.starts_with(begin)) next.push_back(line.substr(begin.size(), line.find('>') - begin.size()));
  }
  EXPECT_GT(reached.size(), 100U);
  for (const auto& [name, path] : headers) EXPECT_TRUE(reached.count(name)) << name;
}

}  // namespace umbrella_test
