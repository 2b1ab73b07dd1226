#include <sigmax/hybrid/fit_target.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

namespace sigmax {

std::vector<double> log_scores(const TargetChoice& choice, std::span<const AnyPlot> plots) {
  std::vector<double> scores(plots.size(), std::numeric_limits<double>::quiet_NaN());
  for (const AnyPlot& plot : plots)
    if (plot.tag >= plots.size())
      throw std::invalid_argument("the tag " + std::to_string(plot.tag) + " among " + std::to_string(plots.size()) +
                                  " plots; expected their numbers from 0 on");
  AnyTarget(choice).follow(plots, [&](const TargetPoint& now) {
    if (!now.is_start && now.log_score) scores[now.tag] = *now.log_score;
  });
  return scores;
}

double robust_log_score(double log_score, double share, double log_stray) {
  const double own = std::log1p(-share) + log_score, stray = std::log(share) + log_stray;
  const double greater = std::max(own, stray);
  return greater + std::log1p(std::exp(std::min(own, stray) - greater));
}

void TransitionCounts::add(const ModePairs& pairs, bool counts) {
  const std::size_t modes = seconds_.size();
  if (pairs.log_weights.size() != modes * modes)
    throw std::invalid_argument("pairs of " + std::to_string(pairs.log_weights.size()) + " weights; expected " +
                                std::to_string(modes * modes));
  const auto weight = [&](std::size_t i, std::size_t j) { return pairs.log_weights[i * modes + j]; };
  if (!fuzzy_) {
    for (std::size_t i = 0; counts && i < modes; ++i)
      for (std::size_t j = 0; j < modes; ++j) {
        counts_(i, j) += std::exp(weight(i, j));
        seconds_[i] += pairs.dt * std::exp(weight(i, j));
      }
    return;
  }
  if (pairs.is_last) {
    const auto best = std::max_element(pairs.log_weights.begin(), pairs.log_weights.end());
    next_ = static_cast<std::size_t>(best - pairs.log_weights.begin()) % modes;
  }
  std::size_t before = next_;  // of equally possible ones the mode that stays
  for (std::size_t i = 0; i < modes; ++i)
    if (weight(i, next_) > weight(before, next_)) before = i;
  if (counts) {
    counts_(before, next_) += 1.0;
    seconds_[before] += pairs.dt;
  }
  next_ = before;
}

void TransitionCounts::add(const TransitionCounts& other) {
  for (std::size_t i = 0; i < seconds_.size(); ++i) {
    for (std::size_t j = 0; j < seconds_.size(); ++j) counts_(i, j) += other.counts_(i, j);
    seconds_[i] += other.seconds_[i];
  }
}

std::vector<std::vector<double>> TransitionCounts::transition(const std::vector<std::vector<double>>& otherwise) const {
  std::vector<std::vector<double>> rows = otherwise;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto counted = counts_.row(i);
    if (!(std::accumulate(counted.begin(), counted.end(), 0.0) > 0.0)) continue;
    for (std::size_t j = 0; j < rows.size(); ++j) rows[i][j] = counted[j] + (fuzzy_ ? 0.5 : 0.0);
    const double total = fuzzy_ ? *std::max_element(rows[i].begin(), rows[i].end())
                                : std::accumulate(rows[i].begin(), rows[i].end(), 0.0);
    for (double& value : rows[i]) value /= total;
  }
  return rows;
}

std::vector<double> TransitionCounts::sojourns(const std::vector<double>& otherwise) const {
  std::vector<double> result = otherwise;
  for (std::size_t i = 0; i < result.size(); ++i) {
    double departures = fuzzy_ ? 0.5 : 0.0;
    for (std::size_t j = 0; j < result.size(); ++j) departures += i == j ? 0.0 : counts_(i, j);
    if (departures > 0.0 && seconds_[i] > 0.0) result[i] = seconds_[i] / departures;
  }
  return result;
}

void count_transitions(const TargetChoice& choice, std::span<const AnyPlot> plots,
                       const std::function<bool(std::size_t tag)>& counts, TransitionCounts& result) {
  TargetChoice recorded = choice;
  recorded.rules.record = true;
  AnyTarget target(recorded);
  for (const AnyPlot& plot : plots) target.take(plot);
  target.smoothed({}, [&](const ModePairs& pairs) { result.add(pairs, counts(pairs.tag)); });
}

}  // namespace sigmax
