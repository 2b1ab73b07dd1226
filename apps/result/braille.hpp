#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace sigmax::apps {

struct LineChart;
struct OutputOptions;

/// A chart as lines of braille dots, with its greatest and least value at the left, the ends of x below, and the names
/// of the curves; in colours if wanted. Empty if there is nothing to draw.
///
///     RMSE in x, m
///      25 ⠉⠑⠒⠤⣀
///       5       ⠉⠉⠒
///         1      200 sample
std::string braille(const LineChart& chart, std::size_t width, std::size_t height, bool colour);

/// Whether a chart may end the output: the standard output is a terminal of at least 80 columns that is not dumb, and
/// --no-chart was not given.
bool charts_on_terminal(const OutputOptions& options);

/// Prints some charts if they may be, in colours unless NO_COLOR is set.
void print_charts(const OutputOptions& options, const std::vector<LineChart>& charts);

}  // namespace sigmax::apps
