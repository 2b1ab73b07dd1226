#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <Eigen/Eigenvalues>

#include <sigmax/estimation/gaussian.hpp>

#include "result/report.hpp"
#include "support/angle.hpp"

namespace sigmax::apps {

/// Where a position in plan lies with a probability of 95 %, if it is normal with this covariance.
inline ErrorEllipse error_ellipse(std::string group, const Vector<2>& centre, const SquareMatrix<2>& covariance) {
  const double chi_square = -2.0 * std::log(0.05);  // the 95 % quantile with two degrees of freedom
  const Eigen::SelfAdjointEigenSolver<SquareMatrix<2>> parts(covariance);
  const Vector<2> axis = parts.eigenvectors().col(1);
  return {std::move(group),
          centre.x(),
          centre.y(),
          std::sqrt(chi_square * std::max(0.0, parts.eigenvalues()(1))),
          std::sqrt(chi_square * std::max(0.0, parts.eigenvalues()(0))),
          std::atan2(axis.y(), axis.x()) / degree};
}

}  // namespace sigmax::apps
