#include "himm_demo/track_warnings.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace sigmax::apps {
namespace {
constexpr double validity_limit = 0.4;
constexpr double nis_limit = 30.0;
constexpr std::size_t fewest_refused = 5;
}  // namespace

void Validity::add(const Fix& fix, const Polar& seen, const std::vector<FilterSettings>& filters) {
  ++measurements_;
  double worst = 0.0;
  for (const auto& filter : filters) {
    if (filter.radar_measurement != RadarForm::standard) continue;
    const Polar& sigma = filter.accuracy_of(fix.sensor).radar;
    const double value = conversion_validity(seen.range, sigma);
    worst = std::max(worst, value);
    if (value >= validity_limit)
      sigma_range_needed_ = std::max(sigma_range_needed_, value * sigma.range / validity_limit);
  }
  if (worst < validity_limit) return;
  if (outside_++ > 0) return;
  first_line_ = fix.line;
  first_value_ = worst;
  first_range_ = seen.range;
}

std::string Validity::warning(const std::string& file) const {
  const double unit = std::pow(10.0, std::floor(std::log10(sigma_range_needed_)) - 1.0);
  return fmt::format(
      "{}:{}: r σ_α²/σ_r is {:.2g} at a range of {:.0f} m, where the standard conversion of radar measurements holds "
      "below {}; so it is in {} of {} measurements; set sigma_range_m above {:.6g}, so that their covariance covers "
      "the error of the conversion, or radar_measurement=polar, which converts only for the start",
      file, first_line_, first_value_, first_range_, validity_limit, outside_, measurements_,
      std::ceil(sigma_range_needed_ / unit) * unit);
}

void Refusals::add(const std::string& track, const FilterSettings& filter, std::size_t rejected,
                   std::size_t measurements) {
  if (rejected < fewest_refused || 5 * rejected <= measurements) return;
  ++many_;
  if (rejected * worst_measurements_ <= worst_rejected_ * measurements) return;
  worst_track_ = track;
  worst_filter_ = filter.name;
  worst_gate_ = filter.gate_probability;
  worst_rejected_ = rejected;
  worst_measurements_ = measurements;
}

std::string Refusals::warning(const std::string& file) const {
  return fmt::format(
      "{}: the gate of filter '{}' turned {} of {} measurements{} away{}, where {:.2g} are expected: the filter does "
      "not "
      "follow, or there are several targets or many outliers; raise sigma_w, the sensor's sigmas or gate_probability",
      file, worst_filter_, worst_rejected_, worst_measurements_,
      worst_track_.empty() ? "" : fmt::format(" of track '{}'", worst_track_),
      many_ > 1 ? fmt::format(" (and of {} other filters or tracks too many)", many_ - 1) : "",
      (1.0 - worst_gate_) * static_cast<double>(worst_measurements_));
}

void Outliers::add(std::size_t line, double nis) {
  if (nis <= nis_limit) return;
  ++count_;
  if (nis <= worst_nis_) return;
  worst_line_ = line;
  worst_nis_ = nis;
}

std::string Outliers::warning(const std::string& file, std::size_t measurements, bool one_track) const {
  const bool many = one_track && count_ >= 3 && 10 * count_ >= measurements;
  return fmt::format(
      "{}:{}: no filter expects this measurement (NIS {:.3g}); above an NIS of {} are {} of {}; look for outliers, "
      "or raise sigma_w or the sensor's sigmas{}",
      file, worst_line_, worst_nis_, nis_limit, count_, measurements,
      many ? "; if the file holds several targets, tell them apart with --track-id COLUMN" : "");
}

}  // namespace sigmax::apps
