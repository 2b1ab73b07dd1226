#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/gamma.hpp>
#include <boost/math/distributions/normal.hpp>

#include <sigmax/recognition/triangle.hpp>

namespace sigmax::apps {

/// A density of a quantity, as it was fitted to flights: normal, gamma or beta, the last two shifted and scaled.
class FittedDensity {
 public:
  static FittedDensity normal(double mean, double deviation);
  static FittedDensity gamma(double shape, double location, double scale);
  static FittedDensity beta(double a, double b, double location, double scale);

  /// Probability below x, which may be infinite.
  double cdf(double x) const;

  /// The number below which the probability is u, for 0 < u < 1.
  double quantile(double u) const;

 private:
  using Standard = std::variant<boost::math::normal_distribution<>, boost::math::gamma_distribution<>,
                                boost::math::beta_distribution<>>;
  FittedDensity(const Standard& standard, double location, double scale)
      : standard_(standard), location_(location), scale_(scale) {}

  Standard standard_;
  double location_;
  double scale_;
};

/// One quantity of one type of aircraft, known in two ways.
struct Performance {
  Triangle triangle;      ///< [minimum, optimum, maximum]
  FittedDensity density;  ///< fitted to the same flights
};

/// Types of aircraft and the quantities that are known of all of them.
struct PerformanceData {
  std::vector<std::string> types;
  std::vector<std::string> variables;
  std::vector<std::vector<Performance>> table;  ///< by variable, then by type
  std::vector<std::string> remarks;             ///< what had to be mended, with its line
};

/// Reads type,variable,optimum,minimum,maximum,model,parameters; other columns are ignored. Throws InputError with
/// file, line, column and value for what cannot be, and for a quantity that a type lacks.
PerformanceData read_performance(const std::string& file);

}  // namespace sigmax::apps
