#include <sigmax/hybrid/cross_validation.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <Eigen/Cholesky>

namespace sigmax {

RowFolds folds_of(std::span<const std::size_t> rows, std::size_t folds) {
  const bool whole = rows.size() >= 2 * folds;
  RowFolds result;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    auto& own = result.emplace_back(rows[r]);
    for (std::size_t k = 0; k < rows[r]; ++k) own[k] = whole ? r % folds : k * folds / rows[r];
  }
  return result;
}

RowLosses held_out(const RowFolds& folds, std::span<const RowLosses> without) {
  RowLosses result;
  for (std::size_t r = 0; r < folds.size(); ++r) {
    auto& own = result.emplace_back(folds[r].size());
    for (std::size_t k = 0; k < own.size(); ++k) own[k] = without[folds[r][k]][r][k];
  }
  return result;
}

double mean_loss(const RowLosses& losses, const RowCounts& counts) {
  double sum = 0.0;
  std::size_t rows = 0;
  for (std::size_t r = 0; r < losses.size(); ++r)
    for (std::size_t k = 0; k < losses[r].size(); ++k) {
      if (std::isnan(losses[r][k]) || (counts && !counts(r, k))) continue;
      sum += losses[r][k];
      ++rows;
    }
  return sum / static_cast<double>(rows);
}

MeanDifference mean_difference(const RowLosses& a, const RowLosses& b) {
  constexpr std::ptrdiff_t most_blocks = 20;
  std::vector<double> differences;
  for (std::size_t r = 0; r < a.size(); ++r)
    for (std::size_t k = 0; k < a[r].size(); ++k)
      if (!std::isnan(a[r][k]) && !std::isnan(b[r][k])) differences.push_back(a[r][k] - b[r][k]);
  const auto rows = std::ssize(differences), blocks = std::min(most_blocks, rows);
  if (rows == 0) return {};
  const Eigen::Map<const Eigen::ArrayXd> apart(differences.data(), rows);
  const double mean = apart.mean();
  double squares = 0.0;
  for (std::ptrdiff_t block = 0; block < blocks; ++block) {
    const auto from = block * rows / blocks, to = (block + 1) * rows / blocks;
    const double sum = (apart.segment(from, to - from) - mean).sum();
    squares += sum * sum;
  }
  const double more = static_cast<double>(blocks) / static_cast<double>(std::max<std::ptrdiff_t>(blocks - 1, 1));
  return {mean, blocks > 1 ? std::sqrt(squares * more) / static_cast<double>(rows) : 0.0};
}

Selected select_settings(std::span<const RowLosses> held_out, std::span<const std::size_t> numbers) {
  if (held_out.empty() || held_out.size() != numbers.size())
    throw std::invalid_argument(std::to_string(numbers.size()) + " numbers of fitted numbers for " +
                                std::to_string(held_out.size()) + " settings; expected one each, and some");
  std::vector<double> means;
  for (const RowLosses& losses : held_out) means.push_back(mean_loss(losses));
  Selected selected;
  for (std::size_t i = 1; i < means.size(); ++i)
    if (means[i] < means[selected.best]) selected.best = i;
  selected.simple = selected.best;
  for (std::size_t i = 0; i < means.size(); ++i) {
    const MeanDifference worse = mean_difference(held_out[i], held_out[selected.best]);
    if (numbers[i] < numbers[selected.simple] && worse.mean <= worse.error) selected.simple = i;
  }
  return selected;
}

LossSurface::LossSurface(std::size_t numbers, double step,
                         const std::function<RowLosses(const std::vector<double>&)>& losses)
    : numbers_(numbers), step_(step) {
  std::vector<double> offsets(numbers, 0.0);
  losses_.push_back(losses(offsets));
  for (std::size_t i = 0; i < numbers; ++i)
    for (std::size_t j = i; j < numbers; ++j)
      for (const double side : {step, -step}) {
        offsets[i] = offsets[j] = side;
        losses_.push_back(losses(offsets));
        offsets[i] = offsets[j] = 0.0;
      }
}

LossSurface::Shape LossSurface::shape(const RowCounts& counts, std::size_t together) const {
  const auto n = static_cast<Eigen::Index>(numbers_);
  std::vector<double> sums(losses_.size(), 0.0);
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(n), sum = slope;
  std::size_t added = 0;
  Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(n, n), curvature(n, n);
  const auto place = [&](Eigen::Index i, Eigen::Index j) {  // of the upper triangle, row by row
    return static_cast<std::size_t>(1 + 2 * (i * n - i * (i - 1) / 2 + j - i));
  };
  for (std::size_t r = 0; r < losses_[0].size(); ++r)
    for (std::size_t k = 0; k < losses_[0][r].size(); ++k) {
      if (std::isnan(losses_[0][r][k]) || (counts && !counts(r, k))) continue;
      for (std::size_t s = 0; s < losses_.size(); ++s) sums[s] += losses_[s][r][k];
      for (Eigen::Index i = 0; i < n; ++i)
        slope[i] += (losses_[place(i, i)][r][k] - losses_[place(i, i) + 1][r][k]) / (2.0 * step_);
      if (++added % together > 0) continue;
      sum += slope;
      squares += slope * slope.transpose();
      slope.setZero();
    }
  sum += slope;
  squares += slope * slope.transpose();
  const auto bend = [&](Eigen::Index i, Eigen::Index j) {
    return sums[place(i, j)] + sums[place(i, j) + 1] - 2.0 * sums[0];
  };
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = i; j < n; ++j)
      curvature(i, j) = curvature(j, i) =
          (i == j ? bend(i, i) : 0.5 * (bend(i, j) - bend(i, i) - bend(j, j))) / (step_ * step_);

  Shape result{std::vector<double>(numbers_, 0.0),
               std::vector<double>(numbers_, std::numeric_limits<double>::infinity()),
               std::vector<std::vector<double>>(numbers_)};
  std::vector<Eigen::Index> told;  // the numbers that the rows tell, all together
  for (Eigen::Index i = 0; i < n; ++i) told.push_back(i);
  while (!told.empty()) {
    const Eigen::LLT<Eigen::MatrixXd> root(curvature(told, told));
    if (root.info() == Eigen::Success && root.rcond() > 1e-10) {
      const Eigen::VectorXd least = -root.solve(sum(told));
      const Eigen::MatrixXd inverse = root.solve(Eigen::MatrixXd::Identity(least.size(), least.size()));
      const Eigen::VectorXd variance = (inverse * squares(told, told) * inverse).diagonal();
      const auto among_all = [&](std::vector<double>& all, const Eigen::VectorXd& numbers) {
        Eigen::Map<Eigen::VectorXd>(all.data(), n)(told) = numbers;
      };
      among_all(result.least, least.cwiseMax(-4.0 * step_).cwiseMin(4.0 * step_));
      among_all(result.error, variance.cwiseSqrt());
      for (Eigen::Index i = 0; i < least.size(); ++i) {
        auto& ridge = result.ridges[static_cast<std::size_t>(told[static_cast<std::size_t>(i)])];
        ridge.assign(numbers_, 0.0);
        among_all(ridge, inverse.col(i) / inverse(i, i));
      }
      return result;
    }
    told.erase(std::ranges::min_element(told, {}, [&](Eigen::Index i) { return curvature(i, i); }));
  }
  return result;
}

}  // namespace sigmax
