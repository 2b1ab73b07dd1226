#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sigmax::apps {

struct LineChart;
struct Report;

/// A picture as a script of gnuplot, which sets no terminal and names no file, with the room that it takes.
struct Picture {
  std::string name;  ///< of its file, without an ending
  std::string script;
  double width_cm = 16.0, height_cm = 9.0;
};

/// The charts, maps and matrices that a report opens with, for a paper: its panels, those of its first view, and its
/// last ones, with the groups that are shown then. They have the colours and dashes of the report on light paper. What
/// has no number to show is left out.
std::vector<Picture> pictures_of(const Report& report);

/// Throws UsageError unless gnuplot is installed where the program runs.
void need_gnuplot();

/// The documents, by gnuplot, which is given scripts alone: no settings of the user's, no other files. The same script
/// gives the same bytes. They throw std::runtime_error with gnuplot's complaint.
std::string svg_of(const Picture& picture);
std::string pdf_of(const Picture& picture);

/// A text as a script names it, so that each letter is shown as it is. Control characters become blanks, bytes that are
/// no text U+FFFD.
std::string in_gnuplot(std::string_view text);

/// Draws a chart as SVG into a file, which appears whole or not at all.
void save_svg(const LineChart& chart, const std::filesystem::path& path);

}  // namespace sigmax::apps
