#include "kernels/kernels.hpp"

#include <Eigen/LU>

#include "support/sigmax.hpp"

namespace kernels_test {

using Matrix = Eigen::MatrixXd;
using sigmax::detail::Outcome;

Matrix random_covariance(Eigen::Index n) {
  const Matrix A = Matrix::Random(n, n);
  return A * A.transpose() + 0.5 * Matrix::Identity(n, n);
}

template <class Action>
void with_each_instruction_set(const Action& action) {
  for (const auto* kernels : detail::available_kernels()) {
    SCOPED_TRACE(testing::Message() << "instruction set " << (kernels == &detail::baseline_kernels() ? 1 : 2));
    action(*kernels);
  }
}

struct Case {
  int n, seen, m;
  bool has_H;
};

/// Every shape that has code of its own, some that have none, and more quantities and states than fit on the stack.
std::vector<Case> cases() {
  std::vector<Case> all{{5, 4, 3, true},   {8, 6, 4, true},    {8, 2, 1, true},     {4, 4, 2, true},
                        {11, 4, 4, false}, {20, 18, 17, true}, {18, 17, 17, false}, {3, 3, 3, false}};
  for (const int n : {4, 5, 6, 7, 9}) all.push_back({n, 2, 1, true});
  for (const int n : {4, 6}) all.push_back({n, 4, 3, true});
  for (const int n : {6, 7, 9}) all.push_back({n, 6, 4, true});
  for (const int axes : {1, 2, 3})
    for (const int n : {2 * axes, 2 * axes + 1, 3 * axes, 3 * axes + 1})
      for (const bool has_H : {false, true}) all.push_back({n, axes, axes, has_H});
  return all;
}

TEST(Kernels, UpdateIsJosephsFormInPlaceToo) {
  with_each_instruction_set([](const detail::Kernels& kernels) {
    for (const Case& one : cases()) {
      const int n = one.n, seen = one.seen, m = one.m;
      const bool has_H = one.has_H;
      SCOPED_TRACE(testing::Message() << n << " states, " << seen << " seen, " << m << " quantities, H " << has_H);
      const Matrix P = random_covariance(n), R = random_covariance(m), x = Matrix::Random(n, 1),
                   z = Matrix::Random(m, 1);
      const Matrix residual = Matrix::Random(m, 1),
                   given = has_H ? Matrix(Matrix::Random(m, seen)) : Matrix::Identity(m, seen);
      Matrix H = Matrix::Zero(m, n);
      H.leftCols(seen) = given;
      const Matrix S = H * P * H.transpose() + R, W = P * H.transpose() * S.inverse();
      const Matrix rest = Matrix::Identity(n, n) - W * H;
      const Matrix covariance = rest * P * rest.transpose() + W * R * W.transpose(), mean = x + W * residual;
      const double distance = (residual.transpose() * S.inverse() * residual)(0);

      Matrix found_S(m, m), moved = x, updated = P, told = residual;
      detail::InnovationView innovation{told.data(), found_S.data()};
      const auto update = [&](const Matrix& from, const Matrix& about, Matrix& to_mean, Matrix& to) {
        return kernels.update(has_H ? given.data() : nullptr, seen, {about.data(), from.data(), n},
                              {z.data(), R.data(), m}, {to_mean.data(), to.data(), n}, innovation);
      };
      Matrix other_mean(n, 1), other(n, n);
      ASSERT_EQ(update(P, x, other_mean, other), Outcome::done);
      ASSERT_EQ(update(updated, moved, moved, updated), Outcome::done);
      EXPECT_CLOSE(other, covariance, 1e-11);
      EXPECT_CLOSE(other_mean, mean, 1e-11);
      EXPECT_EQ(updated, other);
      EXPECT_EQ(moved, other_mean);
      EXPECT_EQ(updated, Matrix(updated.transpose()));
      EXPECT_CLOSE(found_S, S, 1e-11);
      EXPECT_NEAR(innovation.squared_distance, distance, 1e-10 * (1.0 + distance));
      EXPECT_NEAR(innovation.log_likelihood, -0.5 * (distance + std::log((2.0 * std::numbers::pi * S).determinant())),
                  1e-10 * (1.0 + distance));
      Matrix inverse(m, m);
      ASSERT_EQ(kernels.score({z.data(), R.data(), m}, innovation, inverse.data()), Outcome::done);
      EXPECT_CLOSE(inverse, S.inverse(), 1e-11);
    }
  });
}

TEST(Kernels, PredictionIsThatOfTheWholeMatrices) {
  with_each_instruction_set([](const detail::Kernels& kernels) {
    for (const int axes : {1, 2, 3})
      for (const int order : {1, 2, 3}) {
        SCOPED_TRACE(testing::Message() << axes << " axes of order " << order);
        const int n = axes * order;
        const Matrix Q = random_covariance(order), P = random_covariance(n), x = Matrix::Random(n, 1),
                     input = Matrix::Random(n, 1);
        const Matrix F = Matrix::Random(order, order).triangularView<Eigen::Upper>();
        Matrix all_F = Matrix::Zero(n, n), all_Q = Matrix::Zero(n, n);
        for (int a = 0; a < order; ++a)
          for (int b = 0; b < order; ++b) {
            all_F.block(a * axes, b * axes, axes, axes).diagonal().setConstant(F(a, b));
            all_Q.block(a * axes, b * axes, axes, axes).diagonal().setConstant(Q(a, b));
          }
        detail::AxisLaw law;
        law.order = order;
        for (int i = 0; i < order * order; ++i) {
          law.F[i] = F.data()[i];
          law.Q[i] = Q.data()[i];
        }
        for (int i = 0; i < n; ++i) law.input[i] = input(i);
        const Matrix expected = all_F * P * all_F.transpose() + all_Q, mean = all_F * x + input;
        Matrix moved = x, covariance = P, other_mean(n, 1), other(n, n), by_matrices = P;
        kernels.predict(law, axes, {x.data(), P.data(), n}, {other_mean.data(), other.data(), n});
        kernels.predict(law, axes, {x.data(), P.data(), n}, {moved.data(), covariance.data(), n});
        kernels.predict_covariance(all_F.data(), all_Q.data(), by_matrices.data(), n, by_matrices.data());
        EXPECT_CLOSE(other, expected, 1e-12);
        EXPECT_CLOSE(other_mean, mean, 1e-12);
        EXPECT_EQ(covariance, other);
        EXPECT_EQ(moved, other_mean);
        EXPECT_EQ(other, Matrix(other.transpose()));
        EXPECT_CLOSE(by_matrices, expected, 1e-12);
      }
  });
}

/// Also beyond the ten rows, and the terms of a sum, that are held at once; in columns that are two numbers longer than
/// they need be, of which the last two are not touched.
TEST(Kernels, ProductsAreEigens) {
  with_each_instruction_set([](const detail::Kernels& kernels) {
    for (const int rows : {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 23})
      for (const int inner : {1, 2, 31, 32, 33, 70})
        for (const int columns : {1, 2, 7}) {
          const Matrix A = Matrix::Random(rows + 2, inner), B = Matrix::Random(inner, columns), by_rows = B.transpose(),
                       C = Matrix::Random(rows + 2, columns), product = A.topRows(rows) * B, before = C.topRows(rows);
          const auto found = [&](detail::Strided of_B, detail::Into into) {
            Matrix result = C;
            kernels.product(A.data(), rows + 2, of_B, result.data(), rows + 2, rows, inner, columns, into);
            EXPECT_EQ(result.bottomRows(2), C.bottomRows(2));
            return Matrix(result.topRows(rows));
          };
          const auto plain = detail::columns_of(B.data(), inner), turned = detail::transposed(by_rows.data(), columns);
          EXPECT_CLOSE(found(plain, detail::Into::only), product, 1e-13);
          EXPECT_CLOSE(found(turned, detail::Into::only), product, 1e-13);
          EXPECT_CLOSE(found(plain, detail::Into::plus), before + product, 1e-13);
          EXPECT_CLOSE(found(turned, detail::Into::minus), before - product, 1e-13);
        }
  });
}

/// S = 1e16 · 11ᵀ + R, whose second pivot is drowned in the rounding of S: it is augmented, by so much that the result
/// is a covariance; a negative one is refused.
TEST(Kernels, ADrownedPivotIsLifted) {
  with_each_instruction_set([](const detail::Kernels& kernels) {
    Matrix P = Matrix::Constant(2, 2, 1e16), S(2, 2), x = Matrix::Zero(2, 1), residual = x;
    Matrix R = 1e-3 * Matrix::Identity(2, 2);
    detail::InnovationView innovation{residual.data(), S.data()};
    const auto update = [&] {
      Matrix mean = x, result = P;
      const Outcome outcome = kernels.update(nullptr, 2, {x.data(), P.data(), 2}, {x.data(), R.data(), 2},
                                             {mean.data(), result.data(), 2}, innovation);
      EXPECT_EQ(std::memcmp(result.data(), P.data(), sizeof(double) * 4) == 0, outcome != Outcome::done);
      return outcome;
    };
    EXPECT_EQ(update(), Outcome::done);
    EXPECT_EQ(S(0, 0), 1e16 * (1.0 + 128.0 * std::numeric_limits<double>::epsilon()));
    EXPECT_EQ(S(1, 0), 1e16);
    P(0, 1) = P(1, 0) = 2e16;
    EXPECT_EQ(update(), Outcome::not_positive_definite);
    P(0, 0) = not_a_number;
    EXPECT_EQ(update(), Outcome::estimate_not_finite);
    R(1, 1) = infinity;
    EXPECT_EQ(update(), Outcome::measurement_not_finite);
  });
}

/// The logarithm of a determinant that no number holds.
TEST(Kernels, LikelihoodsOfTheSmallestAndTheGreatestSpreads) {
  with_each_instruction_set([](const detail::Kernels& kernels) {
    for (const double spread : {1e-220, 1e220}) {
      Matrix S = spread * Matrix::Identity(3, 3), inverse(3, 3), residual = Matrix::Zero(3, 1);
      detail::InnovationView innovation{residual.data(), S.data()};
      ASSERT_EQ(kernels.score({residual.data(), S.data(), 3}, innovation, inverse.data()), Outcome::done);
      EXPECT_NEAR(innovation.log_likelihood, -1.5 * std::log(2.0 * std::numbers::pi) - 1.5 * std::log(spread), 1e-9);
    }
  });
}

}  // namespace kernels_test
