#include <sigmax/tuning/target.hpp>

#include <cmath>

#include <sigmax/hybrid/fit_target.hpp>

namespace sigmax {
namespace {

constexpr double stray_share = 0.01;   // of all detections
constexpr double widths = 6.0;         // of nine in ten changes: how wide stray ones scatter
constexpr double a_stray_more = 20.0;  // nats

double quantile(std::vector<double>& numbers, double share) {
  if (numbers.empty()) return 0.0;
  const auto place = numbers.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(numbers.size() - 1));
  std::nth_element(numbers.begin(), place, numbers.end());
  return *place;
}

}  // namespace

MeasuredQuantity quantity_of(const AnyDetection& detection, std::size_t i) {
  using enum AnyDetection::Sensor;
  if (detection.sensor == position) return {components, static_cast<int>(i)};
  if (detection.sensor == doppler) return {polar, static_cast<int>(i)};
  return {detection.sensor, detection.sensor == components ? detection.places[i] : static_cast<int>(i)};
}

double rounding_of(std::vector<double> numbers) {
  std::ranges::sort(numbers);
  std::vector<double> apart;  // those that differ by more than the reading of decimals does
  for (std::size_t k = 1; k < numbers.size(); ++k)
    if (const double step = numbers[k] - numbers[k - 1]; step > 1e-10 * std::abs(numbers[k])) apart.push_back(step);
  if (apart.empty()) return std::numeric_limits<double>::infinity();
  const double least = *std::ranges::min_element(apart);
  const auto whole = std::ranges::count_if(
      apart, [&](double step) { return std::abs(step / least - std::round(step / least)) < 0.05; });
  // Where hardly a number comes twice, and all are one step apart, it is the path of what moves evenly.
  const auto single = std::ranges::count_if(apart, [&](double step) { return step < 1.5 * least; });
  const bool is_even = 5 * single > 4 * std::ssize(numbers) && 2 * apart.size() > numbers.size();
  if (10 * whole >= 9 * std::ssize(apart) && !is_even) return least / std::sqrt(12.0);
  for (double digits = 1.0; digits < 1e7; digits *= 10.0)  // as they are written
    if (std::ranges::all_of(numbers, [&](double number) {
          const double all = number * digits;
          return std::abs(all - std::round(all)) < 1e-9 + 1e-15 * std::abs(all);
        }))
      return 1.0 / digits / std::sqrt(12.0);
  return 0.0;
}

TrackScale::TrackScale(const Tracks& tracks) {
  std::vector<double> steps, ranges;
  std::map<MeasuredQuantity, std::vector<double>> changes;
  for (const auto& track : tracks) {
    std::map<MeasuredQuantity, double> last;
    const AnyDetection* before = nullptr;
    for (const AnyDetection& detection : track) {
      if (detection.sensor == AnyDetection::Sensor::none) continue;
      if (before && detection.time > before->time) steps.push_back(detection.time - before->time);
      before = &detection;
      for (std::size_t i = 0; i < static_cast<std::size_t>(detection.size); ++i) {
        const auto key = quantity_of(detection, i);
        if (key == MeasuredQuantity(AnyDetection::Sensor::polar, 0)) ranges.push_back(detection.z[0]);
        const auto [own, is_first] = last.try_emplace(key, detection.z[i]);
        if (const double change = std::abs(detection.z[i] - own->second); change > 0.0) changes[key].push_back(change);
        own->second = detection.z[i];
      }
    }
  }
  for (auto& [key, own] : changes) changes_[key] = quantile(own, 0.9);
  range_ = quantile(ranges, 0.5);
  if (steps.empty()) return;
  step_s = quantile(steps, 0.5);
  long_step_s = quantile(steps, 0.9);
  uneven = long_step_s >= 2.0 * quantile(steps, 0.1);
}

double TrackScale::change(const MeasuredQuantity& quantity) const {
  const auto found = changes_.find(quantity);
  return found == changes_.end() ? 0.0 : found->second;
}

double TrackScale::change_m() const {
  using enum AnyDetection::Sensor;
  double most = std::max(change({polar, 0}), range_ * change({polar, 1}));
  for (int axis = 0; axis < 3; ++axis) most = std::max(most, change({components, axis}));
  return most > 0.0 ? most : 1000.0;
}

double TrackScale::log_stray(const AnyDetection& detection) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(detection.size); ++i)
    if (const double own = change(quantity_of(detection, i)); own > 0.0)  // else no row is off
      sum -= std::log(widths * own);
  return sum;
}

std::vector<FreeNumber<TargetChoice>> motion_numbers(const TargetChoice& choice, const TrackScale& scale) {
  std::vector<FreeNumber<TargetChoice>> numbers;
  const double step = scale.long_step_s;
  for (std::size_t j = 0; j < choice.motions.size(); ++j) {
    const MotionChoice& motion = choice.motions[j];
    const KnownMotion& known = motion.known();
    const bool remembers = known.has_parameter(MotionParameter::tau);
    // σ is of what a step adds, of what wanders, or of noise in continuous time.
    const double order = motion.name.starts_with("dw") ? 2.0 : known.derivatives - (remembers ? 1.0 : 0.5);
    const double most = 3.0 * scale.change_m() / std::pow(step, order);
    const std::array<std::array<double, 2>, 4> bounds{
        {{1e-7 * most, most}, {0.3 * step, 1e3 * step}, {-30.0 / step, 30.0 / step}, {1e-3 / step, 30.0 / step}}};
    for (std::size_t p = 0; p < bounds.size(); ++p) {
      const auto which = static_cast<MotionParameter>(p);
      const bool linear = which == MotionParameter::turn_rate;
      if (!known.has_parameter(which) || !(linear || motion[which] > 0.0)) continue;
      numbers.push_back({{.name = std::string(motion_parameters()[p].key) + " of " + choice.models[j],
                          .start = motion[which],
                          .scale = linear ? Scale::linear : Scale::logarithmic,
                          .least = bounds[p][0],
                          .most = bounds[p][1],
                          .unit = 1.0 / step,
                          .step = linear ? 1.0 : 0.7},
                         [=](TargetChoice& changed, double value) { changed.motions[j][which] = value; }});
    }
  }
  return numbers;
}

std::vector<FreeNumber<TargetChoice>> transition_numbers(const TargetChoice& choice, const TrackScale& scale) {
  std::vector<FreeNumber<TargetChoice>> numbers;
  const bool by_time = !choice.sojourn_s.empty();
  for (std::size_t i = 0; i < choice.models.size() && choice.models.size() > 1; ++i) {
    if (by_time) {
      numbers.push_back({{.name = "sojourn_s of " + choice.models[i],
                          .start = choice.sojourn_s[i],
                          .least = 0.5 * scale.step_s,
                          .most = 1e4 * scale.step_s},
                         [=](TargetChoice& changed, double value) { changed.sojourn_s[i] = value; }});
      continue;
    }
    // The others keep their ratios: of a random mode their sum is fitted, of a fuzzy one the greatest.
    const bool fuzzy = choice.fuzzy;
    const auto leaving = [=](const std::vector<double>& row) {
      double all = 0.0;
      for (std::size_t j = 0; j < row.size(); ++j)
        if (j != i) all = fuzzy ? std::max(all, row[j]) : all + row[j];
      return all;
    };
    const double start = leaving(choice.transition[i]);
    if (!(start > 0.0)) continue;
    numbers.push_back(
        {{.name = "leaving " + choice.models[i], .start = start, .least = 1e-6, .most = fuzzy ? 1.0 : 0.9},
         [=](TargetChoice& changed, double value) {
           auto& row = changed.transition[i];
           const double before = leaving(row);
           for (double& each : row) each = each / before * value;
           row[i] = fuzzy ? 1.0 : std::round((1.0 - value) * 1e12) / 1e12;  // as people write it
         }});
  }
  return numbers;
}

RobustLoss::RobustLoss(const Tracks& tracks, const TrackScale& scale) {
  for (const auto& track : tracks) {
    auto& own = log_strays_.emplace_back();
    for (const AnyDetection& detection : track) own.push_back(scale.log_stray(detection));
  }
}

std::vector<double> RobustLoss::operator()(std::size_t track, std::span<const double> log_scores) const {
  std::vector<double> losses(log_scores.begin(), log_scores.end());
  for (std::size_t k = 0; k < losses.size(); ++k)
    if (!std::isnan(losses[k])) losses[k] = -robust_log_score(losses[k], stray_share, log_strays_[track][k]);
  return losses;
}

double RobustLoss::strays(const RowLosses& losses, const RowCounts& counts) const {
  RowLosses odds = losses;
  for (std::size_t t = 0; t < odds.size(); ++t)
    for (std::size_t k = 0; k < odds[t].size(); ++k)  // the share of the stray density in all
      odds[t][k] = std::exp(std::log(stray_share) + log_strays_[t][k] + losses[t][k]);
  return mean_loss(odds, counts);
}

double RobustLoss::objective(const RowLosses& losses, const RowCounts& counts, double most_strays) const {
  return mean_loss(losses, counts) + a_stray_more * std::max(0.0, strays(losses, counts) - most_strays);
}

}  // namespace sigmax
