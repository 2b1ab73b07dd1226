#include <sigmax/estimation/consistency.hpp>

#include <array>
#include <cmath>
#include <numeric>

namespace sigmax {
namespace {

constexpr double bins_per_octave = 512.0;
constexpr int bin_of_zero = -10000000;

/// Below which 95 % of the NIS of so many quantities are.
double usual_nis(std::size_t quantities) {
  static const auto few = [] {
    std::array<double, 7> quantiles{};
    for (std::size_t m = 1; m < quantiles.size(); ++m) quantiles[m] = chi_square_quantile(0.95, static_cast<double>(m));
    return quantiles;
  }();
  return quantities < few.size() ? few[quantities] : chi_square_quantile(0.95, static_cast<double>(quantities));
}

}  // namespace

void InnovationTally::add_nis(double nis, std::size_t quantities) {
  ++count_;
  quantities_ += quantities;
  nis_ += nis;
  if (nis <= usual_nis(quantities)) ++inside_;
  ++bins_[nis > 0.0 ? static_cast<int>(std::floor(bins_per_octave * std::log2(nis))) : bin_of_zero];
}

void InnovationTally::add(std::span<const double> innovation, std::span<const double> before) {
  add_nis(std::inner_product(innovation.begin(), innovation.end(), innovation.begin(), 0.0), innovation.size());
  for (const double number : innovation) squares_ += number * number;
  numbers_ += innovation.size();
  if (before.size() != innovation.size()) return;
  for (std::size_t i = 0; i < innovation.size(); ++i) products_ += innovation[i] * before[i];
  pairs_ += innovation.size();
}

double InnovationTally::mean_nis() const { return nis_ / static_cast<double>(count_); }

double InnovationTally::expected_nis() const { return static_cast<double>(quantities_) / static_cast<double>(count_); }

double InnovationTally::median_nis() const {
  std::size_t below = 0;
  for (const auto& [bin, count] : bins_)
    if (2 * (below += count) >= count_) return bin == bin_of_zero ? 0.0 : std::exp2((bin + 0.5) / bins_per_octave);
  return 0.0;
}

double InnovationTally::share_inside() const { return static_cast<double>(inside_) / static_cast<double>(count_); }

double InnovationTally::autocorrelation_band() const {
  return 1.96 * std::sqrt(static_cast<double>(pairs_)) / static_cast<double>(numbers_);
}

}  // namespace sigmax
