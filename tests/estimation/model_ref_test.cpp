#include "support/sigmax.hpp"

namespace model_ref_test {

/// A turn by functions that nobody can differentiate.
struct Opaque : CoordinatedTurn<2> {
  using CoordinatedTurn::CoordinatedTurn;
  void transition_jacobian() const {}
};

TEST(ModelRef, AsksAMotionByTheFunctionsThatItHas) {
  const auto motion = dwpa<3>(1.0);
  const KnownTurn<2> known{0.1, 1.0};
  const Extended extended{CoordinatedTurn<3>{1.0, 0.1}};
  const auto law = detail::model_ref(motion), linear = detail::model_ref(known), tangent = detail::model_ref(extended);
  EXPECT_TRUE(law.table->law && law.linear());
  EXPECT_TRUE(!linear.table->law && linear.linear());
  EXPECT_TRUE(!tangent.table->law && !tangent.linear());
  EXPECT_EQ(law.size(), 9);
  EXPECT_EQ(linear.table->axes, 2);
  EXPECT_EQ(tangent.name(), "coordinated_turn");
}

TEST(ModelRef, TellsWhereItsPointsLie) {
  const Cubature cubature{Opaque{1.0, 0.1}};
  EXPECT_TRUE(detail::model_ref(cubature).by_points());
  EXPECT_EQ(detail::model_ref(cubature).points.spread, 5.0);
  EXPECT_FALSE(detail::model_ref(Extended{CoordinatedTurn<2>{1.0, 0.1}}).by_points());
  const AnyModel any = cubature;
  EXPECT_EQ(detail::model_ref(any).points.spread, 5.0);
  EXPECT_EQ(detail::model_ref(any).table, detail::model_ref(cubature).table);
}

/// Else a turn that nobody can differentiate would not compile.
TEST(ModelRef, PointsNeedNoJacobian) {
  const Gaussian<5> x{Vector<5>(1.0, 2.0, 3.0, 4.0, 0.1), SquareMatrix<5>::Identity()};
  EXPECT_EQ(predict(Cubature{Opaque{1.0, 0.1}}, x, 1.0).mean,
            predict(Cubature{CoordinatedTurn<2>{1.0, 0.1}}, x, 1.0).mean);
}

}  // namespace model_ref_test
