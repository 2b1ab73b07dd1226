#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace sigmax::apps {

/// A plot of lines and points as SVG: axes with round ticks and labels, and a legend. Deterministic text, that of the
/// numbers alone.
///
///     Plot plot{"Position error", "scan", "RMSE, m"};
///     plot.line("sum", scans, errors);
///     plot.save("docs/figures/error.svg");
class Plot {
 public:
  Plot(std::string title, std::string x_label, std::string y_label)
      : title_(std::move(title)), x_label_(std::move(x_label)), y_label_(std::move(y_label)) {}

  /// Adds a curve, or points; its colour is that of its number among all. Throws std::invalid_argument unless x and y
  /// are of one length, not empty and finite.
  void line(std::string name, std::vector<double> x, std::vector<double> y) {
    add({std::move(name), std::move(x), std::move(y), true});
  }
  void points(std::string name, std::vector<double> x, std::vector<double> y) {
    add({std::move(name), std::move(x), std::move(y), false});
  }

  /// The document. Throws std::logic_error if nothing was added.
  std::string svg() const;

  /// Writes it to a file, whole or not at all. Throws InputError with path and reason.
  void save(const std::filesystem::path& path) const;

 private:
  struct Series {
    std::string name;
    std::vector<double> x, y;
    bool joined;
  };
  void add(Series series);

  std::string title_, x_label_, y_label_;
  std::vector<Series> series_;
};

}  // namespace sigmax::apps
