#include <sigmax/core/mean_interval.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>

#include <boost/math/distributions/students_t.hpp>

namespace sigmax {

double RunningMean::mean() const {
  if (count_ == 0) throw std::domain_error("the mean of no number is not defined");
  return mean_;
}

Interval RunningMean::interval() const {
  if (count_ == 1) return {mean(), std::numeric_limits<double>::infinity()};
  const double centre = mean();
  const auto n = static_cast<double>(count_);
  const double student = boost::math::quantile(boost::math::students_t(n - 1.0), 0.975);
  return {centre, student * std::sqrt(squares_ / (n - 1.0) / n)};
}

Interval mean_interval(std::span<const double> numbers) {
  RunningMean mean;
  for (const double number : numbers) mean.add(number);
  return mean.interval();
}

}  // namespace sigmax
