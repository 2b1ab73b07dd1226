#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "support/gnuplot.hpp"
#include "support/report.hpp"

namespace sigmax::apps {

/// The charts, maps and matrices that a report opens with, for a paper: its panels, those of its first view, and its
/// last ones, with the groups that are shown then. They have the colours and dashes of the report on light paper. What
/// has no number to show is left out.
std::vector<Picture> pictures_of(const Report& report);

/// Draws a chart as SVG into a file, which appears whole or not at all.
void save_svg(const LineChart& chart, const std::filesystem::path& path);

}  // namespace sigmax::apps
