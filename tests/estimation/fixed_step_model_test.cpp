#include <sigmax/estimation/fixed_step_model.hpp>

#include <gtest/gtest.h>

#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::throws;
using Model = FixedStepModel<2, 1>;

const SquareMatrix<2> F{{1.0, 0.5}, {0.0, 1.0}};
const SquareMatrix<2> Q{{2.0, 1.0}, {1.0, 3.0}};
const Eigen::Matrix<double, 1, 2> H{0.0, 1.0};
const Vector<2> u{0.1, 0.2};

TEST(FixedStepModel, GivesTheMatricesThatItWasGiven) {
  const Model model{"glider", {"x", "vx"}, 0.5, F, Q, H, u};
  EXPECT_EQ(model.name(), "glider");
  EXPECT_EQ(model.components(), (std::vector<std::string>{"x", "vx"}));
  EXPECT_EQ(model.size(), 2);
  EXPECT_EQ(model.transition(0.5), F);
  EXPECT_EQ(model.process_covariance(0.5), Q);
  EXPECT_EQ(model.known_input(0.5), u);
  EXPECT_EQ(model.measurement_matrix(), H);
}

TEST(FixedStepModel, HasNoKnownInputUnlessItIsGiven) {
  EXPECT_EQ((Model{"glider", {"x", "vx"}, 0.5, F, Q, H}.known_input(0.5)), (Vector<2>{0.0, 0.0}));
}

TEST(FixedStepModel, RefusesAnyOtherStepButForgivesRounding) {
  const Model model{"glider", {"x", "vx"}, 0.3, F, Q, H};
  EXPECT_EQ(model.transition(0.1 + 0.2), F);
  EXPECT_TRUE(throws<std::invalid_argument>([&] { model.transition(0.31); }, {"glider", "0.3", "0.31"}));
  EXPECT_TRUE(throws<std::invalid_argument>([&] { model.process_covariance(0.0); }, {"glider"}));
  EXPECT_TRUE(throws<std::invalid_argument>([&] { model.known_input(0.6); }, {"glider"}));
}

TEST(FixedStepModel, NeedsAComponentForEachStateAndAPositiveStep) {
  EXPECT_TRUE(throws<std::invalid_argument>([&] { Model("glider", {"x"}, 0.5, F, Q, H); }, {"glider", "2", "1"}));
  EXPECT_TRUE(throws<std::invalid_argument>(
      [&] {
        Model("glider", {"x", "vx"}, 0.0, F, Q, H);
      },
      {"glider", "positive"}));
}

}  // namespace
}  // namespace sigmax
