#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/LU>

#include <sigmax/core/compose.hpp>
#include <sigmax/core/update.hpp>
#include <sigmax/estimation/grid_transition.hpp>

namespace sigmax {

/// How a grid filter trades accuracy for work.
struct GridOptions {
  /// What is below this part of the greatest number is dropped: of a belief, and of each row of a transition.
  double negligible = 1e-12;
  /// Cells along each axis that what is not negligible shall at least have; up to four times as many are left alone.
  Eigen::Index cells = 50;
  /// Cells that the grid may have in all.
  std::size_t most = 100000;
};

/// The point-mass filter: the state is a cell of a grid, an outcome of a variable, so prediction is `compose` and
/// measurement is `update`. For a random state they are Bayes' filter, (23) and (24); for a fuzzy state max inference,
/// (36) and (37). The state's kind is the only difference.
///
///     GridFilter<Fuzzy, 1> filter{Grid<1>{lower, upper, step}, [](const Vector<1>& x) { return -0.5 * x(0) * x(0); }};
///     filter.predict([](const Vector<1>& x) { return Vector<1>{0.9 * x(0)}; }, Q);   // x_k = f(x_{k−1}) + w
///     filter.update([&](const Vector<1>& x) { return -0.5 * square(z - x(0)) / R; });
///
/// A belief is a number for each cell's centre. With cells of h, a sum over centres of a Gaussian of deviation σ is off
/// by about exp(−2π²σ²/h²), a maximum by up to h²/8σ² in its logarithm, at each step; σ is at most that of the noise
/// and, after `adapt`, at least h. Each row of the transition is normalised by its own ⊕ over the cells, see
/// `grid_transition`. The grid follows the belief, see `adapt`.
template <Uncertainty Kind, int N>
class GridFilter {
 public:
  /// Starts from a belief in proportion to exp(log_weight(x)) at the cells' centres x.
  /// Throws std::invalid_argument if a weight is not a number below infinity or an option makes no sense,
  /// std::domain_error if every cell is excluded.
  template <class LogWeight>
  GridFilter(Grid<N> grid, const LogWeight& log_weight, GridOptions options = {})
      : options_(options), grid_(std::move(grid)), belief_(uninformative(cells_of(grid_))) {
    if (!(options.negligible > 0.0 && options.negligible < 1.0) || options.cells < 1 || options.most < 1)
      throw std::invalid_argument("a grid filter needs a negligible part between 0 and 1, and cells");
    update(log_weight);
  }

  const Grid<N>& grid() const { return grid_; }

  /// The probability or possibility of each cell.
  const Distribution<Kind>& belief() const { return belief_; }

  /// Prediction, (23) or (36), of x_k = f(x_{k−1}) + w with w ~ N(0, Q), or as possible as that on the ratio scale.
  /// Adapts the grid first, to cells no wider than the noise.
  /// Throws std::domain_error if Q is not positive definite or f(x) is not finite, std::length_error if the prediction
  /// would need more than ten times the cells allowed.
  template <class Dynamics>
  void predict(const Dynamics& f, const SquareMatrix<N>& Q) {
    const GridNoise<N> noise(Q, options_.negligible);
    adapt(noise.widths());
    std::vector<Vector<N>> means(grid_.size());
    typename Grid<N>::Lattice first, last;
    first.setConstant(std::numeric_limits<Eigen::Index>::max());
    last.setConstant(std::numeric_limits<Eigen::Index>::min());
    for (std::size_t i = 0; i < means.size(); ++i) {
      if (belief_[i] == 0.0) continue;
      means[i] = f(grid_.centre(i));
      if (!((means[i] - grid_.centre(i)).cwiseAbs().cwiseQuotient(grid_.step()).maxCoeff() < 1e9))
        throw std::domain_error("a grid filter's f(x) is not finite, or 1e9 cells away");
      first = first.cwiseMin(grid_.place_of(means[i] - noise.reach()));
      last = last.cwiseMax(grid_.place_of(means[i] + noise.reach()));
    }
    const double cells = (last - first).template cast<double>().array().operator+(1.0).prod();
    if (!(cells <= 10.0 * static_cast<double>(options_.most)))
      throw std::length_error("a prediction needs a grid of " + std::to_string(cells) + " cells; " +
                              std::to_string(options_.most) + " are allowed");
    move(grid_.window(first, last), [&](const Grid<N>& to, std::size_t i, GridRow& row) {
      if (belief_[i] == 0.0)
        row.add(0, 0.0);  // any row will do: nothing is there to be moved
      else
        noise.fill(to, means[i], row);
    });
  }

  /// Measurement, (24) or (37): multiplies by exp(log_likelihood(x)) and normalises. Returns the logarithm of the ⊕ by
  /// which it divided: log p(z) if the likelihood is a density, or how possible z was.
  /// Throws std::invalid_argument if a likelihood is not a number below infinity, std::domain_error if the evidence
  /// excludes every cell.
  template <class LogLikelihood>
  double update(const LogLikelihood& log_likelihood) {
    Likelihood<Kind> likelihood{belief_.variable()};
    for (std::size_t i = 0; i < belief_.size(); ++i)
      if (belief_[i] > 0.0) likelihood.set_log(i, log_likelihood(grid_.centre(i)));
    Belief<Kind> posterior{belief_};
    const double log_evidence = sigmax::update(posterior, likelihood, posterior);
    belief_ = posterior.distribution();
    return log_evidence;
  }

  /// Lets the grid follow the belief. Negligible cells are excluded and the box shrinks to the rest; then, axis by
  /// axis, cells are cut into two while there are too few, or while they are wider than `widest`; or joined in pairs
  /// while there are more than four times as many as wanted, if twice their width is not above `widest`.
  ///
  /// Two cells share equally what the one had: each half of its probability, or all of its possibility. A joint cell
  /// has the ⊕ of both. That is exact for a belief constant within cells; to the variance it adds about H²/16, with H
  /// the greater step. `predict` calls this; a state that does not move needs it called.
  void adapt(const Vector<N>& widest = Vector<N>::Constant(std::numeric_limits<double>::infinity())) {
    crop();
    for (Eigen::Index axis = 0; axis < N; ++axis) {
      while ((grid_.extent()(axis) < options_.cells || grid_.step()(axis) > widest(axis)) &&
             2 * grid_.size() <= options_.most)
        move(grid_.halved(axis), [&](const Grid<N>& to, std::size_t i, GridRow& row) {
          typename Grid<N>::Lattice place = grid_.place(i);
          place(axis) *= 2;
          row.add(to.cell(place), 0.0);
          ++place(axis);
          row.add(to.cell(place), 0.0);
        });
      while (grid_.extent()(axis) > 4 * options_.cells && 2.0 * grid_.step()(axis) <= widest(axis))
        move(grid_.doubled(axis), [&](const Grid<N>& to, std::size_t i, GridRow& row) {
          typename Grid<N>::Lattice place = grid_.place(i);
          place(axis) = Grid<N>::half(place(axis));
          row.add(to.cell(place), 0.0);
        });
    }
  }

  /// The centre of the most probable or most possible cell.
  Vector<N> most_likely() const { return grid_.centre(index_of_greatest(belief_.values())); }

  /// Mean and covariance of the belief; of a fuzzy state those of the density in proportion to it, (35).
  Gaussian<N> moments() const {
    double sum = 0.0;
    Gaussian<N> result{Vector<N>::Zero(), SquareMatrix<N>::Zero()};
    const Vector<N> origin = most_likely();
    for (std::size_t i = 0; i < belief_.size(); ++i) {
      const Vector<N> x = grid_.centre(i) - origin;
      sum += belief_[i];
      result.mean += belief_[i] * x;
      result.covariance += belief_[i] * x * x.transpose();
    }
    result.mean /= sum;
    result.covariance = (result.covariance / sum - result.mean * result.mean.transpose()).eval();
    result.mean += origin;
    return result;
  }

 private:
  static Variable<Kind> cells_of(const Grid<N>& grid) { return {"cell", grid.size()}; }

  /// The belief on another grid; fill(to, i, row) adds where cell i goes.
  template <class Fill>
  void move(const Grid<N>& to, const Fill& fill) {
    const auto transition = grid_transition<Kind>(to, cells_of(to), belief_.variable(), options_.negligible, fill);
    belief_ = compose(transition, belief_);
    grid_ = to;
  }

  void crop() {
    const double least = options_.negligible * *std::max_element(belief_.values().begin(), belief_.values().end());
    typename Grid<N>::Lattice first = grid_.place(index_of_greatest(belief_.values())), last = first;
    for (std::size_t i = 0; i < belief_.size(); ++i)
      if (belief_[i] >= least) {
        first = first.cwiseMin(grid_.place(i));
        last = last.cwiseMax(grid_.place(i));
      }
    const Grid<N> window = grid_.window(first, last);
    std::vector<double> left(window.size());
    for (std::size_t i = 0; i < left.size(); ++i) {
      const double number = belief_[grid_.cell(window.place(i))];
      left[i] = number >= least ? number : 0.0;
    }
    belief_ = normalized(cells_of(window), left);
    grid_ = window;
  }

  GridOptions options_;
  Grid<N> grid_;
  Distribution<Kind> belief_;
};

}  // namespace sigmax
