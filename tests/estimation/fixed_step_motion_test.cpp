#include "support/sigmax.hpp"

namespace fixed_step_motion_test {

using Glider = FixedStepMotion<2>;

const SquareMatrix<2> F{{1.0, 0.5}, {0.0, 1.0}};
const SquareMatrix<2> Q{{2.0, 1.0}, {1.0, 3.0}};
const Vector<2> u{0.1, 0.2};

TEST(FixedStepMotion, GivesTheMatricesThatItWasGiven) {
  const Glider model{"glider", {"x", "vx"}, 0.5, F, Q, u};
  EXPECT_EQ(model.name(), "glider");
  EXPECT_EQ(model.components(), (std::vector<std::string>{"x", "vx"}));
  EXPECT_EQ(model.size(), 2);
  EXPECT_EQ(model.transition(0.5), F);
  EXPECT_EQ(model.process_covariance(0.5), Q);
  EXPECT_EQ(model.known_input(0.5), u);
}

TEST(FixedStepMotion, HasNoKnownInputUnlessItIsGiven) {
  EXPECT_EQ((Glider{"glider", {"x", "vx"}, 0.5, F, Q}.known_input(0.5)), (Vector<2>{0.0, 0.0}));
}

TEST(FixedStepMotion, RefusesAnyOtherStepButForgivesRounding) {
  const Glider model{"glider", {"x", "vx"}, 0.3, F, Q};
  EXPECT_EQ(model.transition(0.1 + 0.2), F);
  EXPECT_INVALID(("glider", "0.3", "0.31"), model.transition(0.31));
  EXPECT_INVALID(("glider"), model.process_covariance(0.0));
  EXPECT_INVALID(("glider"), model.known_input(0.6));
}

TEST(FixedStepMotion, NeedsAComponentForEachStateAndAPositiveStep) {
  EXPECT_INVALID(("glider", "2", "1"), Glider("glider", {"x"}, 0.5, F, Q));
  EXPECT_INVALID(("glider", "positive"), Glider("glider", {"x", "vx"}, 0.0, F, Q));
}

}  // namespace fixed_step_motion_test
