#include "support/sigmax.hpp"

namespace computed_law_test {

/// Shows numbers that tell where they came from.
struct Counted : detail::ComputedLaw<Counted, 2> {
  std::string_view name() const { return "counted"; }
  void compute(double dt, double* F, double* Q, double* gain) const {
    for (int i = 0; i < 4; ++i) {
      F[i] = dt + i;
      Q[i] = 10.0 + i;
    }
    gain[0] = 20.0;
    gain[1] = 21.0;
  }
};
static_assert(MotionLaw<Counted> && detail::ComputesItself<Counted>);

TEST(ComputedLaw, ShowsWhatItComputesByColumns) {
  EXPECT_EQ(Counted{}.transition(1.0), (SquareMatrix<2>{{1, 3}, {2, 4}}));
  EXPECT_EQ(Counted{}.process_covariance(1.0), (SquareMatrix<2>{{10, 12}, {11, 13}}));
  EXPECT_EQ(Counted{}.input_gain(1.0), (Vector<2>(20, 21)));
}

// What is derived from the library's own is asked by its own functions.

struct Noiseless : DiscreteWhiteNoise<2> {
  using DiscreteWhiteNoise::DiscreteWhiteNoise;
  SquareMatrix<2> process_covariance(double) const { return SquareMatrix<2>::Zero(); }
};
struct Frozen : KnownTurn<2> {
  using KnownTurn::KnownTurn;
  SquareMatrix<4> transition(double) const { return SquareMatrix<4>::Identity(); }
};
struct Halved : CoordinatedTurn<2> {
  using CoordinatedTurn::CoordinatedTurn;
  Vector<5> propagate(const Vector<5>& x, double) const { return 0.5 * x; }
};
static_assert(detail::ComputesItself<KnownTurn<2>> && !detail::ComputesItself<Frozen>);

TEST(ComputedLaw, ADerivedOneIsAskedByItsOwnFunctions) {
  const Gaussian<4> start{Vector<4>(1.0, 2.0, 3.0, 4.0), SquareMatrix<4>::Zero()};
  const IndependentAxes<2, Noiseless> noiseless{Noiseless{3.0}};
  EXPECT_EQ(predict(noiseless, start, 2.0).mean, (Vector<4>(7.0, 10.0, 3.0, 4.0)));
  EXPECT_EQ(predict(noiseless, start, 2.0).covariance, SquareMatrix<4>::Zero());
  EXPECT_EQ(predict(Frozen{1.0, 2.0}, start, 2.0).mean, start.mean);
  EXPECT_EQ(predict(Frozen{1.0, 2.0}, start, 2.0).covariance, (KnownTurn<2>{1.0, 2.0}.process_covariance(2.0)));
  const Gaussian<5> turning{Vector<5>(1.0, 2.0, 3.0, 4.0, 0.5), SquareMatrix<5>::Zero()};
  EXPECT_EQ(predict(Extended{Halved{1.0, 1.0}}, turning, 2.0).mean, 0.5 * turning.mean);
}

}  // namespace computed_law_test
