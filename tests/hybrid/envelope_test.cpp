#include "hybrid/banks.hpp"

namespace envelope_test {

struct Moments {
  double beta;
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

struct Weighted {
  double weight;
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

Moments matched(const std::vector<Weighted>& parts) {
  const auto n = static_cast<int>(parts.front().mean.size());
  Envelope envelope;
  envelope.clear(n);
  for (const auto& part : parts) envelope.add(part.weight, {part.mean.data(), part.covariance.data(), n});
  Moments result{0.0, Eigen::VectorXd(n), Eigen::MatrixXd(n, n)};
  result.beta = envelope.match({result.mean.data(), result.covariance.data(), n});
  return result;
}

Weighted scalar(double weight, double mean, double variance) {
  return {weight, Eigen::VectorXd::Constant(1, mean), Eigen::MatrixXd::Constant(1, 1, variance)};
}
Weighted planar(double weight, double x, double y, double xx, double xy, double yy) {
  return {weight, Eigen::Vector2d{x, y}, Eigen::Matrix2d{{xx, xy}, {xy, yy}}};
}

/// The same moments by adding up the greatest density times weight over a fine grid of the plane.
Moments added_up(const std::vector<Weighted>& parts, double half_width, int cells) {
  struct Height {
    double x, y, scale, xx, xy, yy;
  };
  std::vector<Height> heights;
  for (const Weighted& part : parts) {
    const Eigen::Matrix2d inverse = part.covariance.inverse();
    heights.push_back({part.mean(0), part.mean(1),
                       part.weight * std::sqrt(inverse.determinant()) / (2.0 * std::numbers::pi), inverse(0, 0),
                       inverse(0, 1), inverse(1, 1)});
  }
  const double width = 2.0 * half_width / cells;
  double beta = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0, syy = 0.0;
  for (int i = 0; i < cells; ++i)
    for (int k = 0; k < cells; ++k) {
      const double x = -half_width + width * (i + 0.5), y = -half_width + width * (k + 0.5);
      double greatest = 0.0;
      for (const Height& of : heights) {
        const double a = x - of.x, b = y - of.y;
        greatest =
            std::max(greatest, of.scale * std::exp(-0.5 * (of.xx * a * a + 2.0 * of.xy * a * b + of.yy * b * b)));
      }
      const double mass = greatest * width * width;
      beta += mass;
      sx += mass * x, sy += mass * y;
      sxx += mass * x * x, sxy += mass * x * y, syy += mass * y * y;
    }
  Moments result{beta, Eigen::Vector2d{sx, sy} / beta, Eigen::Matrix2d{{sxx, sxy}, {sxy, syy}} / beta};
  result.covariance -= result.mean * result.mean.transpose();
  return result;
}

void expect_near(const Moments& found, const Moments& expected, double tolerance) {
  EXPECT_NEAR(found.beta, expected.beta, tolerance * expected.beta);
  const Eigen::VectorXd sigma = expected.covariance.diagonal().cwiseSqrt();
  EXPECT_LT(((found.mean - expected.mean).cwiseQuotient(sigma)).cwiseAbs().maxCoeff(), tolerance);
  EXPECT_LT(((found.covariance - expected.covariance).cwiseQuotient(sigma * sigma.transpose())).cwiseAbs().maxCoeff(),
            2.0 * tolerance);
}

TEST(Envelope, IsTheMaximumAddedUpOverAGrid) {
  for (const auto& parts : {std::vector{planar(1.0, 0.0, 0.5, 1.0, 0.3, 2.0), planar(0.5, 1.0, -0.5, 2.0, -0.7, 1.0)},
                            std::vector{planar(0.3, -1.0, 0.0, 0.5, 0.0, 0.5), planar(1.0, 1.5, 1.0, 1.0, 0.9, 1.0)}})
    expect_near(matched(parts), added_up(parts, 12.0, 800), 0.01);
  // On a line: beside it all are alike.
  for (const auto& parts : {std::vector{scalar(1.0, -0.3, 0.6), scalar(0.5, 0.4, 2.0)},
                            std::vector{scalar(0.2, -1.0, 1.0), scalar(1.0, 1.0, 1.0), scalar(0.7, 4.0, 0.2)},
                            std::vector{scalar(1.0, 0.0, 1.0), scalar(0.9, 0.0, 9.0)}}) {
    std::vector<Weighted> wide;
    for (const Weighted& part : parts)
      wide.push_back(planar(part.weight, part.mean(0), 0.0, part.covariance(0, 0), 0.0, 1.0));
    const Moments expected = added_up(wide, 15.0, 800);
    expect_near(matched(parts), {expected.beta, expected.mean.head(1), expected.covariance.topLeftCorner(1, 1)}, 0.01);
  }
}

TEST(Envelope, OfOnePartIsThePart) {
  const auto part = planar(0.4, 3.0, -1.0, 2.0, 0.5, 1.0);
  expect_near(matched({part}), {0.4, part.mean, part.covariance}, 1e-12);
}

TEST(Envelope, OfEqualPartsIsTheGreatest) {
  auto part = planar(1.0, 3.0, -1.0, 2.0, 0.5, 1.0), less = part, none = part;
  less.weight = 0.3;
  none.weight = 0.0;
  expect_near(matched({less, part, none}), {1.0, part.mean, part.covariance}, 1e-12);
}

TEST(Envelope, OfPartsThatExcludeEachOtherIsTheirSum) {
  const auto found = matched({scalar(1.0, 0.0, 1.0), scalar(0.5, 300.0, 4.0)});
  EXPECT_NEAR(found.beta, 1.5, 1e-12);
  EXPECT_NEAR(found.mean(0), 100.0, 1e-10);
  EXPECT_NEAR(found.covariance(0, 0), (1.0 + 0.5 * 4.0) / 1.5 + (1e4 + 0.5 * 4e4) / 1.5, 1e-8);
}

TEST(Envelope, APartWithoutAVarianceCountsBesideOthersInFull) {
  const auto flat = planar(1.0, 1.0, 0.0, 2.0, 0.0, 0.0);
  const auto wide = planar(0.5, 1.0, 3.0, 2.0, 0.1, 1.0);
  const auto found = matched({flat, wide});
  EXPECT_NEAR(found.beta, 1.5, 1e-12);
  EXPECT_NEAR(found.mean(1), 1.0, 1e-12);
  EXPECT_NEAR(found.covariance(1, 1), 0.5 / 1.5 + (1.0 + 0.5 * 4.0) / 1.5, 1e-12);
  auto again = flat;  // on the same line the parts compare
  again.weight = 0.5;
  EXPECT_NEAR(matched({flat, again}).beta, 1.0, 1e-12);
  again.mean(1) = 2.0;  // on another they do not
  EXPECT_NEAR(matched({flat, again}).beta, 1.5, 1e-12);
}

TEST(Envelope, OfPartsWithoutAnyVarianceIsTheirMassesWhereTheyAre) {
  const auto at = [](double weight, double x, double y) { return planar(weight, x, y, 0.0, 0.0, 0.0); };
  const auto found = matched({at(1.0, 0.0, 1.0), at(0.5, 3.0, 1.0), at(0.2, 3.0, 1.0)});
  EXPECT_NEAR(found.beta, 1.5, 1e-12);
  EXPECT_NEAR(found.mean(0), 1.0, 1e-12);
  EXPECT_NEAR(found.covariance(0, 0), 2.0, 1e-12);
  EXPECT_EQ(found.covariance(1, 1), 0.0);
}

TEST(Envelope, HasAMassBetweenTheGreatestWeightAndTheirSum) {
  for (const double apart : {0.0, 0.01, 0.1, 1.0, 10.0})
    for (const double variance : {1.0, 1.01, 2.0, 1e4}) {
      const double beta = matched({scalar(1.0, 0.0, 1.0), scalar(0.8, apart, variance)}).beta;
      EXPECT_GE(beta, 1.0) << apart << ' ' << variance;
      EXPECT_LE(beta, 1.8) << apart << ' ' << variance;
    }
}

TEST(Envelope, DoesNotDependOnUnits) {
  const std::vector parts = {planar(1.0, 0.0, 0.5, 1.0, 0.3, 2.0), planar(0.5, 1.0, -0.5, 2.0, -0.7, 1.0)};
  const Eigen::Vector2d unit{1e-9, 1e6};
  auto scaled = parts;
  for (auto& part : scaled) {
    part.mean = part.mean.cwiseProduct(unit);
    part.covariance = unit.asDiagonal() * part.covariance * unit.asDiagonal();
  }
  const auto plain = matched(parts);
  expect_near(matched(scaled),
              {plain.beta, plain.mean.cwiseProduct(unit), unit.asDiagonal() * plain.covariance * unit.asDiagonal()},
              1e-9);
}

TEST(Envelope, RefusesWhatItCannotMeasure) {
  Envelope envelope;
  EXPECT_THROW(envelope.clear(0), std::invalid_argument);
  EXPECT_THROW(envelope.clear(33), std::invalid_argument);
  envelope.clear(2);
  Gaussian<2> result;
  EXPECT_THROW(envelope.match(detail::view(result)), std::logic_error);
  EXPECT_THROW(matched({planar(1.0, 0.0, 0.0, 1.0, 2.0, 1.0)}), std::domain_error);
}

TEST(Envelope, OfTheModesIsTheOutputOfAFilterAndGivesItsBeta) {
  TargetChoice choice = chosen(true);
  choice.mixed_covariance = MixedCovariance::envelope;
  AnyFilter filter(choice);
  for (const auto& scan : manoeuvring_target(100)) filter.step(scan);
  std::vector<Weighted> parts;
  for (std::size_t j = 0; j < 3; ++j) {
    Weighted part{std::exp(filter.logs[j]), Eigen::VectorXd::Zero(6), Eigen::MatrixXd::Zero(6, 6)};
    const auto own = filter.estimates[j];
    part.mean.head(own.size()) = own.mean;
    part.covariance.topLeftCorner(own.size(), own.size()) = own.covariance;
    for (Eigen::Index i = own.size(); i < 6; ++i) part.covariance(i, i) = filter.estimates[2].covariance(i, i);
    parts.push_back(part);
  }
  const auto expected = matched(parts);
  filter.do_with([&](const auto& one) {
    if constexpr (requires { one.beta(); })
      expect_near({one.beta(), filter.estimate.mean, filter.estimate.covariance}, expected, 1e-9);
  });
  EXPECT_GT(expected.beta, 1.0);
}

}  // namespace envelope_test
