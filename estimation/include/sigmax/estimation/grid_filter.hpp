#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <sigmax/core/compose.hpp>
#include <sigmax/core/update.hpp>
#include <sigmax/estimation/grid_transition.hpp>

namespace sigmax {

/// How a grid filter trades accuracy for work.
struct GridOptions {
  /// What is below this part of the greatest number is dropped: of a belief, and of each row of a transition.
  double negligible = 1e-12;
  /// Least number of cells per axis across the non-negligible part; up to four times as many are left alone. Zero
  /// stands for 400 on a line, 60 in the plane and 20 in space.
  Eigen::Index cells = 0;
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
/// by about exp(−2π²σ²/h²) at each step. A maximum is refined by the parabola through the best cell and its neighbours,
/// so it is exact where the logarithm is one. Each row of the transition is normalised by its own ⊕ over the cells, see
/// `grid_transition`. The grid follows the belief: it is made finer where it is evaluated anew, see `adapt`.
template <Uncertainty Kind, int N>
class GridFilter {
 public:
  /// Starts from a belief in proportion to exp(log_weight(x)) at the cells' centres x.
  /// Throws std::invalid_argument if a weight is not a number below infinity or an option makes no sense,
  /// std::domain_error if every cell is excluded.
  template <class LogWeight>
  GridFilter(Grid<N> grid, const LogWeight& log_weight, GridOptions options = {})
      : options_(with_cells(options)),
        grid_(finer(std::move(grid), options_)),
        belief_(uninformative(cells_of(grid_))) {
    if (!(options.negligible > 0.0 && options.negligible < 1.0) || options.cells < 0 || options.most < 1)
      throw std::invalid_argument("a grid filter needs a negligible part between 0 and 1, and cells");
    update(log_weight);
  }

  const Grid<N>& grid() const { return grid_; }

  /// The probability or possibility of each cell.
  const Distribution<Kind>& belief() const { return belief_; }

  /// Prediction, (23) or (36), of x_k = f(x_{k−1}) + w with w ~ N(0, Q), or as possible as that on the ratio scale.
  /// The prediction has at least the cells wanted; before a sum, cells are cut until they are no wider than the noise.
  /// Throws std::domain_error if Q is not positive definite or f(x) is not finite, std::length_error if the prediction
  /// would need more than ten times the cells allowed.
  template <class Dynamics>
  void predict(const Dynamics& f, const SquareMatrix<N>& Q) {
    const GridNoise<N> noise(Q, options_.negligible);
    crop();
    constexpr double any = std::numeric_limits<double>::infinity();
    for (Eigen::Index axis = 0; axis < N; ++axis) {
      const double width = noise.widths()(axis);
      resize(axis, std::min<Eigen::Index>(options_.cells, fewest), selective ? any : width, width);
    }
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
    const Grid<N> to = finer(grid_.window(first, last), options_);  // rather than halves of the belief's own cells
    Suprema suprema(selective ? to.size() : 0);
    const auto fill = [&](const Grid<N>&, std::size_t i, GridRow& row) {
      if (belief_[i] == 0.0) {
        row.add(0, 0.0);  // any row will do: nothing is there to be moved
        return;
      }
      noise.fill(to, means[i], row);
      if constexpr (selective) suprema.note(i, std::log(belief_[i]), row);
    };
    if constexpr (selective) {
      const Grid<N> from = grid_;
      const Distribution<Kind> before = belief_;
      move(to, fill);
      refine(
          suprema,
          [&](const typename Grid<N>::Lattice& place, std::size_t j) {
            const auto offset = (place - from.first()).array();
            if ((offset < 0).any() || (offset >= from.extent().array()).any()) return log_zero;
            const std::size_t i = from.cell(place);
            return before[i] == 0.0 ? log_zero : std::log(before[i]) + noise.log(to.centre(j) - means[i]);
          },
          from);
    } else {
      move(to, fill);
    }
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
  /// the greater step. `predict` needs no cells cut; a state that does not move needs this called.
  void adapt(const Vector<N>& widest = Vector<N>::Constant(std::numeric_limits<double>::infinity())) {
    crop();
    for (Eigen::Index axis = 0; axis < N; ++axis) resize(axis, options_.cells, widest(axis), widest(axis));
  }

  /// The centre of the most probable or most possible cell.
  Vector<N> most_likely() const { return grid_.centre(index_of_greatest(belief_.values())); }

  /// Mean and covariance of the belief; if the state is fuzzy, of the density in proportion to it, (35).
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
  static constexpr bool selective = SelectiveAlgebra<AlgebraOf<Kind>>;
  static constexpr Eigen::Index fewest = 8;  // below, a belief is no curve any more

  /// For each cell of a prediction the cell from which it is most possible.
  struct Suprema {
    std::vector<double> logs;
    std::vector<std::size_t> winners;

    explicit Suprema(std::size_t size) : logs(size, log_zero), winners(size, 0) {}
    void note(std::size_t i, double log_belief, GridRow& row) {
      for (std::size_t k = 0; k < row.cells().size(); ++k) {
        const double log = log_belief + row.numbers()[k];
        if (log <= logs[row.cells()[k]]) continue;
        logs[row.cells()[k]] = log;
        winners[row.cells()[k]] = i;
      }
    }
  };

  /// The supremum over states lies between the centres of cells: the vertex of the parabola through the best of them
  /// and its neighbours. `log(place, j)` is that of moving from a cell to j, −∞ outside.
  template <class Log>
  void refine(const Suprema& suprema, const Log& log, const Grid<N>& from) {
    using Lattice = typename Grid<N>::Lattice;
    std::vector<double> logs = suprema.logs;
    for (std::size_t j = 0; j < logs.size(); ++j) {
      if (logs[j] == log_zero) continue;
      const Lattice best = from.place(suprema.winners[j]);
      Vector<N> g;
      SquareMatrix<N> H;
      for (Eigen::Index a = 0; a < N; ++a) {
        const Lattice step = Lattice::Unit(a);
        const double up = log(best + step, j), down = log(best - step, j);
        g(a) = 0.5 * (up - down);
        H(a, a) = 2.0 * logs[j] - up - down;
        for (Eigen::Index b = 0; b < a; ++b) {
          const Lattice other = Lattice::Unit(b);
          H(a, b) = H(b, a) = 0.25 * (log(best + step - other, j) + log(best - step + other, j) -
                                      log(best + step + other, j) - log(best - step - other, j));
        }
      }
      if (!g.allFinite() || !H.allFinite()) continue;  // at the border
      SquareMatrix<N> root;
      if (!detail::cholesky_factor(H.data(), N, root.data())) continue;
      Vector<N> vertex = g;
      detail::solve_by_root(root.data(), N, vertex.data());
      if (vertex.cwiseAbs().maxCoeff() <= 1.0) logs[j] += 0.5 * g.dot(vertex);
    }
    const double greatest = *std::max_element(logs.begin(), logs.end());
    for (double& each : logs) each = std::exp(each - greatest);
    belief_ = normalized(belief_.variable(), logs);
  }

  static GridOptions with_cells(GridOptions options) {
    if (options.cells == 0) options.cells = N == 1 ? 400 : N == 2 ? 60 : 20;
    return options;
  }

  /// The same box with at least the cells wanted.
  static Grid<N> finer(Grid<N> grid, const GridOptions& options) {
    for (Eigen::Index axis = 0; axis < N; ++axis)
      while (grid.extent()(axis) < options.cells && 2 * grid.size() <= options.most) grid = grid.halved(axis);
    return grid;
  }

  /// Halves cells along an axis while there are fewer than `least`, or they are wider than `widest`. Joins pairs while
  /// there are more than four times as many as wanted, and they stay below `widest_joined`.
  void resize(Eigen::Index axis, Eigen::Index least, double widest, double widest_joined) {
    using Lattice = typename Grid<N>::Lattice;
    while ((grid_.extent()(axis) < least || grid_.step()(axis) > widest) && 2 * grid_.size() <= options_.most)
      move(grid_.halved(axis), [&](const Grid<N>& to, std::size_t i, GridRow& row) {
        Lattice place = grid_.place(i);
        place(axis) *= 2;
        row.add(to.cell(place), 0.0);
        ++place(axis);
        row.add(to.cell(place), 0.0);
      });
    while (grid_.extent()(axis) > 4 * options_.cells && 2.0 * grid_.step()(axis) <= widest_joined)
      move(grid_.doubled(axis), [&](const Grid<N>& to, std::size_t i, GridRow& row) {
        Lattice place = grid_.place(i);
        place(axis) = Grid<N>::half(place(axis));
        row.add(to.cell(place), 0.0);
      });
  }

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
