#pragma once

#include <string>
#include <string_view>

namespace sigmax::apps {

/// A picture as a script of gnuplot, which sets no terminal and names no file, with the room that it takes.
struct Picture {
  std::string name;  ///< of its file, without an ending
  std::string script;
  double width_cm = 16.0;
  double height_cm = 9.0;
};

/// gnuplot as it is installed where the program runs. It is given scripts alone: no settings of the user's, no other
/// files.
///
///     const Gnuplot gnuplot;
///     file.write(gnuplot.svg(picture));
class Gnuplot {
 public:
  /// Throws UsageError unless gnuplot is there.
  Gnuplot();

  /// The documents. The same script gives the same bytes. They throw std::runtime_error with gnuplot's complaint.
  std::string svg(const Picture& picture) const;
  std::string pdf(const Picture& picture) const;
};

/// A text as a script names it, so that each letter is shown as it is. Control characters become blanks, bytes that are
/// no text U+FFFD.
std::string in_gnuplot(std::string_view text);

}  // namespace sigmax::apps
