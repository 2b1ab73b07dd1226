#include <sigmax/recognition/reliability.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace sigmax {

Reliability::Reliability(std::size_t bins) : sums_(bins) {
  if (bins == 0) throw std::invalid_argument("a reliability diagram needs a bin");
}

void Reliability::add(double degree, bool is_true) {
  if (!(degree >= 0.0 && degree <= 1.0))
    throw std::invalid_argument("a degree of belief is in [0, 1], not " + std::to_string(degree));
  const auto bin = static_cast<std::size_t>(degree * static_cast<double>(sums_.size()));
  Sums& sums = sums_[std::min(bin, sums_.size() - 1)];
  sums.count += 1.0;
  sums.degrees += degree;
  sums.true_ones += is_true ? 1.0 : 0.0;
}

void Reliability::add(const Reliability& other) {
  if (other.sums_.size() != sums_.size())
    throw std::invalid_argument("reliability diagrams of " + std::to_string(sums_.size()) + " and " +
                                std::to_string(other.sums_.size()) + " bins do not add up");
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    sums_[i].count += other.sums_[i].count;
    sums_[i].degrees += other.sums_[i].degrees;
    sums_[i].true_ones += other.sums_[i].true_ones;
  }
}

std::vector<Reliability::Bin> Reliability::bins(double repetitions) const {
  if (!(repetitions >= 1.0))
    throw std::invalid_argument("statements are counted once or more, not " + std::to_string(repetitions) + " times");
  constexpr double z = 1.959963984540054;  // 97.5 % quantile of the normal distribution
  const auto size = static_cast<double>(sums_.size());
  std::vector<Bin> bins;
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    const Sums& sums = sums_[i];
    if (sums.count == 0.0) continue;
    const double n = sums.count / repetitions, share = sums.true_ones / sums.count;
    const double middle = (n * share + 0.5 * z * z) / (n + z * z);
    const double half = z / (n + z * z) * std::sqrt(n * share * (1.0 - share) + 0.25 * z * z);
    const auto k = static_cast<double>(i);
    bins.push_back({k / size, (k + 1.0) / size, n, sums.degrees / sums.count, share, std::max(0.0, middle - half),
                    std::min(1.0, middle + half)});
  }
  return bins;
}

double Reliability::calibration_error() const {
  double count = 0.0, error = 0.0;
  for (const Sums& sums : sums_) {
    count += sums.count;
    error += std::abs(sums.degrees - sums.true_ones);
  }
  if (count == 0.0) throw std::domain_error("nothing was counted");
  return error / count;
}

}  // namespace sigmax
