// What step_bench compares the library with does the same work: both bare filters are the library's IMM.
#include "support/bare_imm.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include <sigmax/hybrid/interacting_multiple_model.hpp>

#include "support/matrices.hpp"

namespace sigmax {
namespace {

using support::near;
using support::near_matrix;

TEST(BareImm, BothBaselinesOfTheBenchAreTheLibrarysImm) {
  constexpr double T = 0.2, sigma_w = 3.0;
  Gaussian<9> start{Vector<9>::Zero(), SquareMatrix<9>::Identity()};
  start.mean.head<6>() << 12e3, 8e3, 1e3, -100.0, -100.0, 0.0;
  start.covariance.diagonal() << 100.0, 100.0, 100.0, 400.0, 400.0, 400.0, 100.0, 100.0, 100.0;
  const RandomVariable mode{"mode", {"dwna", "dwpa"}};
  InteractingMultipleModel filter{std::tuple{dwna<3>(sigma_w), dwpa<3>(sigma_w)},
                                  Relation{mode, mode, {{0.95, 0.05}, {0.05, 0.95}}}, start};
  support::BareImm<support::PlainUpdate> plain(T, sigma_w, start.mean, start.covariance);
  support::BareImm<support::UpdateByBlocks> by_blocks(T, sigma_w, start.mean, start.covariance);
  for (int k = 0; k < 300; ++k) {
    const double t = T * k, turning = std::clamp(t - 20.0, 0.0, 12.0);
    const double turn = 25.0 * turning * turning + 600.0 * std::max(t - 32.0, 0.0);
    SquareMatrix<3> R = 100.0 * SquareMatrix<3>::Identity();
    R(0, 1) = R(1, 0) = 20.0;
    const Gaussian<3> z{
        Vector<3>(12e3 - 100.0 * t + 10.0 * std::sin(3.0 * k), 8e3 - 100.0 * t - turn, 1e3 + 10.0 * std::cos(7.0 * k)),
        R};
    filter.step(T, z);
    const auto expected = filter.estimate();
    const auto is_the_librarys = [&](auto& bare) {
      bare.step(z.mean, z.covariance);
      bare.output();
      ASSERT_PRED_FORMAT3(near_matrix, bare.x, expected.mean, 1e-9);
      ASSERT_PRED_FORMAT3(near_matrix, bare.P, expected.covariance, 1e-9);
      ASSERT_PRED_FORMAT3(near, bare.mu(1), filter.belief()[1], 1e-9);
    };
    is_the_librarys(plain);
    is_the_librarys(by_blocks);
    ASSERT_PRED_FORMAT3(near_matrix, by_blocks.x, plain.x, 1e-9);
    ASSERT_PRED_FORMAT3(near_matrix, by_blocks.P, plain.P, 1e-9);
  }
}

}  // namespace
}  // namespace sigmax
