#include "study/statistic.hpp"

#include <numeric>
#include <stdexcept>

#include <boost/math/distributions/students_t.hpp>

#include <fmt/core.h>

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

void Batches::add(std::span<const double> row) {
  if (row.size() != columns_.size())
    throw std::runtime_error(fmt::format("a cell of {} numbers, expected {}", row.size(), columns_.size()));
  for (std::size_t c = 0; c < row.size(); ++c) columns_[c].push_back(row[c]);
}

}  // namespace sigmax::apps
