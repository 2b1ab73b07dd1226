#include "result/braille.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>

#include "result/result.hpp"

namespace sigmax::apps {
namespace {

/// Dots of 2 × 4 a character, each character in the colour of the curve that came last.
class Canvas {
 public:
  Canvas(std::size_t width, std::size_t height)
      : width_(width), height_(height), dots_(width * height, 0), curves_(width * height, 0) {}

  long across() const { return 2 * static_cast<long>(width_); }
  long down() const { return 4 * static_cast<long>(height_); }

  void dot(long x, long y, std::size_t curve) {
    static constexpr std::array<std::array<std::uint8_t, 2>, 4> bits = {
        {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}}};
    if (x < 0 || y < 0 || x >= across() || y >= down()) return;
    const auto cell = static_cast<std::size_t>(y / 4) * width_ + static_cast<std::size_t>(x / 2);
    dots_[cell] |= bits[static_cast<std::size_t>(y % 4)][static_cast<std::size_t>(x % 2)];
    curves_[cell] = curve;
  }

  /// A straight line of dots.
  void line(long x0, long y0, long x1, long y1, std::size_t curve) {
    const long steps = std::max({std::abs(x1 - x0), std::abs(y1 - y0), 1L});
    for (long i = 0; i <= steps; ++i)
      dot(x0 + std::lround(static_cast<double>((x1 - x0) * i) / static_cast<double>(steps)),
          y0 + std::lround(static_cast<double>((y1 - y0) * i) / static_cast<double>(steps)), curve);
  }

  /// A line of characters; `in_colour(text, curve)` paints one.
  template <class InColour>
  std::string row(std::size_t y, const InColour& in_colour) const {
    std::string text;
    for (std::size_t cell = y * width_; cell < (y + 1) * width_; ++cell)
      if (const std::uint8_t dots = dots_[cell]; dots == 0)
        text += ' ';  // a blank braille character would be read aloud
      else            // U+2800 + dots
        text += in_colour(
            std::string{'\xE2', static_cast<char>(0xA0 | (dots >> 6)), static_cast<char>(0x80 | (dots & 0x3F))},
            curves_[cell]);
    return text;
  }

 private:
  std::size_t width_, height_;
  std::vector<std::uint8_t> dots_;
  std::vector<std::size_t> curves_;
};

struct Extent {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;

  void add(double value) {
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
  double part(double value) const { return greatest > least ? (value - least) / (greatest - least) : 0.5; }
};

}  // namespace

std::string braille(const LineChart& chart, std::size_t width, std::size_t height, bool colour) {
  Extent across, up;
  for (const Curve& curve : chart.curves)
    for (std::size_t k = 0; k < curve.values.size(); ++k)
      if (std::isfinite(curve.values[k])) {
        across.add(chart.x[k]);
        up.add(curve.values[k]);
      }
  if (up.least > up.greatest) return "";
  up.add(0.0);
  if (chart.greatest_y) up.greatest = *chart.greatest_y;
  const int digits = up.greatest < 10.0 ? 2 : 1;
  const std::string top = sized_text(up.greatest, digits), bottom = sized_text(up.least, digits);
  const std::size_t margin = std::max(top.size(), bottom.size());
  if (width < margin + 20) return "";

  Canvas canvas(width - margin - 1, height);
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    std::pair<long, long> before;
    bool follows = false;  // on a point before
    for (std::size_t k = 0; k < chart.x.size(); ++k) {
      const double value = chart.curves[i].values[k];
      if (!std::isfinite(value)) {
        follows = follows && chart.joined;
        continue;
      }
      const std::pair here{std::lround(across.part(chart.x[k]) * static_cast<double>(canvas.across() - 1)),
                           std::lround((1.0 - up.part(value)) * static_cast<double>(canvas.down() - 1))};
      if (chart.curves[i].dots || !follows) before = here;
      canvas.line(before.first, before.second, here.first, here.second, i);
      before = here;
      follows = true;
    }
  }

  // Colours that the colour-blind tell apart.
  const auto in_colour = [&](const std::string& text, std::size_t curve) {
    constexpr std::array codes = {"\x1B[36m", "\x1B[33m", "\x1B[35m", "\x1B[32m", "\x1B[34m", "\x1B[31m"};
    return colour ? codes[curve % codes.size()] + text + "\x1B[0m" : text;
  };
  std::string text = wrapped(printable(chart.title + ": " + chart.y_label), width);
  for (std::size_t y = 0; y < height; ++y)
    text += fmt::format("{:>{}} {}\n", y == 0 ? top : y + 1 == height ? bottom : "", margin, canvas.row(y, in_colour));
  const std::string first = number_text(across.least, 0), last = number_text(across.greatest, 0) + " " + chart.x_label;
  const std::string indent(margin + 1, ' ');
  const std::size_t left = width - margin - 1 - first.size();
  text += indent + first + std::string(left - std::min(left, last.size()), ' ') + last + "\n";
  std::size_t used = width;  // by the names of the curves, in as many lines as they take
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    const std::string name = printable(chart.curves[i].name);
    const bool fits = used + 2 + display_width(name) <= width;
    text += fits ? "  " : (i > 0 ? "\n" : "") + indent;
    used = (fits ? used + 2 : indent.size()) + display_width(name);
    text += in_colour(name, i);
  }
  return text + "\n";
}

bool charts_on_terminal(const OutputOptions& options) {
  winsize size{};
  const char* const kind = std::getenv("TERM");
  return !options.no_chart && ::isatty(STDOUT_FILENO) != 0 && kind && std::string_view(kind) != "dumb" &&
         ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col >= terminal_width;
}

void print_charts(const OutputOptions& options, const std::vector<LineChart>& charts) {
  if (!charts_on_terminal(options)) return;
  constexpr std::size_t height = 7;
  const char* const plain = std::getenv("NO_COLOR");
  for (const LineChart& chart : charts) {
    const std::string text = braille(chart, terminal_width - 1, height, !plain || *plain == '\0');
    if (!text.empty()) fmt::print("\n{}", text);
  }
}

}  // namespace sigmax::apps
