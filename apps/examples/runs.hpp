#pragma once

#include <array>
#include <cmath>
#include <iomanip>
#include <iostream>

#include "report/report.hpp"
#include "shell/files.hpp"

namespace examples {

/// Writes a page with a chart.
inline void save(const sigmax::apps::LineChart& chart, const std::string& file) {
  sigmax::apps::write_file(file, sigmax::apps::html({.title = chart.title, .panels = {chart}}));
}

/// The root mean square errors of four estimates over many runs: what sums and what maxima make of the same
/// measurements. A track is one number for each step, or as many as the study is told: x, y, x, y, …
class Study {
 public:
  using Track = std::vector<double>;

  explicit Study(std::size_t numbers_per_step) : numbers_per_step_(numbers_per_step) {}

  /// What a filter said: the mean, and the most probable or most possible state.
  struct Estimates {
    Track mean, most_likely;
  };

  /// Adds a run.
  void add(const Track& truth, const Estimates& random, const Estimates& fuzzy) {
    const std::array<Track, 4> estimates{random.mean, random.most_likely, fuzzy.mean, fuzzy.most_likely};
    std::vector<double> mean_squares;
    for (std::size_t i = 0; i < estimates.size(); ++i) {
      const std::size_t steps = truth.size() / numbers_per_step_;
      by_step_[i].resize(steps);
      double sum = 0.0;
      for (std::size_t k = 0; k < steps; ++k) {
        double square = 0.0;
        for (std::size_t d = k * numbers_per_step_; d < (k + 1) * numbers_per_step_; ++d)
          square += (estimates[i][d] - truth[d]) * (estimates[i][d] - truth[d]);
        by_step_[i][k].add(square);
        sum += square;
      }
      mean_squares.push_back(sum / static_cast<double>(steps));
      in_all_[i].add(mean_squares.back());
    }
    loss_.add(mean_squares[2] - mean_squares[0]);
  }

  void print() const {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const double root = std::sqrt(in_all_[i].mean());
      print(names[i], root, in_all_[i].interval().half_width / (2.0 * root));
    }
    print("mean square of mean, fuzzy less random", loss_.mean(), loss_.interval().half_width);
  }

  /// The means of both kinds: RMSE over the runs, step by step.
  sigmax::apps::LineChart chart(std::string title, std::string x_label, std::string y_label) const {
    sigmax::apps::LineChart chart{
        .title = std::move(title), .x_label = std::move(x_label), .y_label = std::move(y_label)};
    for (const std::size_t i : {std::size_t{0}, std::size_t{2}}) {
      chart.curves.push_back({.name = std::string(names[i])});
      for (const sigmax::RunningMean& squares : by_step_[i])
        chart.curves.back().values.push_back(std::sqrt(squares.mean()));
    }
    for (std::size_t k = 1; k <= by_step_[0].size(); ++k) chart.x.push_back(static_cast<double>(k));
    return chart;
  }

 private:
  static constexpr std::array<std::string_view, 4> names{"random: mean", "random: most probable", "fuzzy: mean of (35)",
                                                         "fuzzy: most possible"};
  static void print(std::string_view title, double value, double half_width) {
    std::cout << "  " << std::left << std::setw(40) << title << std::fixed << std::setprecision(2) << value << " ± "
              << half_width << '\n';
  }

  std::size_t numbers_per_step_;
  std::array<sigmax::RunningMean, 4> in_all_;
  std::array<std::vector<sigmax::RunningMean>, 4> by_step_;
  sigmax::RunningMean loss_;
};

}  // namespace examples
