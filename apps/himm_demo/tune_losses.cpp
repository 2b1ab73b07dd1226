#include "himm_demo/tune_losses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <Eigen/Cholesky>

#include "himm_demo/tracker.hpp"

namespace sigmax::apps {
namespace {

double measurement_loss(double log_score, const FilterSettings& settings, double volume) {
  if (settings.gate_probability >= 1.0) return -log_score;
  const double target = std::log(settings.gate_probability) + log_score;
  const double stray = std::log1p(-settings.gate_probability) - std::log(volume);
  const double greater = std::max(target, stray);
  return -(greater + std::log1p(std::exp(std::min(target, stray) - greater)));
}

/// In which a stray measurement of a row's kind lies anywhere.
double volume_for(const Fix& fix, const TuneData& data) {
  if (fix.seen) return data.radar_volume;
  return fix.bearing ? 2.0 * std::numbers::pi : data.volume;
}

/// Of the true position, by the estimate's leading components.
double truth_loss(const TargetPoint& now, const Vector<3>& truth, int axes, Objective objective) {
  const auto n = static_cast<Eigen::Index>(now.mean.size());
  const Eigen::Map<const Eigen::VectorXd> mean(now.mean.data(), n);
  const Eigen::VectorXd error = mean.head(axes) - truth.head(axes);
  if (objective == Objective::rmse) return error.squaredNorm();
  const Eigen::Map<const Eigen::MatrixXd> covariance(now.covariance.data(), n, n);
  const Eigen::LLT<Eigen::MatrixXd> root(covariance.topLeftCorner(axes, axes));
  if (root.info() != Eigen::Success) throw std::domain_error("the covariance of an estimate is not positive definite");
  return 0.5 * root.matrixL().solve(error).squaredNorm() + root.matrixLLT().diagonal().array().log().sum() +
         0.5 * axes * std::log(2.0 * std::numbers::pi);
}

}  // namespace

FilterSettings judged_settings(FilterSettings settings, Objective objective) {
  if (objective == Objective::prequential) settings.radar_measurement = RadarForm::polar;
  return settings;
}

TargetChoice judged_choice(const TuneData& data, const FilterSettings& settings) {
  TargetChoice choice = choice_of(settings, data.axes);
  choice.rules.rejections = 0;
  choice.rules.record = false;
  return choice;
}

Losses losses(const TuneData& data, const FilterSettings& settings, Objective objective, const Look& look) {
  const TargetChoice choice = judged_choice(data, settings);
  const bool starts_anywhere = settings.start == StartRule::given && !data.geodetic;  // as `track` does
  Losses result;
  TargetPoint now;
  for (std::size_t t = 0; t < data.tracks.size(); ++t) {
    const TuneTrack& track = data.tracks[t];
    auto& lost = result.emplace_back(track.rows.size(), std::numeric_limits<double>::quiet_NaN());
    AnyTarget target(choice);
    const auto stepped = [&](std::size_t row, bool is_start) {
      if (is_start) return;
      target.output(now);
      const Fix& fix = track.rows[row];
      if (objective == Objective::prequential && now.log_score)
        lost[row] = measurement_loss(*now.log_score, settings, volume_for(fix, data));
      if (objective != Objective::prequential && fix.truth)
        lost[row] = truth_loss(now, *fix.truth, data.axes, objective);
      if (look) look(t, row, now);
    };
    for (const AnyPlot& plot : data.plots(track, settings)) {
      const Fix& fix = track.rows[plot.tag];
      if (target.running() || fix.whole() || starts_anywhere) target.take(plot, stepped);
    }
  }
  return result;
}

double objective_of(const Losses& losses, Objective objective, const Counts& counts) {
  double sum = 0.0;
  std::size_t rows = 0;
  for (std::size_t t = 0; t < losses.size(); ++t)
    for (std::size_t k = 0; k < losses[t].size(); ++k)
      if (!std::isnan(losses[t][k]) && counts(t, k)) {
        sum += losses[t][k];
        ++rows;
      }
  const double mean = sum / static_cast<double>(rows);
  return objective == Objective::rmse ? 0.5 * std::log(mean) : mean;
}

double figure_of(double value, Objective objective) { return objective == Objective::rmse ? std::exp(value) : value; }

}  // namespace sigmax::apps
