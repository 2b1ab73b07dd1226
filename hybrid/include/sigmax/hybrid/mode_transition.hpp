#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <sigmax/core/compose.hpp>
#include <sigmax/core/condition.hpp>
#include <sigmax/core/relation.hpp>

namespace sigmax {

/// Rates at which modes leave for each other, per second: q_ij ≥ 0 for i ≠ j, every row sums to zero.
using Rates = std::vector<std::vector<double>>;

/// The rates of modes that last `mean_sojourns` seconds on average and leave for every other mode alike; a mode of
/// infinite sojourn is never left. Throws std::invalid_argument unless every time is positive and there are two modes.
inline Rates rates_of_sojourns(const std::vector<double>& mean_sojourns) {
  const std::size_t n = mean_sojourns.size();
  if (n < 2) throw std::invalid_argument("mean sojourn times are needed of two modes or more");
  Rates rates(n, std::vector<double>(n));
  for (std::size_t i = 0; i < n; ++i) {
    if (!(mean_sojourns[i] > 0.0))
      throw std::invalid_argument("the mean sojourn time of mode " + std::to_string(i) + " is " +
                                  std::to_string(mean_sojourns[i]) + " s; expected a positive one");
    for (std::size_t j = 0; j < n; ++j)
      rates[i][j] = i == j ? -1.0 / mean_sojourns[i] : 1.0 / (mean_sojourns[i] * static_cast<double>(n - 1));
  }
  return rates;
}

/// The transition of a mode over any time step, of a mode that jumps in continuous time with rates Q.
///
///     const TimedTransition transition{mode, rates_of_sojourns({20.0, 5.0})};
///     transition(0.2);   // p(r_k | r_{k−1}), or π(r_k | r_{k−1}), for a step of 0.2 s
///
/// Every row is that of P(Δt) = exp(QΔt), conditioned by the mode's own ⊕. For a random mode that is P(Δt) itself,
/// (49), and P(s + t) = P(t) ∘ P(s). For a fuzzy mode, (50), it is P(Δt) on the ratio scale, (34): the best-reachable
/// mode has possibility one, the others how likely they are beside it. Then Π(t) ∘ Π(s) is not Π(s + t): max takes the
/// best of the ways that a sum adds up. A family with unit diagonal that obeys this law cannot depend on Δt at all: see
/// `closure`.
///
/// P is found by uniformisation: no number is subtracted, so none is negative, and j is possible after i whenever some
/// chain of jumps leads there.
template <ScalableUncertainty Kind>
  requires ScalingAlgebra<AlgebraOf<Kind>>
class TimedTransition {
 public:
  using kind = Kind;

  /// Throws std::invalid_argument unless there is a row and a column of finite rates for each mode. No rate off the
  /// diagonal is negative, and every row sums to zero to within 1e-9 of its diagonal.
  TimedTransition(Variable<Kind> mode, const Rates& rates) : mode_(std::move(mode)), jump_(mode_.size(), mode_.size()) {
    const std::size_t n = mode_.size();
    check::size(mode_, {}, rates.size());
    for (std::size_t i = 0; i < n; ++i) {
      check::size(mode_, {&mode_, i}, rates[i].size());
      double sum = 0.0;
      for (std::size_t j = 0; j < n; ++j) {
        if (!std::isfinite(rates[i][j]) || (i != j && rates[i][j] < 0.0)) refuse(i, j, rates[i][j]);
        sum += rates[i][j];
      }
      if (!(std::abs(sum) <= 1e-9 * std::abs(rates[i][i]))) refuse(i, i, rates[i][i]);
      greatest_rate_ = std::max(greatest_rate_, -rates[i][i]);
    }
    // U = I + Q/Λ: the jumps of a process that jumps Λ times per second, and may jump to where it is.
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        jump_(i, j) = (i == j ? 1.0 : 0.0) + (greatest_rate_ > 0.0 ? rates[i][j] / greatest_rate_ : 0.0);
  }

  const Variable<Kind>& mode() const { return mode_; }

  /// The transition over `dt` ≥ 0 seconds; the identity if that is zero.
  Relation<Kind, Kind> operator()(double dt) const {
    Table identity(mode_.size(), mode_.size());
    for (std::size_t i = 0; i < mode_.size(); ++i) identity(i, i) = AlgebraOf<Kind>::one();
    Relation<Kind, Kind> result{mode_, mode_, std::move(identity), detail::ByLaw{}};
    (*this)(dt, result);
    return result;
  }

  /// The same, written into an existing relation of the mode to itself; up to four modes nothing is allocated.
  /// Throws std::invalid_argument if dt is negative or not finite, or the relation is of another variable.
  void operator()(double dt, Relation<Kind, Kind>& result) const {
    check::same(mode_, result.to(), "TimedTransition");
    check::same(mode_, result.from(), "TimedTransition");
    if (!(dt >= 0.0 && std::isfinite(dt)))
      throw std::invalid_argument("a transition over " + std::to_string(dt) +
                                  " s; expected a finite time that is not negative");
    // Λ dt = a · 2^doublings with a < ½, without overflow.
    int rate_exponent = 0, time_exponent = 0;
    const double mantissas = std::frexp(greatest_rate_, &rate_exponent) * std::frexp(dt, &time_exponent);
    const int doublings = std::max(0, rate_exponent + time_exponent + 1);
    const double a = std::ldexp(mantissas, rate_exponent + time_exponent - doublings);

    Table& P = as_table(result.rows(detail::ByLaw{}));
    Table product(0, 0);
    sum_of_jumps(a, P, product);
    for (int k = 0; k < doublings; ++k) {
      kernels::compose<Sigma>(P, P, product);
      std::swap(P, product);
      for (std::size_t i = 0; i < P.rows(); ++i) condition<Sigma>(P.row(i));
    }
    for (std::size_t i = 0; i < P.rows(); ++i) condition<AlgebraOf<Kind>>(P.row(i));
  }

 private:
  /// P = e^{−a} Σ_k a^k/k! U^k by Horner's scheme; dividing each row by its sum stands for e^{−a}. As many terms as
  /// modes, so that every chain of jumps is among them, and seventeen, after which a < ½ leaves less than rounding.
  void sum_of_jumps(double a, Table& P, Table& product) const {
    const std::size_t n = mode_.size();
    P.reshape(n, n);
    const auto add_identity = [&](double factor) {
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) P(i, j) = factor * P(i, j) + (i == j ? 1.0 : 0.0);
    };
    std::fill_n(P.data(), P.size(), 0.0);
    add_identity(0.0);
    for (std::size_t k = n + 17; k > 0; --k) {
      kernels::compose<Sigma>(jump_, P, product);
      std::swap(P, product);
      add_identity(a / static_cast<double>(k));
    }
    for (std::size_t i = 0; i < n; ++i) condition<Sigma>(P.row(i));
  }

  [[noreturn]] void refuse(std::size_t from, std::size_t to, double rate) const {
    throw std::invalid_argument(
        "the rate of '" + mode_.name() + "' from '" + mode_.label(from) + "' to '" + mode_.label(to) + "' is " +
        std::to_string(rate) +
        (from == to ? "; expected minus the sum of the others" : "; expected a finite number that is not negative"));
  }

  Variable<Kind> mode_;
  Table jump_;
  double greatest_rate_ = 0.0;
};

/// The least transition not below `transition` that composes with itself to itself: π_ij becomes the possibility of the
/// best chain of jumps from i to j.
///
/// Its result serves every Δt > 0 alike, and under max nothing else can. A family Π(s + t) = Π(t) ∘ Π(s) in which
/// staying is always fully possible, π_ii(t) = 1, cannot decrease with t; of M modes the best chain has at most M − 1
/// jumps, so Π(t) = Π(t/M)^M = Π(t/M)^2M = Π(2t), hence Π is one constant. Two modes with a unit diagonal are their own
/// closure. Throws std::invalid_argument if a possibility on the diagonal is not one.
template <ScalableUncertainty Kind>
  requires SelectiveAlgebra<AlgebraOf<Kind>> Relation<Kind, Kind> closure(Relation<Kind, Kind> transition) {
    check::same(transition.from(), transition.to(), "closure");
    const std::size_t n = transition.to().size();
    for (std::size_t i = 0; i < n; ++i)
      if (transition(i, i) != AlgebraOf<Kind>::one())
        throw std::invalid_argument("a closure needs that staying is fully possible, but '" + transition.to().name() +
                                    "' stays '" + transition.to().label(i) + "' with possibility " +
                                    std::to_string(transition(i, i)));
    for (std::size_t jumps = 1; jumps + 1 < n; jumps *= 2) transition = compose(transition, transition);
    return transition;
  }

}  // namespace sigmax
