#pragma once

#include <sigmax/recognition/table_classifier.hpp>

#include "report/result.hpp"

namespace sigmax::apps {

/// For every feature the index of what was read, or `missing`.
using Readings = std::vector<std::size_t>;

/// A column of differences between shares of right decisions, in points.
inline ResultColumn of_points(std::string key, std::string header) {
  return {.key = std::move(key),
          .header = std::move(header),
          .unit = "points",
          .scale = 100.0,
          .sign = true,
          .interval = true};
}

/// A result begun: the page has its title, and the contestants are what it switches on and off.
Result result_of_contest(std::string title, const OutputOptions& output,
                         const std::vector<std::string>& contestants = {});

template <class Variable>
std::vector<std::string> labels_of(const Variable& variable) {
  return each_below(variable.size(), [&](std::size_t i) { return variable.label(i); });
}

/// What was learned of features: p(value|class), and the possibility that it is turned into. Of many values none are
/// shown; the most telling features come first, and no more than six.
std::vector<Panel> relation_maps(const TableModel& model);

}  // namespace sigmax::apps
