#include <sigmax/estimation/covariance_root.hpp>

#include <gtest/gtest.h>

#include <limits>

#include "support/matrices.hpp"
#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::dense;
using support::fixed;
using support::generated;
using support::generated_covariance;
using support::holds;
using support::require_near_matrix;
using support::throws;

TEST(CovarianceRoot, IsCholeskys) {
  EXPECT_EQ(detail::covariance_root(SquareMatrix<2>{{4, 2}, {2, 10}}, "m"), (SquareMatrix<2>{{2, 0}, {1, 3}}));
}

TEST(CovarianceRoot, ItsSquareIsTheCovariance) {
  holds([] {
    const auto P = generated_covariance(5);
    const SquareMatrix<5> L = detail::covariance_root(fixed<5, 5>(P), "m");
    require_near_matrix(L, SquareMatrix<5>(L.triangularView<Eigen::Lower>()), 0.0);
    require_near_matrix(L * L.transpose(), P, 1e-13);
    const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 9, 9> run_time = fixed<5, 5>(P);
    require_near_matrix(detail::covariance_root(run_time, "m"), dense(L), 0.0);
  });
}

TEST(CovarianceRoot, OfASingularCovarianceExists) {
  holds([] {  // rank 2 of 4
    const auto A = generated(4, 2);
    const auto P = restatement::symmetrised(A * restatement::transposed(A));
    const SquareMatrix<4> L = detail::covariance_root(fixed<4, 4>(P), "m");
    require_near_matrix(L * L.transpose(), P, 1e-6);
  });
  EXPECT_EQ(detail::covariance_root(SquareMatrix<2>{{0, 0}, {0, 9}}, "m"), (SquareMatrix<2>{{0, 0}, {0, 3}}));
  EXPECT_EQ(detail::covariance_root(SquareMatrix<3>::Zero().eval(), "m"), SquareMatrix<3>::Zero());
}

TEST(CovarianceRoot, RefusesWhatIsNoCovarianceAndNamesTheModel) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const SquareMatrix<2>& P :
       {SquareMatrix<2>{{1, 2}, {2, 1}}, SquareMatrix<2>{{0, 1}, {1, 1}}, SquareMatrix<2>{{1, 0}, {0, -1e-9}},
        SquareMatrix<2>{{1, 0}, {0, std::nan("")}}, SquareMatrix<2>{{1, 0}, {0, infinity}}})
    EXPECT_TRUE(throws<std::domain_error>([&] { detail::covariance_root(P, "dwna"); },
                                          {"covariance", "dwna", "not positive semi-definite", "component 2"}));
}

}  // namespace
}  // namespace sigmax
