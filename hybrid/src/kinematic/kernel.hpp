/// The four steps of an interacting filter for motions along independent axes. `V` is a number of one track, or of
/// several: the text is the same. Included once for each instruction set; everything is private to the file that
/// includes it, since an inline function compiled for one processor must not serve another.

#include <sigmax/hybrid/kinematic_plan.hpp>

#include "kinematic/lanes.hpp"

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

/// Where the entry (i, k), k ≤ i, of a symmetric matrix of N columns is: one track has the whole matrix, several have
/// the triangle.
template <class V, int N>
constexpr int at(int i, int k) {
  return Lane<V>::count == 1 ? i * N + k : triangle(i) + k;
}

/// An estimate of N components in hand, of which the lower triangle is of value. Nothing else is where it is.
template <class V, int N>
struct Estimate {
  V* __restrict x;
  V* __restrict P;

  V& operator()(int i, int k) const { return i < k ? P[at<V, N>(k, i)] : P[at<V, N>(i, k)]; }
};

template <int Number>
struct Constant {
  constexpr operator int() const { return Number; }
};

/// action(N), N a constant: the components of a model of the order along A axes.
template <int A, class Action>
inline void with_size(int order, const Action& action) {
  if (order == 2)
    action(Constant<2 * A>{});
  else
    action(Constant<3 * A>{});
}

/// Index of the greatest weight, as a number; see sigmax::detail::select.
template <class V>
V winner(int modes, const V* weight, V current, Tie tie) {
  V greatest = weight[0];
  for (int i = 1; i < modes; ++i) greatest = select<V>(weight[i] > greatest, weight[i], greatest);
  const V least = greatest * static_cast<NumberOf<V>>(1.0 - tie_tolerance);
  V result{};
  for (int i = 0; i < modes; ++i) {
    const int place = tie == Tie::last ? i : modes - 1 - i;
    result = select<V>(weight[place] >= least, all<V>(place), result);
  }
  if (tie == Tie::stay)
    for (int i = 0; i < modes; ++i)
      result = select<V>((current == all<V>(i)) & (weight[i] >= least), all<V>(i), result);
  return result;
}

/// action(u, v) for each pair of axes, v ≤ u, constants.
template <int A, class Action>
inline void for_pairs(const Action& action) {
  action(Constant<0>{}, Constant<0>{});
  if constexpr (A > 1) action(Constant<1>{}, Constant<0>{}), action(Constant<1>{}, Constant<1>{});
  if constexpr (A > 2)
    action(Constant<2>{}, Constant<0>{}), action(Constant<2>{}, Constant<1>{}), action(Constant<2>{}, Constant<2>{});
}

/// A mixture of the estimates of models as one of N components along A axes: its mean, and how its covariance is made
/// of those of the models from `first` to `last` and of differences of means. A pair of axes at a time, so that what
/// is in hand fits into registers.
template <class V, int A, int N>
struct Mixture {
  static constexpr int order = N / A;

  const Plan& plan;
  const NumberOf<V>* const* mean;  ///< where the estimate of each model is stored
  const NumberOf<V>* const* covariance;
  const NumberOf<V>* lender_mean;  ///< of an estimate of all components; a part has so many times what it lacks
  const NumberOf<V>* lender_covariance;
  NumberOf<V> lent = plan.augmentation == StateAugmentation::unbiased ? 1 : 0,
              lent_variance = plan.augmentation == StateAugmentation::zero ? 0 : 1;

  V x[N];
  int first = 0, last = plan.modes;
  V weight[max_modes];
  int spreads = 0;
  V difference[max_modes][N], scaled[max_modes][N];

  Mixture(const Plan& what, const NumberOf<V>* const* means, const NumberOf<V>* const* covariances, int lender)
      : plan(what),
        mean(means),
        covariance(covariances),
        lender_mean(means[lender]),
        lender_covariance(covariances[lender]) {}

  /// The i-th component of the mean of model l, which has n.
  template <int n>
  V mean_of(int l, int i) const {
    return i < n ? read<V>(mean[l], i) : lent * read<V>(lender_mean, i);
  }

  /// (58), (59) or (67), (68), one part after the other: a pair with the weights u and w has the spread
  /// u w/(u + w) (x − y)(x − y)ᵀ. The weights sum to one over the scale.
  void match_moments(const V* weights, V scale) {
    V before{};
    for (int l = 0; l < plan.modes; ++l) {
      const V w = weights[l], total = before + w;
      weight[l] = w * scale;
      with_size<A>(plan.order[l], [&](auto n) {
        if (l == 0) {
          SIGMAX_UNROLL for (int i = 0; i < N; ++i) x[i] = mean_of<n>(l, i);
          return;
        }
        const V share = select<V>(total > V{}, w / total, V{}), spread = before * scale * share;
        SIGMAX_UNROLL for (int i = 0; i < N; ++i) {
          const V apart = difference[spreads][i] = mean_of<n>(l, i) - x[i];
          scaled[spreads][i] = spread * apart;
          x[i] += share * apart;
        }
        ++spreads;
      });
      before = total;
    }
  }

  /// Writes the covariance as `move` changes it, move(u, v, what it is along these axes), v ≤ u.
  template <class Move>
  void write(Estimate<V, N> P, const Move& move) const {
    for_pairs<A>([&](auto u, auto v) {
      V M[order][order];
      read_pair<u, v>(M);
      move(u, v, M);
      SIGMAX_UNROLL for (int a = 0; a < order; ++a) SIGMAX_UNROLL for (int b = 0; b < (u == v ? a + 1 : order); ++b)
          P(a * A + u, b * A + v) = M[a][b];
    });
  }

  template <int u, int v>
  void read_pair(V (&M)[order][order]) const {
    SIGMAX_UNROLL for (int a = 0; a < order; ++a) SIGMAX_UNROLL for (int b = 0; b < order; ++b) M[a][b] = V{};
    for (int l = first; l < last; ++l)
      with_size<A>(plan.order[l], [&](auto n) {
        const V w = weight[l];
        SIGMAX_UNROLL for (int a = 0; a < order; ++a) SIGMAX_UNROLL for (int b = 0; b < order; ++b) {
          const int i = a * A + u, k = b * A + v, high = i < k ? k : i, low = i < k ? i : k;
          if (high < n)
            M[a][b] += w * read<V>(covariance[l], at<V, n>(high, low));
          else if (low >= n)
            M[a][b] += w * (i == k ? lent_variance : lent) * read<V>(lender_covariance, at<V, N>(high, low));
        }
      });
    for (int s = 0; s < spreads; ++s)
      SIGMAX_UNROLL for (int a = 0; a < order; ++a) SIGMAX_UNROLL for (int b = 0; b < order; ++b) {
        const int i = a * A + u, k = b * A + v;
        M[a][b] += scaled[s][i < k ? k : i] * difference[s][i < k ? i : k];
      }
  }
};

/// Derivative `to` += f · the next one, along both axes of a pair.
template <int to, class V, int order>
inline void shear(NumberOf<V> f, V (&M)[order][order]) {
  SIGMAX_UNROLL for (int b = 0; b < order; ++b) M[to][b] += f * M[to + 1][b];
  SIGMAX_UNROLL for (int a = 0; a < order; ++a) M[a][to] += f * M[a][to + 1];
}

/// (27), (28) of a mixture, with F_s ⊗ I as shears p += α v, v += F₁₂ a, p += β v, and a scale of the highest
/// derivative; each variance with the rounding of the terms of F P Fᵀ, before they may cancel.
template <class V, int A, int N>
SIGMAX_APART void predict(const Law& law, const Mixture<V, A, N>& mixture, Estimate<V, N> P) {
  using Number = NumberOf<V>;
  const auto number = [](double value) { return static_cast<Number>(value); };
  constexpr int order = N / A, last = order - 1;
  const Number shears[]{number(law.shears[0]), number(law.shears[1]), number(law.shears[2])};
  const Number scale = number(law.scale);
  mixture.write(P, [&](auto u, auto v, V(&M)[order][order]) {
    V terms[order];
    SIGMAX_UNROLL for (int a = 0; a < order; ++a) {
      terms[a] = M[a][a];
      SIGMAX_UNROLL for (int b = 0; b < a; ++b) terms[b] +=
          number(law.squared[static_cast<std::size_t>(triangle(a) + b)]) * M[a][a];
    }
    shear<0>(shears[0], M);
    if constexpr (order > 2) {
      shear<1>(shears[1], M);
      shear<0>(shears[2], M);
    }
    if (law.scale != 1.0) {
      SIGMAX_UNROLL for (int b = 0; b < order; ++b) M[last][b] *= scale;
      SIGMAX_UNROLL for (int a = 0; a < order; ++a) M[a][last] *= scale;
    }
    if constexpr (u == v) {
      V x[order];
      SIGMAX_UNROLL for (int a = 0; a < order; ++a) {
        x[a] = mixture.x[a * A + u];
        SIGMAX_UNROLL for (int b = 0; b <= a; ++b) M[a][b] += number(law.Q[static_cast<std::size_t>(triangle(a) + b)]);
        M[a][a] += number(PrecisionOf<V>::rounding) * terms[a];
      }
      x[0] += shears[0] * x[1];
      if constexpr (order > 2) {
        x[1] += shears[1] * x[2];
        x[0] += shears[2] * x[1];
      }
      x[last] *= scale;
      SIGMAX_UNROLL for (int a = 0; a < order; ++a) P.x[a * A + u] =
          x[a] + number(law.u[static_cast<std::size_t>(a * A + u)]);
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
template <class V, int A, int N>
inline void innovate(const Measured<V, A>& measured, Estimate<V, N> P, Innovated<V, A>& told) {
  const V one = all<V>(1.0);
  V L[A][A], inverse[A], whitened[A];
  V condition = one, precision = one, squared_distance{}, least = one;
  SIGMAX_UNROLL for (int i = 0; i < A; ++i) {
    told.residual[i] = whitened[i] = measured.z[i] - P.x[i];
    SIGMAX_UNROLL for (int k = 0; k <= i; ++k) L[i][k] = told.S[triangle(i) + k] = P(i, k) + measured.R[i + k * A];
    V pivot = L[i][i];
    SIGMAX_UNROLL for (int k = 0; k < i; ++k) {
      V rest = L[i][k];
      SIGMAX_UNROLL for (int m = 0; m < k; ++m) rest -= L[i][m] * L[m][k];
      L[i][k] = rest;
      rest *= inverse[k];
      pivot -= L[i][k] * rest;
      told.L[k][i] = L[k][i] = rest;  // L itself above, L D below
      whitened[i] -= rest * whitened[k];
    }
    told.inverse[i] = inverse[i] = one / pivot;
    told.whitened[i] = whitened[i];
    least = select<V>(pivot < least, pivot, least);
    condition *= L[i][i] * inverse[i];
    precision *= inverse[i];
    squared_distance += whitened[i] * whitened[i] * inverse[i];
  }
  told.squared_distance = squared_distance;
  told.precision = precision;
  told.condition = condition;
  told.least = least;
}

/// (31), (32) with Y = P Hᵀ L⁻ᵀ: x += Y D⁻¹ L⁻¹ ν, P −= Y D⁻¹ Yᵀ, to which the rounding of the prior is added;
/// docs/robustness.md has the bound. Returns where that is not too much.
template <class V, int A, int N>
SIGMAX_APART Mask<V> update(const Innovated<V, A>& told, Mask<V> there, Estimate<V, N> P) {
  using Number = NumberOf<V>;
  V Y[A][N], Z[A][N];
  SIGMAX_UNROLL for (int m = 0; m < A; ++m) {
    const V weight = select<V>(there, told.inverse[m], V{});
    SIGMAX_UNROLL for (int i = 0; i < N; ++i) {
      V rest = P(i, m);
      SIGMAX_UNROLL for (int k = 0; k < m; ++k) rest -= told.L[k][m] * Y[k][i];
      Y[m][i] = rest;
      Z[m][i] = weight * rest;
      P.x[i] += told.whitened[m] * Z[m][i];
    }
  }
  V least = told.least;
  const V lost = select<V>(there, told.condition * static_cast<Number>(PrecisionOf<V>::rounding), V{});
  SIGMAX_UNROLL for (int i = 0; i < N; ++i) {
    const V loss = lost * P(i, i);
    SIGMAX_UNROLL for (int k = 0; k <= i; ++k) {
      V rest = P(i, k);
      SIGMAX_UNROLL for (int m = 0; m < A; ++m) rest -= Z[m][i] * Y[m][k];
      P(i, k) = rest;
    }
    const V left = static_cast<Number>(PrecisionOf<V>::greatest_loss) * P(i, i) - loss;
    least = select<V>(left < least, left, least);
    P(i, i) += loss;
  }
  return (least >= V{}) | (there == Mask<V>{});
}

/// Where an estimate is finite, and no variance negative.
template <class V, int N>
inline Mask<V> is_sound(Estimate<V, N> P) {
  V least = P(0, 0), sum{};
  SIGMAX_UNROLL for (int i = 0; i < N; ++i) {
    const V variance = P(i, i);
    least = select<V>(variance < least, variance, least);
    sum += variance + P.x[i] * P.x[i];
  }
  return (least >= V{}) & (sum < all<V>(PrecisionOf<V>::greatest));
}

/// One step of one or several tracks, from what is stored.
template <class V, int A, bool selects>
struct Step {
  const Plan& plan;
  const NumberOf<V>* mean[max_modes];  ///< where the estimate of each model is stored
  const NumberOf<V>* covariance[max_modes];
  V weight[max_modes];
  V most_likely;

  V* next_mean[max_modes];  ///< where the next one goes
  V* next_covariance[max_modes];
  V prior[max_modes];  ///< not normalised, but for their sum, or the greatest
  V total{};
  V posterior[max_modes]{};
  V next_most_likely;
  V* predicted[max_modes];  ///< where the mean before the measurement goes, of one track
  Innovated<V, A> innovated[max_modes];

  explicit Step(const Plan& what) : plan(what) {}

  /// (52), (54)–(57) or (58), (59): the mixed start of mode j, into which `coming` moves from each of the modes.
  template <int N>
  Mixture<V, A, N> mixed(int j, const V* coming) const {
    Mixture<V, A, N> result(plan, mean, covariance, j);
    if constexpr (selects) {
      const V selected = winner<V>(plan.modes, coming, all<V>(j), plan.mixing_tie), none{}, one = all<V>(1.0);
      SIGMAX_UNROLL for (int i = 0; i < N; ++i) result.x[i] = read<V>(mean[j], i);
      for (int l = 0; l < plan.modes; ++l) {
        const Mask<V> its = selected == all<V>(l);
        result.weight[l] = select<V>(its, one, none);
        if (l == j) continue;
        with_size<A>(plan.order[l], [&](auto n) {
          SIGMAX_UNROLL for (int i = 0; i < N; ++i) result.x[i] =
              select<V>(its, result.template mean_of<n>(l, i), result.x[i]);
        });
      }
      if (plan.mixed_covariance == MixedCovariance::selected) return result;
      result.first = j;
      result.last = j + 1;
      result.weight[j] = one;
      result.spreads = plan.mixed_covariance == MixedCovariance::own_recentred ? 1 : 0;
      SIGMAX_UNROLL for (int i = 0; i < N; ++i) result.difference[0][i] = result.scaled[0][i] =
          result.x[i] - read<V>(mean[j], i);
    } else {
      result.match_moments(coming, all<V>(1.0) / prior[j]);
    }
    return result;
  }

  /// action(j, the estimate being made) for each mode.
  template <class Action>
  void for_modes(const Action& action) const {
    for (int j = 0; j < plan.modes; ++j)
      with_size<A>(plan.order[j], [&](auto N) { action(j, Estimate<V, N>{next_mean[j], next_covariance[j]}); });
  }

  /// Returns where it is as good as the general step. What waits for few numbers stands before what has many to do, so
  /// that the processor does both at once: the weights before the estimates.
  Mask<V> take(const Measured<V, A>* measured) {
    const int modes = plan.modes;
    const auto plus = [](V sum, V term) { return selects ? select<V>(term > sum, term, sum) : sum + term; };
    const V one = all<V>(1.0), least = all<V>(PrecisionOf<V>::least_weight);
    Mask<V> good = one > V{};

    for_modes([&]<int N>(int j, Estimate<V, N> own) {
      // Step 1: the prior of the mode, (51) or (53), and the mixed start.
      V coming[max_modes];
      prior[j] = V{};
      for (int i = 0; i < modes; ++i) {
        coming[i] = weight[i] * static_cast<NumberOf<V>>(plan.transition[static_cast<std::size_t>(i * modes + j)]);
        prior[j] = plus(prior[j], coming[i]);
      }
      good = good & (prior[j] > least);
      total = plus(total, prior[j]);
      const auto start = mixed<N>(j, coming);

      // Step 2: the model predicts, (60), and updates, (61), see below.
      predict(plan.law[j], start, own);
      for (int i = 0; i < N && Lane<V>::count == 1; ++i) predicted[j][i] = own.x[i];
    });

    // Step 3: the weights of the modes, (62) or (63), and the most likely one, (64).
    const Mask<V> there = measured ? measured->there > V{} : V{} > V{};
    V nearest{};
    if (measured)
      for_modes([&](int j, auto own) {
        innovate(*measured, own, innovated[j]);
        const V distance = innovated[j].squared_distance;
        nearest = j == 0 ? distance : select<V>(distance < nearest, distance, nearest);
      });
    V sum{};
    for (int j = 0; j < modes; ++j) {
      posterior[j] = prior[j];
      if (measured) {
        const V fit = exponential<V>((nearest - innovated[j].squared_distance) * NumberOf<V>(0.5));
        const V scale = plan.likelihood == LikelihoodForm::density ? root<V>(innovated[j].precision) : one;
        posterior[j] *= select<V>(there, fit * scale, one);
      }
      sum = plus(sum, posterior[j]);
    }
    for (int j = 0; j < modes; ++j) {
      posterior[j] /= sum;
      good = good & (posterior[j] > least);
    }
    next_most_likely = winner<V>(modes, posterior, most_likely, plan.output_tie);

    for_modes([&](int j, auto own) {
      if (measured) good = good & update(innovated[j], there, own);
      good = good & is_sound(own);
    });
    return good;
  }
};

}  // namespace
}  // namespace sigmax::detail::kinematic
