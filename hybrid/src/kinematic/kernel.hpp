/// The four steps of an interacting filter for motions along independent axes, on columns of axes: `C` is the numbers
/// of one track, or of several, along the axes. Included once for each instruction set; everything is private to the
/// file that includes it, since an inline function compiled for one processor must not serve another.

#include <sigmax/hybrid/kinematic_plan.hpp>

#include "kinematic/lanes.hpp"

namespace sigmax::detail::kinematic {
namespace {

template <class C>
using Lane = typename ColumnOf<C>::Lane;
template <class C>
using Real = typename LaneOf<Lane<C>>::Real;
template <class C>
using Mask = MaskOf<Lane<C>>;

/// What differs with the precision.
template <class Number>
struct Precision;
template <>
struct Precision<double> {
  static constexpr double rounding = 256 * 0x1p-52;  ///< n c ε, see docs/robustness.md
  static constexpr double greatest_loss = 1e-10;     ///< of a variance, relatively, to that rounding
  static constexpr double least_weight = 1e-250;
  static constexpr double greatest = 1e290;
};
template <>
struct Precision<float> {
  static constexpr float rounding = 256 * 0x1p-23F;
  static constexpr float greatest_loss = 3e-3F;
  static constexpr float least_weight = 1e-30F;
  static constexpr float greatest = 1e30F;
};

constexpr int at(int a, int b) { return triangle(a) + b; }  // b ≤ a

/// An estimate: a column for each derivative, and for each block (a, b), b ≤ a, of the covariance its columns. The
/// blocks of a model of lower order lead those of one of higher order. Of diagonal blocks see `full`.
template <class C, int A>
struct Estimate {
  C x[max_order];
  C P[triangle(max_order)][A];
};

/// Index of the greatest weight, as a number; see sigmax::select.
template <class V>
V winner(int modes, const V* weight, V current, Tie tie) {
  using Number = typename LaneOf<V>::Real;
  V greatest = weight[0];
  for (int i = 1; i < modes; ++i) greatest = select(weight[i] > greatest, weight[i], greatest);
  const V least = greatest * static_cast<Number>(1.0 - tie_tolerance);
  V result{};
  for (int i = 0; i < modes; ++i) {
    const int place = tie == Tie::last ? i : modes - 1 - i;
    result = select(weight[place] >= least, V{} + static_cast<Number>(place), result);
  }
  if (tie == Tie::stay)
    for (int i = 0; i < modes; ++i) {
      const V index = V{} + static_cast<Number>(i);
      result = select((current == index) & (weight[i] >= least), index, result);
    }
  return result;
}

inline double winner(int modes, const double* weight, double current, Tie tie) {
  double greatest = weight[0];
  for (int i = 1; i < modes; ++i) greatest = weight[i] > greatest ? weight[i] : greatest;
  const double least = greatest * (1.0 - tie_tolerance);
  if (tie == Tie::stay && weight[static_cast<int>(current)] >= least) return current;
  int result = tie == Tie::last ? modes - 1 : 0;
  for (int left = modes - 1; left > 0 && !(weight[result] >= least); --left) result += tie == Tie::last ? -1 : 1;
  return result;
}

template <int Number>
struct Constant {
  static constexpr int value = Number;
};

#define SIGMAX_INLINE inline __attribute__((always_inline))

/// Calls action(Constant<order>) for an order known at run time.
template <class Action>
SIGMAX_INLINE void with_order(int order, const Action& action) {
  if (order == 2)
    action(Constant<2>{});
  else if (order == 3)
    action(Constant<3>{});
  else
    action(Constant<1>{});
}

/// action(a, b, k) for every column of the blocks from derivative `From` on.
template <int A, int Order, class Action>
SIGMAX_INLINE void for_each_column(const Action& action) {
#pragma GCC unroll 8
  for (int a = 0; a < Order; ++a)
#pragma GCC unroll 8
    for (int b = 0; b <= a; ++b)
#pragma GCC unroll 8
      for (int k = 0; k < A; ++k) action(a, b, k);
}

template <int A, int B>
inline constexpr int lesser = A < B ? A : B;

/// What a part of a mixture has for the derivatives from `Shared` on, which it lacks: what the receiver lends by the
/// rule of lifting.
template <class C, int A, int Order, int Shared>
struct Lent {
  const Estimate<C, A>& receiver;
  Lift lift;

  SIGMAX_INLINE C mean(int a) const { return lift == Lift::unbiased ? receiver.x[a] : C{}; }

  /// action(a, b, k, column) for its columns that are not zero.
  template <class Action>
  SIGMAX_INLINE void for_each_column(const Action& action) const {
    if (Shared == Order || lift == Lift::zero) return;
#pragma GCC unroll 8
    for (int a = Shared; a < Order; ++a)
#pragma GCC unroll 8
      for (int k = 0; k < A; ++k) {
        if (lift == Lift::borrowed_variance)
          action(a, a, k, only(k, receiver.P[at(a, a)][k]));
        else
          for (int b = Shared; b <= a; ++b) action(a, b, k, receiver.P[at(a, b)][k]);
      }
  }
};

/// The mixture of all parts by their weights, which sum to one: mean and covariance. Parts are added one by one; a pair
/// with the weights u and w has the spread u w/(u + w) (x − y)(x − y)ᵀ.
template <class C, int A, int Order>
SIGMAX_INLINE void average(const Plan& plan, const Estimate<C, A>* parts, const Estimate<C, A>& receiver,
                           const Lane<C>* weight, Estimate<C, A>& result) {
  using V = Lane<C>;
  V before = weight[0];
  with_order(plan.order[0], [&](auto order) {
    constexpr int Shared = lesser<Order, decltype(order)::value>;
    const Lent<C, A, Order, Shared> lent{receiver, plan.lift};
    for (int a = 0; a < Order; ++a) result.x[a] = a < Shared ? parts[0].x[a] : lent.mean(a);
    for_each_column<A, Order>(
        [&](int a, int b, int k) { result.P[at(a, b)][k] = a < Shared ? before * parts[0].P[at(a, b)][k] : C{}; });
    lent.for_each_column([&](int a, int b, int k, const C& column) { result.P[at(a, b)][k] = before * column; });
  });
  for (int l = 1; l < plan.modes; ++l) {
    const V w = weight[l];
    const V total = before + w;
    const V share = l + 1 == plan.modes ? w : select(total > V{}, w / total, V{});
    const V spread = before * share;
    with_order(plan.order[static_cast<std::size_t>(l)], [&](auto order) {
      constexpr int Shared = lesser<Order, decltype(order)::value>;
      const Lent<C, A, Order, Shared> lent{receiver, plan.lift};
      C difference[Order], scaled[Order];
#pragma GCC unroll 8
      for (int a = 0; a < Order; ++a) {
        difference[a] = (a < Shared ? parts[l].x[a] : lent.mean(a)) - result.x[a];
        scaled[a] = spread * difference[a];
        result.x[a] = result.x[a] + share * difference[a];
      }
      for_each_column<A, Order>([&](int a, int b, int k) {
        C& column = result.P[at(a, b)][k];
        C sum = column + difference[b][k] * scaled[a];
        if (a < Shared) sum = sum + w * parts[l].P[at(a, b)][k];
        column = a == b ? below(k, column, sum) : sum;
      });
      lent.for_each_column(
          [&](int a, int b, int k, const C& column) { result.P[at(a, b)][k] = result.P[at(a, b)][k] + w * column; });
    });
    before = total;
  }
}

/// The part that was selected, over the part `result` holds.
template <class C, int A, int Order>
SIGMAX_INLINE void choose(const Plan& plan, const Estimate<C, A>* parts, const Estimate<C, A>& receiver,
                          Lane<C> selected, Estimate<C, A>& result) {
  for (int l = 0; l < plan.modes; ++l) {
    const auto mask = selected == Lane<C>{} + static_cast<Real<C>>(l);
    if (!any(mask)) continue;
    with_order(plan.order[static_cast<std::size_t>(l)], [&](auto order) {
      constexpr int Shared = lesser<Order, decltype(order)::value>;
      const Lent<C, A, Order, Shared> lent{receiver, plan.lift};
      for (int a = 0; a < Order; ++a)
        result.x[a] = select(mask, a < Shared ? parts[l].x[a] : lent.mean(a), result.x[a]);
      for_each_column<A, Order>([&](int a, int b, int k) {
        C& column = result.P[at(a, b)][k];
        column = select(mask, a < Shared ? parts[l].P[at(a, b)][k] : C{}, column);
      });
      lent.for_each_column([&](int a, int b, int k, const C& column) {
        result.P[at(a, b)][k] = select(mask, column, result.P[at(a, b)][k]);
      });
    });
  }
}

/// The mixed start of mode j after selection, (55)–(57).
template <class C, int A, int Order>
SIGMAX_INLINE void mix_by_selection(const Plan& plan, const Estimate<C, A>* parts, int j, Lane<C> selected,
                                    Estimate<C, A>& result) {
  const Estimate<C, A>& own = parts[j];
  for (int a = 0; a < Order; ++a) result.x[a] = own.x[a];
  for_each_column<A, Order>([&](int a, int b, int k) { result.P[at(a, b)][k] = own.P[at(a, b)][k]; });
  if (!any(selected != Lane<C>{} + static_cast<Real<C>>(j))) return;
  choose<C, A, Order>(plan, parts, own, selected, result);
  if (plan.mixed_covariance == MixedCovariance::selected) return;
  const bool recentred = plan.mixed_covariance == MixedCovariance::own_recentred;
  C difference[Order];
  for (int a = 0; a < Order; ++a) difference[a] = result.x[a] - own.x[a];
  for_each_column<A, Order>([&](int a, int b, int k) {
    const C& column = own.P[at(a, b)][k];
    result.P[at(a, b)][k] = recentred ? column + difference[b][k] * difference[a] : column;
  });
}

/// (27), (28) with F_s ⊗ I as shears p += α v, v += F₁₂ a, p += β v, and a scale of the highest derivative.
template <class C, int A, int Order>
struct Prediction {
  using Number = Real<C>;

  /// Derivative `To` += f · derivative To + 1.
  template <int To>
  static SIGMAX_INLINE void shear(Number f, Estimate<C, A>& estimate) {
    constexpr int From = To + 1;
    auto& P = estimate.P;
    estimate.x[To] = estimate.x[To] + f * estimate.x[From];
    C before[A];
    transpose<A>(P[at(From, To)], before);
#pragma GCC unroll 8
    for (int k = 0; k < A; ++k) {
      P[at(From, To)][k] = P[at(From, To)][k] + f * full<A>(P[at(From, From)], k);
      if constexpr (From + 1 < Order) P[at(From + 1, To)][k] = P[at(From + 1, To)][k] + f * P[at(From + 1, From)][k];
      if constexpr (To > 0) P[at(To, To - 1)][k] = P[at(To, To - 1)][k] + f * P[at(From, To - 1)][k];
    }
#pragma GCC unroll 8
    for (int k = 0; k < A; ++k) {
      C& column = P[at(To, To)][k];
      column = below(k, column, column + f * (before[k] + P[at(From, To)][k]));
    }
  }

  /// The highest derivative times f.
  static SIGMAX_INLINE void scale(Number f, Estimate<C, A>& estimate) {
    if (f == Number{1}) return;
    constexpr int last = Order - 1;
    estimate.x[last] = f * estimate.x[last];
    for (int b = 0; b <= last; ++b)
      for (int k = 0; k < A; ++k) estimate.P[at(last, b)][k] = (b == last ? f * f : f) * estimate.P[at(last, b)][k];
  }

  static SIGMAX_INLINE void predict(const Law& law, Estimate<C, A>& estimate) {
    auto& P = estimate.P;
    const auto number = [](double value) { return static_cast<Number>(value); };
    C terms[Order];  // of the variances of F P Fᵀ, before they may cancel
    for (int a = 0; a < Order; ++a) {
      terms[a] = diagonal<A>(P[at(a, a)]);
      for (int b = 0; b < a; ++b)
        terms[b] = terms[b] + number(law.squared[static_cast<std::size_t>(at(a, b))]) * terms[a];
    }
    if constexpr (Order > 1) shear<0>(number(law.shears[0]), estimate);
    if constexpr (Order > 2) {
      shear<1>(number(law.shears[1]), estimate);
      shear<0>(number(law.shears[2]), estimate);
    }
    scale(number(law.scale), estimate);
    for (int a = 0; a < Order; ++a) {
      for (int k = 0; k < A; ++k) estimate.x[a][k] += number(law.u[static_cast<std::size_t>(a * A + k)]);
      for (int b = 0; b <= a; ++b) {
        C noise;
        fill(noise, number(law.Q[static_cast<std::size_t>(at(a, b))]));
        if (a == b) noise = noise + Precision<Number>::rounding * terms[a];
        for (int k = 0; k < A; ++k) P[at(a, b)][k] = plus_only(k, P[at(a, b)][k], noise);
      }
    }
  }
};

/// A measurement on lanes: z, the columns of R, and one where there is a measurement.
template <class C, int A>
struct Measured {
  C z;
  C R[A];
  Lane<C> there;
};

/// What the update of one model finds.
template <class C, int A>
struct Innovated {
  C residual;
  C S[A];
  Lane<C> squared_distance;
  Lane<C> determinant;
};

/// (29)–(32) with S = L D Lᵀ and Y = P Hᵀ L⁻ᵀ: x += Y D⁻¹ L⁻¹ ν, P −= Y D⁻¹ Yᵀ, to which the rounding of the prior
/// is added; docs/robustness.md has the bound. Clears `good` where that would be too much.
template <class C, int A, int Order>
SIGMAX_INLINE Innovated<C, A> update(const Measured<C, A>& measured, Estimate<C, A>& estimate, Mask<C>& good) {
  using V = Lane<C>;
  auto& P = estimate.P;
  Innovated<C, A> told;
  const V one = V{} + Real<C>{1};
  const auto there = measured.there > V{};
  V L[A][A], inverse[A], whitened[A];
  V condition = one;  // of S scaled to a unit diagonal
  told.determinant = one;
  told.squared_distance = V{};
  told.residual = measured.z - estimate.x[0];
  for (int k = 0; k < A; ++k) told.S[k] = P[0][k] + measured.R[k];
  auto fine = one > V{};
#pragma GCC unroll 8
  for (int i = 0; i < A; ++i) {
    const V variance = told.S[i][i];
    V pivot = variance;
    whitened[i] = told.residual[i];
#pragma GCC unroll 8
    for (int k = 0; k < i; ++k) {
      V rest = told.S[k][i];
      for (int m = 0; m < k; ++m) rest -= L[i][m] * L[m][k];
      L[i][k] = rest;
      rest *= inverse[k];
      pivot -= L[i][k] * rest;
      L[k][i] = rest;  // L itself above, L D below
      whitened[i] -= rest * whitened[k];
    }
    inverse[i] = one / pivot;
    fine = fine & (pivot > V{});
    condition *= variance * inverse[i];
    told.determinant *= pivot;
    told.squared_distance += whitened[i] * whitened[i] * inverse[i];
  }
  C Y[A][Order], Z[A][Order];
  for (int m = 0; m < A; ++m) inverse[m] = select(there, inverse[m], V{});
#pragma GCC unroll 8
  for (int m = 0; m < A; ++m)
#pragma GCC unroll 8
    for (int a = 0; a < Order; ++a) {
      C rest = a == 0 ? full<A>(P[0], m) : P[at(a, 0)][m];
      for (int k = 0; k < m; ++k) rest = rest - L[k][m] * Y[k][a];
      Y[m][a] = rest;
      Z[m][a] = inverse[m] * rest;
      estimate.x[a] = estimate.x[a] + whitened[m] * Z[m][a];
    }
  C before[Order];
  for (int a = 0; a < Order; ++a) before[a] = diagonal<A>(P[at(a, a)]);
  for_each_column<A, Order>([&](int a, int b, int k) {
    C& column = P[at(a, b)][k];
    C sum = column;
    for (int m = 0; m < A; ++m) sum = sum - Y[m][b][k] * Z[m][a];
    column = a == b ? below(k, column, sum) : sum;
  });
  const V lost = select(there, condition * Precision<Real<C>>::rounding, V{});
  C slack{};
  for (int a = 0; a < Order; ++a) {
    const C loss = lost * before[a];
    slack = least(slack, Precision<Real<C>>::greatest_loss * diagonal<A>(P[at(a, a)]) - loss);
    for (int k = 0; k < A; ++k) P[at(a, a)][k] = plus_only(k, P[at(a, a)][k], loss);
  }
  for (int k = 0; k < A; ++k) fine = fine & (slack[k] >= V{});
  good = good & (fine | (measured.there <= V{}));
  return told;
}

/// Clears `good` where an estimate is not finite, or a variance negative.
template <class C, int A, int Order>
SIGMAX_INLINE void judge(const Estimate<C, A>& estimate, Mask<C>& good) {
  using V = Lane<C>;
  C size{}, smallest{};
  for (int a = 0; a < Order; ++a) {
    const C variances = diagonal<A>(estimate.P[at(a, a)]);
    size = size + variances + estimate.x[a] * estimate.x[a];
    smallest = least(smallest, variances);
  }
  for (int k = 0; k < A; ++k) good = good & (size[k] < V{} + Precision<Real<C>>::greatest) & (smallest[k] >= V{});
}

/// One step of one or several tracks, from `now` to `next`.
template <class C, int A>
struct Step {
  using V = Lane<C>;
  const Plan& plan;
  const Estimate<C, A>* now;
  const V* weight;
  V most_likely;
  Estimate<C, A>* next;

  V prior[max_modes]{};
  V posterior[max_modes]{};
  V next_most_likely;
  C predicted[max_modes][max_order];
  Innovated<C, A> innovated[max_modes];

  Step(const Plan& what, const Estimate<C, A>* from, const V* weights, V winning, Estimate<C, A>* to)
      : plan(what), now(from), weight(weights), most_likely(winning), next(to) {}

  /// Returns where it is as good as the general step.
  template <bool selects>
  SIGMAX_INLINE Mask<C> take(const Measured<C, A>* measured) {
    const int modes = plan.modes;
    const V one = V{} + Real<C>{1};
    Mask<C> good = one > V{};

    // Step 1: prior of the mode, (51) or (53), what moves into each, (52) or (54), and the mixed starts.
    V coming[max_modes][max_modes];
    V total{};
    for (int j = 0; j < modes; ++j) {
      V sum{};
      for (int i = 0; i < modes; ++i) {
        V& its = coming[j][i] =
            weight[i] * static_cast<Real<C>>(plan.transition[static_cast<std::size_t>(i * modes + j)]);
        sum = selects ? select(its > sum, its, sum) : sum + its;
      }
      good = good & (sum > V{} + Precision<Real<C>>::least_weight);
      prior[j] = sum;
      total = selects ? select(sum > total, sum, total) : total + sum;
    }

    V nearest{};
    const bool measures = measured && any(measured->there > V{});
    for (int j = 0; j < modes; ++j) {
      with_order(plan.order[static_cast<std::size_t>(j)], [&](auto order) {
        constexpr int Order = decltype(order)::value;
        const auto filter = [&](Estimate<C, A> & own) __attribute__((always_inline)) {
          if constexpr (selects) {
            const V from = winner(modes, coming[j], V{} + static_cast<Real<C>>(j), plan.mixing_tie);
            mix_by_selection<C, A, Order>(plan, now, j, from, own);
          } else {
            const V share = one / prior[j];
            for (int i = 0; i < modes; ++i) coming[j][i] *= share;
            average<C, A, Order>(plan, now, now[j], coming[j], own);
          }
          prior[j] /= total;

          // Step 2: every model predicts and updates, (60), (61).
          Prediction<C, A, Order>::predict(plan.law[static_cast<std::size_t>(j)], own);
          for (int a = 0; a < Order; ++a) predicted[j][a] = own.x[a];
          if (measures) {
            innovated[j] = update<C, A, Order>(*measured, own, good);
            const V distance = innovated[j].squared_distance;
            nearest = j == 0 ? distance : select(distance < nearest, distance, nearest);
          }
          judge<C, A, Order>(own, good);
        };
        if constexpr (LaneOf<V>::count > 1) {
          filter(next[j]);
        } else {  // one track's numbers stay in registers in part
          Estimate<C, A> own;
          filter(own);
          for (int a = 0; a < Order; ++a) next[j].x[a] = own.x[a];
          for_each_column<A, Order>([&](int a, int b, int k) { next[j].P[at(a, b)][k] = own.P[at(a, b)][k]; });
        }
      });
    }

    // Step 3: the weights of the modes, (62) or (63), and the most likely one, (64).
    total = V{};
    for (int j = 0; j < modes; ++j) {
      posterior[j] = prior[j];
      if (measures) {
        V fit = exponential((nearest - innovated[j].squared_distance) * Real<C>{0.5});
        if (plan.likelihood == LikelihoodForm::density) fit *= one / root(innovated[j].determinant);
        posterior[j] *= select(measured->there > V{}, fit, one);
      }
      total = selects ? select(posterior[j] > total, posterior[j], total) : total + posterior[j];
    }

    for (int j = 0; j < modes; ++j) {
      posterior[j] /= total;
      good = good & (posterior[j] > V{} + Precision<Real<C>>::least_weight);
    }
    next_most_likely = winner(modes, posterior, most_likely, plan.output_tie);
    return good;
  }
};

/// Step 4: the output in the components of a model of the greatest order, (64)–(68), lifted by the rule in force.
template <class C, int A, int Order, bool selects>
SIGMAX_INLINE void output(const Plan& plan, const Estimate<C, A>* parts, const Lane<C>* weight, Lane<C> most_likely,
                          Estimate<C, A>& result) {
  using V = Lane<C>;
  // What a lift borrows: each derivative that a model lacks, of the most likely model that has it, with the covariances
  // within that model.
  int least_order = Order;
  for (int l = 0; l < plan.modes; ++l)
    if (const int its = plan.order[static_cast<std::size_t>(l)]; its < least_order) least_order = its;
  Estimate<C, A> lent;
  V carrier[Order];
  if (plan.lift != Lift::zero)
    for (int a = least_order; a < Order; ++a) {
      V its_weight[max_modes];
      for (int l = 0; l < plan.modes; ++l)
        its_weight[l] = a < plan.order[static_cast<std::size_t>(l)] ? weight[l] : V{} - Real<C>{1};
      carrier[a] = winner(plan.modes, its_weight, most_likely, plan.output_tie);
      lent.x[a] = C{};
      for (int b = least_order; b <= a; ++b)
        for (int k = 0; k < A; ++k) lent.P[at(a, b)][k] = C{};
      for (int l = 0; l < plan.modes; ++l) {
        if (a >= plan.order[static_cast<std::size_t>(l)]) continue;
        const V number = V{} + static_cast<Real<C>>(l);
        const auto its = carrier[a] == number;
        lent.x[a] = select(its, parts[l].x[a], lent.x[a]);
        for (int b = least_order; b <= a; ++b)
          for (int k = 0; k < A; ++k)
            lent.P[at(a, b)][k] = select(its & (carrier[b] == number), parts[l].P[at(a, b)][k], lent.P[at(a, b)][k]);
      }
    }
  if constexpr (selects) {
    result = {};
    choose<C, A, Order>(plan, parts, lent, most_likely, result);
  } else {
    average<C, A, Order>(plan, parts, lent, weight, result);
  }
}

}  // namespace
}  // namespace sigmax::detail::kinematic
