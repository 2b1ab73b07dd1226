#include "study/statistic.hpp"

#include <numeric>

#include <boost/math/distributions/students_t.hpp>

namespace sigmax::apps {

Statistic Statistic::mean(std::span<const double> sums, std::span<const double> counts) {
  const double sum = std::accumulate(sums.begin(), sums.end(), 0.0);
  const double count = std::accumulate(counts.begin(), counts.end(), 0.0);
  const double of_a_batch = count / static_cast<double>(counts.size());
  Statistic result;
  result.value_ = sum / count;
  for (std::size_t i = 0; i < sums.size(); ++i)
    result.change_.push_back((sums[i] - result.value_ * counts[i]) / of_a_batch);
  return result;
}

Interval Statistic::interval(std::size_t together) const {
  const auto n = static_cast<double>(change_.size());
  if (n < 2.0) return {value_, std::numeric_limits<double>::infinity()};
  const double squares = std::inner_product(change_.begin(), change_.end(), change_.begin(), 0.0);
  const double student =
      boost::math::quantile(boost::math::students_t(n - 1.0), 1.0 - 0.025 / static_cast<double>(together));
  return {value_, student * std::sqrt(squares / (n - 1.0) / n)};
}

std::vector<double> Statistic::numbers() const {
  std::vector<double> all = change_;
  all.push_back(value_);
  return all;
}

Statistic Statistic::of(std::span<const double> numbers) {
  Statistic result;
  result.value_ = numbers.back();
  result.change_.assign(numbers.begin(), numbers.end() - 1);
  return result;
}

}  // namespace sigmax::apps
