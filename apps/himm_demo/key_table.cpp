#include <algorithm>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "himm_demo/filter_keys.hpp"
#include "support/table.hpp"

namespace sigmax::apps {
namespace {

/// The text in lines of at most 80 columns.
std::string wrapped(std::string_view text, std::string_view indent) {
  std::string result, line(indent);
  while (!text.empty()) {
    const auto end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.size() > indent.size() && display_width(line) + 1 + display_width(word) > 80) {
      result += line + "\n";
      line = indent;
    }
    line += (line.size() > indent.size() ? " " : "") + std::string(word);
  }
  return result + line + "\n";
}

std::string entry(std::string_view name, std::string_view meaning, std::string_view values,
                  const std::string& by_default) {
  constexpr std::string_view indent = "    ";
  return fmt::format("{}\n{}{}{}", name, wrapped(meaning, indent), wrapped(fmt::format("Values: {}", values), indent),
                     wrapped("Default: " + by_default, indent));
}

template <class Owner>
std::string entry(const Key<Owner>& key, const Owner& track, const Owner& paper, const Owner& released) {
  const auto value = [&](const Owner& owner) {
    const std::string text = key.write(owner);
    return text.empty() ? "none" : text;
  };
  std::string by_default = key.by_default.empty() ? value(track) : key.by_default;
  if (key.by_default.empty() && value(paper) != value(track)) by_default += "; preset paper_text: " + value(paper);
  if (key.by_default.empty() && value(released) != value(track)) by_default += "; preset released: " + value(released);
  return entry(key.name, key.meaning, key.values, by_default);
}

}  // namespace

std::string key_table() {
  const FilterSettings track = FilterDefaults{}.filter;
  const FilterSettings paper = FilterDefaults::of(Preset::paper_text).filter;
  const FilterSettings released = FilterDefaults::of(Preset::released).filter;
  std::string text = entry("filters", "The filters to run.",
                           "names with a meaning of their own, others that begin with imm or himm, others that have a "
                           "table [filter.NAME] with a kind; \"all\" for every name with a meaning",
                           R"(["imm", "himm"]; preset released: also "imm_correct")");
  text += entry("filter.NAME.kind", "The kind of the filter's mode.", "random, fuzzy", "from the name");
  for (const auto& key : filter_keys()) text += entry(key, track, paper, released);
  for (const auto& key : accuracy_keys()) text += entry(key, track.accuracy, paper.accuracy, released.accuracy);
  text += entry("sensor.NAME.KEY", "One of the last four keys, for the rows whose column sensor says NAME.", "as there",
                "that of all sensors");
  text += entry("filter.NAME.KEY", "Any key, for one filter.", "as there", "that of all filters");
  return text;
}

}  // namespace sigmax::apps
