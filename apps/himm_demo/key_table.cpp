#include <string>
#include <string_view>

#include <fmt/format.h>

#include "himm_demo/filter_keys.hpp"
#include "support/text.hpp"

namespace sigmax::apps {
namespace {

/// The text below a name.
std::string indented(std::string_view text) {
  std::string result;
  for (const auto& line : lines_of(text, terminal_width - 4)) result += "    " + line + "\n";
  return result;
}

std::string entry(std::string_view name, std::string_view meaning, std::string_view values,
                  const std::string& by_default) {
  return fmt::format("{}\n{}{}{}", name, indented(meaning), indented(fmt::format("Values: {}", values)),
                     indented("Default: " + by_default));
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
                           "table [filter.NAME] with a kind; \"all\" for those without histories",
                           R"(["imm", "himm"]; preset released: also "imm_correct")");
  text += entry("filter.NAME.kind", "The kind of the filter's mode.", "random, fuzzy", "from the name");
  for (const auto& key : filter_keys()) text += entry(key, track, paper, released);
  for (const auto& key : accuracy_keys()) text += entry(key, track.accuracy, paper.accuracy, released.accuracy);
  text += entry("sensor.NAME.KEY", "One of the last six keys, for the rows whose column sensor says NAME.", "as there",
                "that of all sensors");
  text += entry("filter.NAME.KEY", "Any key, for one filter.", "as there", "that of all filters");
  return text;
}

}  // namespace sigmax::apps
