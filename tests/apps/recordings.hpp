#pragma once

#include "apps/rows.hpp"
#include "support/matrices.hpp"
#include "support/program.hpp"

namespace sigmax::apps {

/// A number as it reads back.
inline std::string exact(double value) {
  std::ostringstream text;
  text.precision(17);
  text << value;
  return text.str();
}

/// The number that a cell holds; unlike std::stod this takes one that is no normal number, too.
inline double number(const std::string& cell) { return std::strtod(cell.c_str(), nullptr); }

/// A row for each k by `row(k)`.
template <class Row>
std::string recording(const std::string& header, const Row& row, int count = 30) {
  std::string text = header + "\n";
  for (int k = 0; k < count; ++k) text += row(k) + "\n";
  return text;
}

/// What `track` printed, on one line, and what it wrote into estimates.csv and summary.json.
struct Tracked {
  std::string output, estimates, summary;
};

/// Runs `track` on a recording; it must succeed.
inline Tracked tracked(const std::string& text, const Arguments& settings = {}, const Arguments& options = {}) {
  const TemporaryDirectory directory;
  const auto out = directory.path() / "out";
  const auto ending = program::succeeds(
      SIGMAX_HIMM_DEMO,
      Arguments{"track", directory.write("real.csv", text), "--quiet", "--out", out} + setting(settings) + options);
  return {ending.on_one_line(), contents(out / "estimates.csv"), contents(out / "summary.json")};
}

/// The rows of what it wrote.
inline std::vector<TextRow> estimates(const std::string& text, const Arguments& settings = {},
                                      const Arguments& options = {}) {
  return rows(tracked(text, settings, options).estimates);
}

/// Fails unless a row of estimates.csv has this mean and these sigmas along so many axes, in the order x, …, vx, …, ax,
/// of which the acceleration has no sigma; along the other axes its cells are empty.
inline void expect_row(const TextRow& row, const restatement::State& state, std::size_t axes, double tolerance = 1e-9) {
  static const std::vector<std::string> names = {"x_m",    "y_m",     "z_m",     "vx_mps", "vy_mps",
                                                 "vz_mps", "ax_mps2", "ay_mps2", "az_mps2"};
  for (std::size_t i = 0; i < state.mean.size(); ++i) {
    const std::string& name = names[i / axes * 3 + i % axes];
    ASSERT_CLOSE(std::stod(row.at(name)), state.mean[i], tolerance) << name;
    if (i < 2 * axes) {
      ASSERT_CLOSE(std::stod(row.at("sigma_" + name)), std::sqrt(state.covariance(i, i)), tolerance);
    }
  }
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (k % 3 >= axes) {
      ASSERT_EQ(row.at(names[k]), "");
    }
  }
}

/// A measurement of a recording, or a row without one.
struct Detection {
  double time;
  std::optional<restatement::Position> z;
};

/// Fails unless these rows of estimates.csv are what a restated filter of DWNA and DWPA says of the detections after
/// `time`.
template <class Filter>
void expect_restated(const std::vector<TextRow>& found, Filter filter, double time,
                     const std::vector<Detection>& detections, double tolerance = 1e-9) {
  ASSERT_EQ(found.size(), detections.size());
  const auto seen = std::find_if(detections.begin(), detections.end(),
                                 [](const Detection& detection) { return detection.z.has_value(); });
  const std::size_t axes = seen->z->z.size();
  for (std::size_t k = 0; k < detections.size(); ++k) {
    const auto& [now, z] = detections[k];
    const TextRow& row = found[k];
    SCOPED_TRACE("row " + std::to_string(k) + " of " + row.at("filter"));
    if (z)
      filter.step(now - time, z->z, z->R);
    else
      filter.step(now - time);
    time = now;
    ASSERT_EQ(std::stod(row.at("time_s")), now);
    expect_row(row, filter.estimate(), axes, tolerance);
    ASSERT_EQ(row.at("nis").empty(), !z);
    if (z) {
      ASSERT_CLOSE(std::stod(row.at("nis")), std::optional<double>(filter.nis()).value(), tolerance);
    }
    ASSERT_CLOSE(number(row.at("weight_dwna")), std::exp(filter.log_weights()[0]), tolerance);
    ASSERT_CLOSE(number(row.at("weight_dwpa")), std::exp(filter.log_weights()[1]), tolerance);
    ASSERT_EQ(row.at("most_likely"), filter.winner() == 0 ? "dwna" : "dwpa");
    if (testing::Test::HasFatalFailure()) return;
  }
}

/// A recorded track outside the project, or nothing.
inline std::string recorded(const std::string& name) {
  const auto path = std::filesystem::path(SIGMAX_DATA) / "tracking" / name;
  return std::filesystem::exists(path) ? path.string() : "";
}

}  // namespace sigmax::apps
