#include "support/sigmax.hpp"

namespace components_test {

using Names = std::vector<std::string>;

template <int N>
FixedStepMotion<N> with(const Names& names) {
  return {"any", names, 1.0, SquareMatrix<N>::Identity(), SquareMatrix<N>::Identity()};
}

const std::vector<AnyModel> models{with<2>({"x", "vx"}), with<3>({"x", "vx", "omega"}), with<3>({"bias", "x", "vx"})};

TEST(Components, ThoseOfTheLargestModelLead) {
  const detail::Components components(models);
  EXPECT_EQ(components.names(), (Names{"x", "vx", "omega", "bias"}));
  EXPECT_EQ(components.size(), 4);
  EXPECT_EQ(components.of_all()[2].in_source, (std::vector<int>{1, 2, -1, 0}));
  EXPECT_EQ(components.of_model(0)[2].in_source, (std::vector<int>{1, 2}));
  EXPECT_EQ(components.of_model(1)[0].in_source, (std::vector<int>{0, 1, -1}));
}

TEST(Components, EveryModelTakesItsShareOfAStart) {
  const Gaussian<4> start{Vector<4>(1, 2, 3, 4),
                          SquareMatrix<4>{{10, 1, 2, 3}, {1, 20, 4, 5}, {2, 4, 30, 6}, {3, 5, 6, 40}}};
  const Estimates shares = detail::Components(models).shares(detail::view(start));
  EXPECT_EQ(shares[0].mean, (Vector<2>(1, 2)));
  EXPECT_EQ(shares[1].covariance, (SquareMatrix<3>{{10, 1, 2}, {1, 20, 4}, {2, 4, 30}}));
  EXPECT_EQ(shares[2].mean, (Vector<3>(4, 1, 2)));
  EXPECT_EQ(shares[2].covariance, (SquareMatrix<3>{{40, 3, 5}, {3, 10, 1}, {5, 1, 20}}));
  const Gaussian<2> few{Vector<2>::Zero(), SquareMatrix<2>::Identity()};
  EXPECT_INVALID(("2", "4"), detail::Components(models).shares(detail::view(few)));
}

TEST(Components, EachIsCarriedByTheModelThatWasChosenForIt) {
  Estimates estimates;
  estimates.add(Gaussian<2>{Vector<2>(1, 2), SquareMatrix<2>{{1, 0.5}, {0.5, 2}}});
  estimates.add(Gaussian<3>{Vector<3>(3, 4, 5), SquareMatrix<3>::Constant(7.0)});
  estimates.add(Gaussian<3>{Vector<3>(6, 7, 8), SquareMatrix<3>::Constant(9.0)});
  const std::size_t carriers[] = {0, 0, 1, 2};
  Gaussian<4> found;
  detail::Components(models).carry(estimates, carriers, detail::view(found));
  EXPECT_EQ(found.mean, (Vector<4>(1, 2, 5, 6)));
  EXPECT_EQ(found.covariance, (SquareMatrix<4>{{1, 0.5, 0, 0}, {0.5, 2, 0, 0}, {0, 0, 7, 0}, {0, 0, 0, 9}}));
}

TEST(Components, OfAPriorHaveItsVariancesByTheirNames) {
  Estimates entries = detail::estimates_of(models);
  entries[1].covariance.setOnes();
  detail::write_entries(models, {.turn_rate = 0.1}, 3.0, entries);
  EXPECT_EQ(entries[1].mean, Vector<3>::Zero());
  EXPECT_EQ(entries[1].covariance, (SquareMatrix<3>(Vector<3>(9.0, 9.0, 0.1 * 0.1).asDiagonal())));
}

}  // namespace components_test
