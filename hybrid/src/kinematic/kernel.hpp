/// The four steps of an interacting filter for motions along independent axes. The layout L says what a number is: one
/// of several tracks, or of one; the text is the same. Included once for each instruction set; everything is private to
/// the file that includes it, since an inline function compiled for one processor must not serve another.

#include "kinematic/kernels.hpp"
#include "kinematic/layouts.hpp"

/// Loops over the components of an estimate are unrolled, as their indices are to be constants; not where each access
/// is checked, which would take minutes to compile.
#if !defined(__clang__)
#define SIGMAX_UNROLL _Pragma("GCC unroll 64")
#elif __has_feature(address_sanitizer)
#define SIGMAX_UNROLL
#else
#define SIGMAX_UNROLL _Pragma("clang loop unroll(full)")
#endif
#define SIGMAX_APART __attribute__((noinline))
#define SIGMAX_WITHIN inline __attribute__((always_inline))

namespace sigmax::detail::kinematic {
namespace {

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
  static constexpr double rounding = 256 * 0x1p-23, greatest_loss = 3e-3, least_weight = 1e-30, greatest = 1e30;
};
template <class V>
using PrecisionOf = Precision<NumberOf<V>>;
constexpr int max_modes = StepPlan::max_modes;

/// An estimate of so many derivatives, where it is written; also the one of a model that is stored.
template <class L, int order>
struct Estimate {
  static constexpr int derivatives = order;
  typename L::OfAxes* __restrict x;
  typename L::OfPairs* __restrict P;

  typename L::OfAxes& mean(int a, int u) const { return x[a * L::axis_vectors + u]; }
  typename L::OfPairs& operator()(int a, int b, int k) const { return P[L::place(a, b, k)]; }
};
template <class L>
struct Stored {
  const NumberOf<typename L::Number>* x;
  const NumberOf<typename L::Number>* P;

  typename L::OfAxes mean(int a, int u) const { return read<typename L::OfAxes>(x, a * L::axis_vectors + u); }
  typename L::OfPairs operator()(int a, int b, int k) const { return read<typename L::OfPairs>(P, L::place(a, b, k)); }
};

/// action(order), a constant.
template <class Action>
inline void with_order(int order, const Action& action) {
  order == 2 ? action(Constant<2>{}) : action(Constant<3>{});
}

/// Index of the greatest weight, as a number; by logarithms it is the same.
template <class V>
SIGMAX_WITHIN V winner(int modes, const V* weights, V current, Tie tie) {
  return detail::select(
      static_cast<std::size_t>(modes), [=](std::size_t i) { return weights[i]; },
      [](V weight, V greatest) { return weight >= greatest * static_cast<NumberOf<V>>(1.0 - tie_tolerance); },
      [](std::size_t i) { return all<V>(static_cast<double>(i)); }, current, tie);
}

/// One track, or several, in a block: of so many modes, or of those of the plan.
template <class L, int Modes>
struct Track {
  using Number = typename L::Number;

  const StepPlan& plan;
  const int modes = Modes ? Modes : plan.modes;
  Stored<L> estimate[max_modes];
  Number weight[max_modes];
  Number most_likely;
  NumberOf<Number> lent = plan.augmentation == StateAugmentation::unbiased ? 1 : 0,
                   lent_variance = plan.augmentation == StateAugmentation::zero ? 0 : 1;

  Track(const StepPlan& what, const NumberOf<Number>* block) : plan(what) {
    for (int j = 0; j < modes; ++j) {
      estimate[j] = {block, block + L::mean_size(plan.order_of(j))};
      block += L::size(plan.order_of(j));
    }
    for (int j = 0; j < modes; ++j) weight[j] = read<Number>(block, j);
    most_likely = read<Number>(block, modes);
  }
};

/// A mixture of the estimates of models as one of so many derivatives: its mean, and how its covariance is made of
/// those of the models from `first` to `last` and of differences of means. A pair of axes at a time, so that what is in
/// hand fits into registers.
template <class L, int order, int Modes>
struct Mixture {
  using Number = typename L::Number;
  using OfAxes = typename L::OfAxes;
  using OfPairs = typename L::OfPairs;
  static constexpr int size = order * L::axis_vectors;

  const Track<L, Modes>& track;
  const Stored<L>& lender;  ///< an estimate of all derivatives; a part has so many times what it lacks

  OfAxes x[size];
  const int modes = Modes ? Modes : track.plan.modes;
  int first = 0, last = modes;
  Number weight[max_modes];
  int spreads = 0;
  OfAxes difference[max_modes][size], scaled[max_modes][size];

  Mixture(const Track<L, Modes>& of, int lending) : track(of), lender(of.estimate[lending]) {}

  /// Component i of the mean of model l, which has the first n derivatives.
  template <int n>
  OfAxes mean_of(int l, int i) const {
    return i < n * L::axis_vectors ? read<OfAxes>(track.estimate[l].x, i) : track.lent * read<OfAxes>(lender.x, i);
  }

  /// (58), (59) or (67), (68), one part after the other: a pair with the weights u and w has the spread
  /// u w/(u + w) (x − y)(x − y)ᵀ. The weights sum to one over the scale.
  void match_moments(const Number* weights, Number scale) {
    Number before{};
    for (int l = 0; l < modes; ++l) {
      const Number w = weights[l], total = before + w;
      weight[l] = w * scale;
      with_order(track.plan.order_of(l), [&](auto n) {
        if (l == 0) {
          SIGMAX_UNROLL for (int i = 0; i < size; ++i) x[i] = mean_of<n>(l, i);
          return;
        }
        const Number share = select(total > Number{}, w / total, Number{}), spread = before * scale * share;
        SIGMAX_UNROLL for (int i = 0; i < size; ++i) {
          const OfAxes apart = difference[spreads][i] = mean_of<n>(l, i) - x[i];
          scaled[spreads][i] = spread * apart;
          x[i] += share * apart;
        }
        ++spreads;
      });
      before = total;
    }
  }

  /// (55), (56): that of the model l that is selected, in each lane.
  void select_one(Number selected) {
    SIGMAX_UNROLL for (int i = 0; i < size; ++i) x[i] = read<OfAxes>(lender.x, i);
    for (int l = 0; l < modes; ++l) {
      const auto its = selected == all<Number>(l);
      weight[l] = select(its, all<Number>(1.0), Number{});
      with_order(track.plan.order_of(l), [&](auto n) {
        SIGMAX_UNROLL for (int i = 0; i < size; ++i) x[i] = select(its, mean_of<n>(l, i), x[i]);
      });
    }
  }

  /// The covariance along pair k.
  void read_pair(int k, OfPairs (&M)[order][order]) const {
    SIGMAX_UNROLL for (int a = 0; a < order; ++a) SIGMAX_UNROLL for (int b = 0; b < order; ++b) M[a][b] = OfPairs{};
    for (int l = first; l < last; ++l)
      with_order(track.plan.order_of(l), [&](auto n) {
        const Number w = weight[l];
        SIGMAX_UNROLL for (int a = 0; a < order; ++a) SIGMAX_UNROLL for (int b = 0; b < order; ++b) {
          const auto more = a == b && L::has_diagonal(k) ? track.lent_variance - track.lent : 0;
          const auto share = track.lent + more * L::diagonal();
          if (a < n && b < n) M[a][b] += w * track.estimate[l](a, b, k);
          if (a >= n && b >= n) M[a][b] += w * share * lender(a, b, k);
        }
      });
    for (int s = 0; s < spreads; ++s)
      SIGMAX_UNROLL for (int a = 0; a < order; ++a) SIGMAX_UNROLL for (int b = 0; b < order; ++b) M[a][b] +=
          L::of_first(scaled[s] + a * L::axis_vectors, k) * L::of_second(difference[s] + b * L::axis_vectors, k);
  }
};

/// (27), (28) of a mixture, F_s and Q_s along each axis, of which F_s scales the last derivative alone; each variance
/// with the rounding of the terms of F P Fᵀ, before they may cancel.
template <class L, int order, int Modes>
SIGMAX_WITHIN void predict(const AxisLaw& law, const Mixture<L, order, Modes>& mixture, Estimate<L, order> P) {
  using Number = NumberOf<typename L::Number>;
  using OfPairs = typename L::OfPairs;
  constexpr int last = order - 1;
  Number F[order][order], Q[order][order];
  SIGMAX_UNROLL for (int a = 0; a < order; ++a) SIGMAX_UNROLL for (int b = 0; b < order; ++b) {
    F[a][b] = static_cast<Number>(law.F[a + b * order]);
    Q[a][b] = static_cast<Number>(law.Q[a + b * order]);
  }
  SIGMAX_UNROLL for (int a = 0; a < order; ++a) SIGMAX_UNROLL for (int u = 0; u < L::axis_vectors; ++u) {
    typename L::OfAxes sum = F[a][a] * mixture.x[a * L::axis_vectors + u] + L::from(law.input + a * L::axes, u);
    SIGMAX_UNROLL for (int b = a + 1; b < order; ++b) sum += F[a][b] * mixture.x[b * L::axis_vectors + u];
    P.mean(a, u) = sum;
  }
  for_each<L::pair_vectors>([&](auto k) {
    OfPairs M[order][order], noise[order];
    mixture.read_pair(k, M);
    SIGMAX_UNROLL for (int a = 0; a < order; ++a) {
      noise[a] = OfPairs{};
      SIGMAX_UNROLL for (int c = a; c < order; ++c) noise[a] += F[a][c] * F[a][c] * M[c][c];
      noise[a] = Q[a][a] + static_cast<Number>(PrecisionOf<typename L::Number>::rounding) * noise[a];
    }
    SIGMAX_UNROLL for (int a = 0; a < order; ++a) SIGMAX_UNROLL for (int c = a + 1; c < order; ++c)
        SIGMAX_UNROLL for (int b = 0; b < order; ++b) M[a][b] += F[a][c] * M[c][b];
    SIGMAX_UNROLL for (int b = 0; b < order; ++b) SIGMAX_UNROLL for (int c = b + 1; c < order; ++c)
        SIGMAX_UNROLL for (int a = 0; a < order; ++a) M[a][b] += F[b][c] * M[a][c];
    if (F[last][last] != 1) {
      SIGMAX_UNROLL for (int b = 0; b < order; ++b) M[last][b] *= F[last][last];
      SIGMAX_UNROLL for (int a = 0; a < order; ++a) M[a][last] *= F[last][last];
    }
    SIGMAX_UNROLL for (int a = 0; a < order; ++a) SIGMAX_UNROLL for (int b = 0; b < order; ++b) {
      if (L::is_mirrored(a, b, k)) continue;
      if (L::has_diagonal(k)) M[a][b] += (a == b ? noise[a] : OfPairs{} + Q[a][b]) * L::diagonal();
      P(a, b, k) = M[a][b];
    }
  });
}

/// A measurement: z, the whole R, and one where there is a measurement.
template <class V, int A>
struct Measured {
  V z[A];
  V R[A * A];
  V there;
};

/// What one model thinks of a measurement: S = L D Lᵀ, and L⁻¹ ν.
template <class V, int A>
struct Innovated {
  V residual[A];
  V S[triangle(A)];
  V L[A][A];
  V inverse[A];  ///< of D
  V whitened[A];
  V squared_distance;
  V precision;  ///< 1/det S
  V condition;  ///< the first of S scaled to a unit diagonal
  V least;      ///< of what is not to be negative
};

/// The innovation of a prediction, (29), (30).
template <class L, int order, class V, int A>
SIGMAX_WITHIN Innovated<V, A> innovate(const Measured<V, A>& measured, Estimate<L, order> P) {
  const V one = all<V>(1.0);
  V factor[A][A];
  Innovated<V, A> result;
  result.condition = result.precision = result.least = one;
  result.squared_distance = V{};
  SIGMAX_UNROLL for (int i = 0; i < A; ++i) {
    result.residual[i] = result.whitened[i] = measured.z[i] - L::at(P.x, i);
    SIGMAX_UNROLL for (int k = 0; k <= i; ++k) factor[i][k] = result.S[triangle(i) + k] =
        L::at(P.P, triangle(i) + k) + measured.R[i + k * A];
    V pivot = factor[i][i];
    SIGMAX_UNROLL for (int k = 0; k < i; ++k) {
      V rest = factor[i][k];
      SIGMAX_UNROLL for (int m = 0; m < k; ++m) rest -= factor[i][m] * factor[m][k];
      factor[i][k] = rest;
      rest *= result.inverse[k];
      pivot -= factor[i][k] * rest;
      result.L[k][i] = factor[k][i] = rest;  // L itself above, L D below
      result.whitened[i] -= rest * result.whitened[k];
    }
    result.inverse[i] = one / pivot;
    result.least = lesser(pivot, result.least);
    result.condition *= factor[i][i] * result.inverse[i];
    result.precision *= result.inverse[i];
    result.squared_distance += result.whitened[i] * result.whitened[i] * result.inverse[i];
  }
  return result;
}

/// (31), (32) with Y = P Hᵀ L⁻ᵀ: x += Y D⁻¹ L⁻¹ ν, P −= Y D⁻¹ Yᵀ, to which the rounding of the prior is added;
/// docs/robustness.md has the bound. Returns where that is not too much.
template <class L, int order, class V, int A>
SIGMAX_WITHIN Mask<V> update(const Innovated<V, A>& innovated, Mask<V> there, Estimate<L, order> P) {
  using OfAxes = typename L::OfAxes;
  using OfPairs = typename L::OfPairs;
  constexpr int along = L::axis_vectors;
  OfAxes Y[A][order * along], Z[A][order * along];
  SIGMAX_UNROLL for (int m = 0; m < A; ++m) {
    const V weight = select(there, innovated.inverse[m], V{});
    SIGMAX_UNROLL for (int i = 0; i < order * along; ++i) {
      OfAxes rest = L::with_position(P, i / along, i % along, m);
      SIGMAX_UNROLL for (int k = 0; k < m; ++k) rest -= innovated.L[k][m] * Y[k][i];
      Y[m][i] = rest;
      Z[m][i] = weight * rest;
      P.x[i] += innovated.whitened[m] * Z[m][i];
    }
  }
  OfPairs least = OfPairs{} + static_cast<NumberOf<V>>(1);
  const V lost = select(there, innovated.condition * static_cast<NumberOf<V>>(PrecisionOf<V>::rounding), V{});
  for_each<L::pair_vectors>([&](auto k) {
    SIGMAX_UNROLL for (int a = 0; a < order; ++a) SIGMAX_UNROLL for (int b = 0; b < order; ++b) {
      if (L::is_mirrored(a, b, k)) continue;
      const OfPairs before = P(a, b, k);
      OfPairs rest = before;
      SIGMAX_UNROLL for (int m = 0; m < A; ++m) rest -=
          L::of_first(Z[m] + a * along, k) * L::of_second(Y[m] + b * along, k);
      if (a == b && L::has_diagonal(k)) {
        const OfPairs loss = lost * L::diagonal() * before;
        least = lesser(static_cast<NumberOf<V>>(PrecisionOf<V>::greatest_loss) * rest - loss, least);
        rest += loss;
      }
      P(a, b, k) = rest;
    }
  });
  const Mask<V> positive = lesser(L::least_of_diagonal(least), innovated.least) >= V{}, missing = there == Mask<V>{};
  return positive | missing;
}

/// @{
/// The same for several tracks, whose numbers would not fit into registers beside others.
template <class L, int order, int Modes>
SIGMAX_APART void predict_apart(const AxisLaw& law, const Mixture<L, order, Modes>& mixture, Estimate<L, order> P) {
  predict(law, mixture, P);
}
template <class L, int order, class V, int A>
SIGMAX_APART Mask<V> update_apart(const Innovated<V, A>& innovated, Mask<V> there, Estimate<L, order> P) {
  return update(innovated, there, P);
}
/// @}

/// Where an estimate is finite, and no variance negative.
template <class L, int order>
inline auto is_sound(Estimate<L, order> P) {
  using Number = typename L::Number;
  typename L::OfAxes squares{};
  typename L::OfPairs least{}, sum{};
  SIGMAX_UNROLL for (int a = 0; a < order; ++a) {
    SIGMAX_UNROLL for (int u = 0; u < L::axis_vectors; ++u) squares += P.mean(a, u) * P.mean(a, u);
    for_each<L::pair_vectors>([&](auto k) {
      if (!L::has_diagonal(k)) return;
      sum += P(a, a, k);
      least = lesser(P(a, a, k), least);
    });
  }
  const Mask<Number> positive = L::least_of_diagonal(least) >= Number{};
  const Mask<Number> finite =
      L::sum_of_diagonal(sum) + L::sum_of_axes(squares) < all<Number>(PrecisionOf<Number>::greatest);
  return positive & finite;
}

/// One step of so many modes, or of those of the plan, from one block into another.
template <class L, class Algebra, int Modes = 0>
struct Step : Track<L, Modes> {
  using V = typename L::Number;
  using Base = NumberOf<V>;
  using Track<L, Modes>::plan;
  using Track<L, Modes>::modes;
  static constexpr bool selects = SelectiveAlgebra<Algebra>;
  static constexpr bool one_track = Lane<V>::count == 1;
  static constexpr int axes = L::axes;

  Base* next;
  V prior[max_modes];  ///< not normalised, but for their sum, or the greatest
  V total{};
  V posterior[max_modes];
  V next_most_likely;
  Innovated<V, axes> innovated[max_modes];

  Step(const StepPlan& what, const Base* from, Base* to) : Track<L, Modes>(what, from), next(to) {}

  /// (52), (54)–(57) or (58), (59): the mixed start of mode j, into which `coming` moves from each of the modes.
  template <int order>
  Mixture<L, order, Modes> mixed(int j, const V* coming) const {
    Mixture<L, order, Modes> result(*this, j);
    if constexpr (selects) {
      result.select_one(winner(modes, coming, all<V>(j), plan.mixing_tie));
      if (plan.mixed_covariance == MixedCovariance::selected) return result;
      result.first = j;
      result.last = j + 1;
      result.weight[j] = all<V>(1.0);
      result.spreads = plan.mixed_covariance == MixedCovariance::own_recentred ? 1 : 0;
      SIGMAX_UNROLL for (int i = 0; i < result.size; ++i) result.difference[0][i] = result.scaled[0][i] =
          result.x[i] - read<typename L::OfAxes>(this->estimate[j].x, i);
    } else {
      result.match_moments(coming, all<V>(1.0) / prior[j]);
    }
    return result;
  }

  /// action(j, the estimate being made) for each mode; returns where the weights go.
  template <class Action>
  Base* for_modes(const Action& action) const {
    Base* to = next;
    for (int j = 0; j < modes; ++j)
      with_order(plan.order_of(j), [&](auto order) {
        action(j, Estimate<L, order>{reinterpret_cast<typename L::OfAxes*>(to),
                                     reinterpret_cast<typename L::OfPairs*>(to + L::mean_size(order))});
        to += L::size(order);
      });
    return to;
  }

  /// Returns where it is as good as the general step. What waits for few numbers stands before what has many to do, so
  /// that the processor does both at once: the weights before the estimates. `predicted(j, its estimate)` and
  /// `weighed()` are called when that is done.
  template <class Predicted, class Weighed>
  Mask<V> take(const Measured<V, axes>* measured, const Predicted& predicted, const Weighed& weighed) {
    const auto plus = [](V sum, V term) { return selects ? select(term > sum, term, sum) : sum + term; };
    const V one = all<V>(1.0), least = all<V>(PrecisionOf<V>::least_weight);
    Mask<V> good = one > V{};

    for_modes([&]<int order>(int j, Estimate<L, order> own) {
      // Step 1: the prior of the mode, (51) or (53), and the mixed start.
      V coming[max_modes];
      prior[j] = V{};
      for (int i = 0; i < modes; ++i) {
        coming[i] = this->weight[i] * static_cast<Base>(plan.transition[i * modes + j]);
        prior[j] = plus(prior[j], coming[i]);
      }
      good = good & (prior[j] > least);
      for (int a = 0; a + 1 < order; ++a) good = good & (all<V>(plan.law[j].F[a + a * order]) == one);
      total = plus(total, prior[j]);

      // Step 2: the model predicts, (60), and updates, (61), see below.
      const auto start = mixed<order>(j, coming);
      one_track ? predict(plan.law[j], start, own) : predict_apart(plan.law[j], start, own);
      predicted(j, own);
    });

    // Step 3: the weights of the modes, (62) or (63), and the most likely one, (64).
    const Mask<V> there = measured ? measured->there > V{} : V{} > V{};
    V nearest{};
    if (measured)
      for_modes([&](int j, auto own) {
        innovated[j] = innovate(*measured, own);
        nearest = j == 0 ? innovated[j].squared_distance : lesser(innovated[j].squared_distance, nearest);
      });
    V sum{};
    for (int j = 0; j < modes; ++j) {
      posterior[j] = prior[j];
      if (measured) {
        const V fit = exponential<V>((nearest - innovated[j].squared_distance) * Base(0.5));
        const V scale = plan.likelihood == LikelihoodForm::density ? root<V>(innovated[j].precision) : one;
        posterior[j] *= select(there, fit * scale, one);
      }
      sum = plus(sum, posterior[j]);
    }
    for (int j = 0; j < modes; ++j) {
      posterior[j] /= sum;
      if constexpr (one_track) posterior[j] = kept_weight(posterior[j]);
      good = good & (posterior[j] > least);
    }
    next_most_likely = winner(modes, posterior, this->most_likely, plan.output_tie);
    weighed();

    Base* const weights = for_modes([&](int j, auto own) {
      if (measured)
        good = good & (one_track ? update(innovated[j], there, own) : update_apart(innovated[j], there, own));
      good = good & is_sound(own);
      L::mirror(own);
    });
    for (int j = 0; j < modes; ++j) write(weights, j, posterior[j]);
    write(weights, modes, next_most_likely);
    return good;
  }
};

}  // namespace
}  // namespace sigmax::detail::kinematic
