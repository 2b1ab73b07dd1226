#include "recording/quantities.hpp"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "support/error.hpp"
#include "support/text.hpp"

namespace sigmax::apps {
namespace {

/// The names that `--columns` knows: all, or without those that differ from others in the unit only.
std::vector<std::string> known_names(bool all) {
  std::vector<std::string> names = {"time_s", "sensor", "roll_deg"};
  for (const Quantity& quantity : quantities)
    for_each_header(quantity, [&](std::string header, const Unit& unit) {
      if (all || &unit == quantity.units.data()) names.push_back(std::move(header));
    });
  return names;
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

const Quantity* without_known_unit(std::string_view header) {
  const Quantity* found = nullptr;
  std::size_t longest = 0;
  bool known = false;
  for (const Quantity& quantity : quantities) {
    for_each_header(quantity, [&](const std::string& name, const Unit&) { known |= name == header; });
    for (const std::string_view stem : quantity.stems) {
      const bool named = header == stem || header.starts_with(std::string(stem) + "_");
      if (stem.size() <= longest || !named) continue;
      found = &quantity;
      longest = stem.size();
    }
  }
  return known ? nullptr : found;
}

std::string advice(const Quantity& quantity) {
  std::vector<std::string> suffixes;
  for (const Unit& unit : quantity.units) suffixes.push_back(fmt::format("_{}", unit.suffix));
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
      throw UsageError(fmt::format("--columns: {} is not NAME=HEADER", in_quotes(column)));
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw UsageError(message(
          {.what = fmt::format("--columns: there is no name {}", in_quotes(name)), .remedy = remedy_for(name)}));
    if (!mapping.emplace(name, column.substr(equals + 1)).second)
      throw UsageError(fmt::format("--columns: '{}' is given twice", name));
  }
  return mapping;
}

}  // namespace sigmax::apps
