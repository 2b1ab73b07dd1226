#include "himm_demo/motion.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "support/output.hpp"

namespace sigmax::apps {

std::string toml_list(const std::vector<double>& numbers) {
  std::vector<std::string> texts;
  for (const double number : numbers) {
    std::string text = shortest(number);
    if (text.find_first_of(".eni") == std::string::npos) text += ".0";  // TOML tells integers from floats
    texts.push_back(std::move(text));
  }
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

std::vector<std::string> names_of(const std::vector<Motion>& motions) {
  std::vector<std::string> names;
  for (auto motion = motions.begin(); motion != motions.end(); ++motion) {
    const auto before =
        std::count_if(motions.begin(), motion, [&](const Motion& earlier) { return earlier.name == motion->name; });
    names.push_back(before == 0 ? motion->name : fmt::format("{}_{}", motion->name, before + 1));
  }
  return names;
}

}  // namespace sigmax::apps
