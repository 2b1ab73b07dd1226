#include "examples/plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "support/output.hpp"

namespace sigmax::apps {
namespace {

constexpr double width = 720.0, height = 400.0, left = 70.0, top = 40.0, bottom = 55.0;
constexpr double legend_line = 18.0;

/// Colours that colour-blind readers tell apart (Okabe, Ito 2008).
constexpr std::array<std::string_view, 6> colours{"#000000", "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00"};

/// A number without an exponent and trailing zeros.
std::string plain(double value, int digits) {
  std::string text = fmt::format("{:.{}f}", value, digits);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      default:
        result += c;
    }
  return result;
}

/// The values along one axis and the pixels that they are drawn at.
struct Axis {
  double low, high;   // values
  double from, to;    // pixels
  double tick = 1.0;  // between two ticks: 1, 2 or 5 times a power of ten
  int digits = 0;     // of their labels

  double operator()(double value) const { return from + (to - from) * (value - low) / (high - low); }

  /// Widened to whole ticks.
  void round_to_ticks() {
    const double rough = (high - low) / 6.0;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    tick = power * (rough <= power ? 1.0 : rough <= 2.0 * power ? 2.0 : rough <= 5.0 * power ? 5.0 : 10.0);
    digits = std::max(0, -static_cast<int>(std::floor(std::log10(tick) + 1e-9)));
    low = tick * std::floor(low / tick + 1e-9);
    high = tick * std::ceil(high / tick - 1e-9);
  }
};

}  // namespace

void Plot::add(Series series) {
  const auto finite = [](double value) { return std::isfinite(value); };
  if (series.x.empty() || series.x.size() != series.y.size() ||
      !std::all_of(series.x.begin(), series.x.end(), finite) || !std::all_of(series.y.begin(), series.y.end(), finite))
    throw std::invalid_argument("the series '" + series.name + "' of a plot needs as many x as y, all finite");
  series_.push_back(std::move(series));
}

std::string Plot::svg() const {
  if (series_.empty()) throw std::logic_error("the plot '" + title_ + "' has nothing to show");
  std::size_t longest = 0;
  for (const Series& series : series_) longest = std::max(longest, series.name.size());
  const double right = 60.0 + 7.5 * static_cast<double>(longest);  // the legend stands there
  Axis x{series_[0].x[0], series_[0].x[0], left, width - right};
  Axis y{series_[0].y[0], series_[0].y[0], height - bottom, top};
  for (const Series& series : series_) {
    const auto [x_low, x_high] = std::minmax_element(series.x.begin(), series.x.end());
    const auto [y_low, y_high] = std::minmax_element(series.y.begin(), series.y.end());
    x.low = std::min(x.low, *x_low);
    x.high = std::max(x.high, *x_high);
    y.low = std::min(y.low, *y_low);
    y.high = std::max(y.high, *y_high);
  }
  for (Axis* axis : {&x, &y})
    if (axis->high == axis->low) axis->high = axis->low + 1.0;
  x.round_to_ticks();
  y.round_to_ticks();

  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
      "font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n"
      "<text x=\"{2}\" y=\"24\" font-size=\"15\" text-anchor=\"middle\">{3}</text>\n",
      width, height, 0.5 * (left + width - right), escaped(title_));
  const auto line = [&](double x1, double y1, double x2, double y2, std::string_view colour, double stroke = 1.0) {
    svg += fmt::format(
        "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" stroke-width=\"{}\"/>\n", x1, y1,
        x2, y2, colour, stroke);
  };
  const auto text = [&](double at_x, double at_y, std::string_view anchor, std::string_view what) {
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", at_x, at_y, anchor, what);
  };
  const auto ticks = [](const Axis& axis, const auto& at) {
    for (double k = std::ceil(axis.low / axis.tick - 1e-9); k * axis.tick <= axis.high + 1e-9 * axis.tick; ++k)
      at(k * axis.tick, plain(k * axis.tick, axis.digits));
  };
  ticks(x, [&](double value, const std::string& label) {
    line(x(value), y.from, x(value), y.to, "#dddddd");
    text(x(value), y.from + 18.0, "middle", label);
  });
  ticks(y, [&](double value, const std::string& label) {
    line(x.from, y(value), x.to, y(value), "#dddddd");
    text(x.from - 8.0, y(value) + 4.5, "end", label);
  });
  line(x.from, y.from, x.to, y.from, "black");
  line(x.from, y.from, x.from, y.to, "black");
  text(0.5 * (x.from + x.to), height - 14.0, "middle", escaped(x_label_));
  svg += fmt::format("<text transform=\"translate(20 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                     0.5 * (y.from + y.to), escaped(y_label_));

  for (std::size_t i = 0; i < series_.size(); ++i) {
    const Series& series = series_[i];
    const std::string_view colour = colours[i % colours.size()];
    if (series.joined)
      svg += fmt::format("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\" points=\"", colour);
    for (std::size_t k = 0; k < series.x.size(); ++k)
      svg += series.joined ? fmt::format("{}{:.1f},{:.1f}", k == 0 ? "" : " ", x(series.x[k]), y(series.y[k]))
                           : fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"/>\n", x(series.x[k]),
                                         y(series.y[k]), colour);
    if (series.joined) svg += "\"/>\n";
  }

  const double legend = width - right + 15.0;
  for (std::size_t i = 0; i < series_.size(); ++i) {
    const double at = top + 4.0 + legend_line * (static_cast<double>(i) + 0.75);
    const std::string_view colour = colours[i % colours.size()];
    if (series_[i].joined)
      line(legend, at, legend + 22.0, at, colour, 2.0);
    else
      svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\" fill=\"{}\"/>\n", legend + 11.0, at, colour);
    text(legend + 30.0, at + 4.5, "start", escaped(series_[i].name));
  }
  return svg + "</svg>\n";
}

void Plot::save(const std::filesystem::path& path) const {
  AtomicFile file(path);
  file.write(svg());
  file.commit();
}

}  // namespace sigmax::apps
