#include "table/quantities.hpp"

namespace sigmax::apps {
namespace {

/// The names that `--columns` knows: all, or without those that differ from others in the unit only.
std::vector<std::string> known_names(bool all) {
  std::vector<std::string> names;
  for (const TimeColumn& time : time_columns) names.emplace_back(time.name);
  names.insert(names.end(), {"date", "sensor", "roll_deg"});
  for (const Quantity& quantity : quantities)
    for_each_header(quantity, [&](std::string header, const Unit& unit) {
      if (all || &unit == quantity.units.data()) names.push_back(std::move(header));
    });
  return names;
}

/// Whether a header is this stem, alone or with a unit.
bool has_stem(std::string_view header, std::string_view stem) {
  return header == stem || header.starts_with(std::string(stem) + "_");
}

/// What to do about a name that there is not.
std::string remedy_for(const std::string& name) {
  if (const Quantity* const quantity = without_known_unit(name)) return advice(*quantity);
  const std::string nearest = nearest_word(name, known_names(true));
  return nearest.empty()
             ? fmt::format("the known ones are {}, and these in other units", fmt::join(known_names(false), ", "))
             : nearest;
}

}  // namespace

std::optional<double> not_available(std::string_view header) {
  constexpr std::pair<std::string_view, double> numbers[] = {
      {"sog_kt", 102.3}, {"cog_deg", 360.0}, {"latitude_deg", 91.0}, {"longitude_deg", 181.0}};
  for (const auto& [name, number] : numbers)
    if (name == header) return number;
  return std::nullopt;
}

bool names_unit(std::string_view header, std::string_view unit) {
  constexpr std::pair<std::string_view, std::string_view> others[] = {
      {"ft", "feet"}, {"m", "meters"}, {"kmh", "km/h"}, {"mps", "m/s"}, {"kt", "knots"}, {"deg", "degrees"}};
  const auto known = std::ranges::find(others, unit, [](const auto& one) { return one.first; });
  for (const std::string_view other : {unit, known == std::end(others) ? unit : known->second})
    if (header.ends_with(fmt::format("_{}", other)) || header.ends_with(fmt::format("({})", other)) ||
        header.ends_with(fmt::format("[{}]", other)))
      return true;
  return false;
}

const Quantity* without_known_unit(std::string_view header) {
  const Quantity* found = nullptr;
  std::size_t longest = 0;
  bool known = false;
  for (const Quantity& quantity : quantities) {
    for_each_header(quantity, [&](const std::string& name, const Unit&) { known |= name == header; });
    for (const std::string_view stem : quantity.stems) {
      const bool has_unit = std::ranges::any_of(quantity.units, [&](const Unit& unit) {
        return !unit.suffix.empty() && header.ends_with("_" + std::string(unit.suffix));
      });
      if (stem.size() <= longest || !has_stem(header, stem) || has_unit) continue;
      found = &quantity;
      longest = stem.size();
    }
  }
  return known ? nullptr : found;
}

std::string names_of(const Quantity& quantity) {
  std::string names;
  for (const std::string_view stem : quantity.stems)
    if (!stem.empty())
      names += fmt::format("{}{}_{}", names.empty() ? "" : " or ", stem, quantity.units.front().suffix);
  return names;
}

std::string advice(const Quantity& quantity) {
  std::vector<std::string> suffixes;
  for (const Unit& unit : quantity.units)
    if (!unit.suffix.empty()) suffixes.push_back(fmt::format("_{}", unit.suffix));
  if (suffixes.size() == 1) return "name its unit: " + suffixes.front();
  return fmt::format("name its unit: {} or {}", fmt::join(suffixes.begin(), suffixes.end() - 1, ", "), suffixes.back());
}

std::map<std::string, std::string, std::less<>> mapping_of(const std::vector<std::string>& columns) {
  std::map<std::string, std::string, std::less<>> mapping;
  const auto known = known_names(true);
  for (const auto& column : columns) {
    const auto equals = column.find('=');
    const std::string name = column.substr(0, equals);
    if (equals == std::string::npos || equals + 1 == column.size())
      throw UsageError("--columns: {} is not NAME=HEADER", in_quotes(column));
    if (std::ranges::find(known, name) == known.end())
      throw UsageError(
          {.what = fmt::format("--columns: there is no name {}", in_quotes(name)), .remedy = remedy_for(name)});
    if (!mapping.emplace(name, column.substr(equals + 1)).second)
      throw UsageError("--columns: '{}' is given twice", name);
  }
  return mapping;
}

}  // namespace sigmax::apps
