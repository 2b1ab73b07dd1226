// The soak of bench/hybrid/soak.cpp in a small size, and whether its judge of covariances can tell good from bad.
#include "support/soak.hpp"
#include "support/sigmax.hpp"

namespace soak_test {

TEST(Soak, ACovarianceIsJudgedWhateverItsUnits) {
  const Eigen::Matrix3d singular{{1.0, 1.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 0.0, 0.0}};
  const Eigen::Matrix3d indefinite{{1.0, 0.9, 0.9}, {0.9, 1.0, -0.9}, {0.9, -0.9, 1.0}};
  const Eigen::Matrix3d overcorrelated{{1.0, 1.0 + 1e-8, 0.0}, {1.0 + 1e-8, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  for (const Eigen::Vector3d& units : {Eigen::Vector3d(1.0, 1.0, 1.0), Eigen::Vector3d(1e-9, 1e14, 1e-100)}) {
    const auto in_units = [&](const Eigen::Matrix3d& P) -> Eigen::Matrix3d {
      return units.asDiagonal() * P * units.asDiagonal();
    };
    EXPECT_TRUE(symmetric_and_semi_definite(in_units(singular)));
    EXPECT_FALSE(symmetric_and_semi_definite(in_units(indefinite)));
    EXPECT_FALSE(symmetric_and_semi_definite(in_units(overcorrelated)));
  }
  EXPECT_FALSE(symmetric_and_semi_definite(Eigen::Matrix3d{{1.0, 0.1, 0.0}, {0.2, 1.0, 0.0}, {0.0, 0.0, 1.0}}));
  EXPECT_FALSE(symmetric_and_semi_definite(Eigen::Matrix3d{{0.0, 1.0, 0.0}, {1.0, 1.0, 0.0}, {0.0, 0.0, 1.0}}));
}

template <Uncertainty Kind>
void soaks() {
  const auto report = support::soak<Kind>(20'000, 2);
  EXPECT_EQ(report.failure, "");
  EXPECT_EQ(report.steps, 20'000U);
  EXPECT_GT(report.missed, 0U);
  EXPECT_GT(report.outliers, 0U);
}

TEST(Soak, AnImmStaysSound) { soaks<Random>(); }
TEST(Soak, AHimmStaysSound) { soaks<Fuzzy>(); }

}  // namespace soak_test
