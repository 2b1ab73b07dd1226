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
  static constexpr double rounding = 256 * 0x1p-23;
  static constexpr double greatest_loss = 3e-3;
  static constexpr double least_weight = 1e-30;
  static constexpr double greatest = 1e30;
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

/// An estimate of N components where it is stored.
template <class V, int N>
struct Stored {
  const NumberOf<V>* x;
  const NumberOf<V>* P;

  V mean(int i) const { return read<V>(x, i); }
  V covariance(int i, int k) const { return read<V>(P, at<V, N>(i, k)); }
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

/// What a part of a mixture has for the components from n on, which it lacks: so many times what the lender has, an
/// estimate of all components.
template <class V>
struct Lent {
  NumberOf<V> mean, variance, covariance;
  explicit Lent(Lift lift)
      : mean(lift == Lift::unbiased ? 1 : 0), variance(lift == Lift::zero ? 0 : 1), covariance(mean) {}
};

/// A part of a mixture, as one of N components.
template <class V, int N, int n>
struct Part {
  Stored<V, n> own;
  Stored<V, N> lender;
  Lent<V> lent;

  V mean(int i) const { return i < n ? own.mean(i) : lent.mean * lender.mean(i); }
  /// w times the entry (i, k) of its covariance, added to `sum`.
  V add(V sum, V w, int i, int k) const {
    if (i < n) return sum + w * own.covariance(i, k);
    if (k < n) return sum;
    return sum + w * (i == k ? lent.variance : lent.covariance) * lender.covariance(i, k);
  }
};

/// Adds a part with the weight w to a mixture, of which `before` is the weight so far: a pair with the weights u and w
/// has the spread u w/(u + w) (x − y)(x − y)ᵀ.
template <class V, int N, int n>
SIGMAX_APART void add(const Part<V, N, n>& part, V before, V w, Estimate<V, N> mixture) {
  const V total = before + w, share = select<V>(total > V{}, w / total, V{}), spread = before * share;
  V difference[N], scaled[N];
  SIGMAX_UNROLL for (int i = 0; i < N; ++i) {
    difference[i] = part.mean(i) - mixture.x[i];
    scaled[i] = spread * difference[i];
    mixture.x[i] += share * difference[i];
  }
  SIGMAX_UNROLL for (int i = 0; i < N; ++i) SIGMAX_UNROLL for (int k = 0; k <= i; ++k) mixture(i, k) =
      part.add(mixture(i, k) + scaled[i] * difference[k], w, i, k);
}

/// Begins a mixture with its first part.
template <class V, int N, int n>
SIGMAX_APART void begin(const Part<V, N, n>& part, V w, Estimate<V, N> mixture) {
  SIGMAX_UNROLL for (int i = 0; i < N; ++i) mixture.x[i] = part.mean(i);
  SIGMAX_UNROLL for (int i = 0; i < N; ++i) SIGMAX_UNROLL for (int k = 0; k <= i; ++k) mixture(i, k) =
      part.add(V{}, w, i, k);
}

/// The part, where it is the one that was selected.
template <class V, int N, int n>
SIGMAX_APART void choose(const Part<V, N, n>& part, Mask<V> its, Estimate<V, N> result) {
  SIGMAX_UNROLL for (int i = 0; i < N; ++i) result.x[i] = select<V>(its, part.mean(i), result.x[i]);
  SIGMAX_UNROLL for (int i = 0; i < N; ++i) SIGMAX_UNROLL for (int k = 0; k <= i; ++k) result(i, k) =
      select<V>(its, part.add(V{}, all<V>(1.0), i, k), result(i, k));
}

/// Derivative `To` += f · the next one, of A axes.
template <int A, int To, class V, int N>
inline void shear(NumberOf<V> f, Estimate<V, N> P) {
  constexpr int to = To * A, from = to + A;
  V before[A][A];
  SIGMAX_UNROLL for (int u = 0; u < A; ++u) {
    P.x[to + u] += f * P.x[from + u];
    SIGMAX_UNROLL for (int v = 0; v < A; ++v) {
      before[u][v] = P(from + u, to + v);
      P(from + u, to + v) += f * P(from + u, from + v);
    }
  }
  SIGMAX_UNROLL for (int i = from + A; i < N; ++i) SIGMAX_UNROLL for (int v = 0; v < A; ++v) P(i, to + v) +=
      f * P(i, from + v);
  SIGMAX_UNROLL for (int u = 0; u < A; ++u) {
    SIGMAX_UNROLL for (int k = 0; k < to; ++k) P(to + u, k) += f * P(from + u, k);
    SIGMAX_UNROLL for (int v = 0; v <= u; ++v) P(to + u, to + v) += f * (before[v][u] + P(from + u, to + v));
  }
}

/// (27), (28) with F_s ⊗ I as shears p += α v, v += F₁₂ a, p += β v, and a scale of the highest derivative; each
/// variance with the rounding of the terms of F P Fᵀ, before they may cancel.
template <int A, class V, int N>
SIGMAX_APART void predict(const Law& law, Estimate<V, N> P) {
  using Number = NumberOf<V>;
  const auto number = [](double value) { return static_cast<Number>(value); };
  constexpr int order = N / A;
  V terms[N];
  SIGMAX_UNROLL for (int i = 0; i < N; ++i) {
    terms[i] = P(i, i);
    SIGMAX_UNROLL for (int b = 0; b < i / A; ++b) terms[b * A + i % A] +=
        number(law.squared[static_cast<std::size_t>(triangle(i / A) + b)]) * terms[i];
  }
  shear<A, 0>(number(law.shears[0]), P);
  if constexpr (order > 2) {
    shear<A, 1>(number(law.shears[1]), P);
    shear<A, 0>(number(law.shears[2]), P);
  }
  if (law.scale != 1.0) {
    const Number scale = number(law.scale);
    constexpr int last = N - A;
    SIGMAX_UNROLL for (int i = last; i < N; ++i) {
      P.x[i] *= scale;
      SIGMAX_UNROLL for (int k = 0; k <= i; ++k) P(i, k) *= k < last ? scale : scale * scale;
    }
  }
  SIGMAX_UNROLL for (int i = 0; i < N; ++i) {
    P.x[i] += number(law.u[static_cast<std::size_t>(i)]);
    SIGMAX_UNROLL for (int b = 0; b <= i / A; ++b) P(i, b * A + i % A) +=
        number(law.Q[static_cast<std::size_t>(triangle(i / A) + b)]);
    P(i, i) += number(PrecisionOf<V>::rounding) * terms[i];
  }
}

/// A measurement: z, the whole R, and one where there is a measurement.
template <class V, int A>
struct Measured {
  V z[A];
  V R[A * A];
  V there;
};

/// What the update of one model finds.
template <class V, int A>
struct Innovated {
  V residual[A];
  V S[triangle(A)];
  V squared_distance;
  V determinant;
};

/// (29)–(32) with S = L D Lᵀ and Y = P Hᵀ L⁻ᵀ: x += Y D⁻¹ L⁻¹ ν, P −= Y D⁻¹ Yᵀ, to which the rounding of the prior
/// is added; docs/robustness.md has the bound. Returns where that is not too much.
template <class V, int A, int N>
SIGMAX_APART Mask<V> update(const Measured<V, A>& measured, Estimate<V, N> P, Innovated<V, A>& told) {
  using Number = NumberOf<V>;
  const V one = all<V>(1.0);
  const Mask<V> there = measured.there > V{};
  V L[A][A], inverse[A], whitened[A];
  V condition = one, determinant = one, squared_distance{};  // the first of S scaled to a unit diagonal
  V least = one;                                             // of what is not to be negative
  SIGMAX_UNROLL for (int i = 0; i < A; ++i) {
    told.residual[i] = whitened[i] = measured.z[i] - P.x[i];
    SIGMAX_UNROLL for (int k = 0; k <= i; ++k) L[i][k] = told.S[triangle(i) + k] = P(i, k) + measured.R[i + k * A];
    const V variance = L[i][i];
    V pivot = variance;
    SIGMAX_UNROLL for (int k = 0; k < i; ++k) {
      V rest = L[i][k];
      SIGMAX_UNROLL for (int m = 0; m < k; ++m) rest -= L[i][m] * L[m][k];
      L[i][k] = rest;
      rest *= inverse[k];
      pivot -= L[i][k] * rest;
      L[k][i] = rest;  // L itself above, L D below
      whitened[i] -= rest * whitened[k];
    }
    inverse[i] = one / pivot;
    least = select<V>(pivot < least, pivot, least);
    condition *= variance * inverse[i];
    determinant *= pivot;
    squared_distance += whitened[i] * whitened[i] * inverse[i];
  }
  told.squared_distance = squared_distance;
  told.determinant = determinant;
  V Y[A][N], Z[A][N];
  SIGMAX_UNROLL for (int m = 0; m < A; ++m) {
    const V weight = select<V>(there, inverse[m], V{});
    SIGMAX_UNROLL for (int i = 0; i < N; ++i) {
      V rest = P(i, m);
      SIGMAX_UNROLL for (int k = 0; k < m; ++k) rest -= L[k][m] * Y[k][i];
      Y[m][i] = rest;
      Z[m][i] = weight * rest;
      P.x[i] += whitened[m] * Z[m][i];
    }
  }
  const V lost = select<V>(there, condition * static_cast<Number>(PrecisionOf<V>::rounding), V{});
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
  return (least >= V{}) | (measured.there <= V{});
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
  V prior[max_modes];
  V posterior[max_modes]{};
  V next_most_likely;
  V* predicted[max_modes];  ///< where the mean before the measurement goes, of one track
  Innovated<V, A> innovated[max_modes];

  explicit Step(const Plan& what) : plan(what) {}

  template <int n>
  Stored<V, n> stored(int l) const {
    return {mean[l], covariance[l]};
  }

  /// (52), (54)–(57): the mixed start of mode j, into which `coming` moves from each of the modes.
  template <int N>
  void mix(int j, const V* coming) {
    const Stored<V, N> mine = stored<N>(j);
    const Lent<V> lent(plan.lift);
    const Estimate<V, N> mixed{next_mean[j], next_covariance[j]};
    if constexpr (selects) {
      const V selected = winner<V>(plan.modes, coming, all<V>(j), plan.mixing_tie);
      SIGMAX_UNROLL for (int i = 0; i < N; ++i) {
        mixed.x[i] = mine.mean(i);
        SIGMAX_UNROLL for (int k = 0; k <= i; ++k) mixed(i, k) = mine.covariance(i, k);
      }
      for (int l = 0; l < plan.modes; ++l) {
        const Mask<V> its = selected == all<V>(l);
        if (l != j && any<V>(its))
          with_size<A>(plan.order[l], [&](auto n) { choose(Part<V, N, n>{stored<n>(l), mine, lent}, its, mixed); });
      }
      if (plan.mixed_covariance == MixedCovariance::selected || !any<V>(selected != all<V>(j))) return;
      V difference[N];
      const bool recentred = plan.mixed_covariance == MixedCovariance::own_recentred;
      SIGMAX_UNROLL for (int i = 0; i < N; ++i) {
        difference[i] = recentred ? mixed.x[i] - mine.mean(i) : V{};
        SIGMAX_UNROLL for (int k = 0; k <= i; ++k) mixed(i, k) = mine.covariance(i, k) + difference[i] * difference[k];
      }
    } else {
      const V share = all<V>(1.0) / prior[j];
      V before{};
      for (int l = 0; l < plan.modes; ++l) {
        const V w = coming[l] * share;
        with_size<A>(plan.order[l], [&](auto n) {
          const Part<V, N, n> part{stored<n>(l), mine, lent};
          if (l == 0)
            begin(part, w, mixed);
          else
            add(part, before, w, mixed);
        });
        before += w;
      }
    }
  }

  /// Returns where it is as good as the general step.
  Mask<V> take(const Measured<V, A>* measured) {
    const int modes = plan.modes;
    const auto plus = [](V sum, V term) { return selects ? select<V>(term > sum, term, sum) : sum + term; };
    const V one = all<V>(1.0), least = all<V>(PrecisionOf<V>::least_weight);
    Mask<V> good = one > V{};

    V total{}, nearest{};
    for (int j = 0; j < modes; ++j) {
      // Step 1: the prior of the mode, (51) or (53), and the mixed start.
      V coming[max_modes];
      prior[j] = V{};
      for (int i = 0; i < modes; ++i) {
        coming[i] = weight[i] * static_cast<NumberOf<V>>(plan.transition[static_cast<std::size_t>(i * modes + j)]);
        prior[j] = plus(prior[j], coming[i]);
      }
      good = good & (prior[j] > least);
      total = plus(total, prior[j]);
      with_size<A>(plan.order[j], [&](auto size) {
        constexpr int N = size;
        mix<N>(j, coming);

        // Step 2: the model predicts and updates, (60), (61).
        const Estimate<V, N> own{next_mean[j], next_covariance[j]};
        predict<A>(plan.law[j], own);
        for (int i = 0; i < N && Lane<V>::count == 1; ++i) predicted[j][i] = own.x[i];
        if (measured) good = good & update(*measured, own, innovated[j]);
        good = good & is_sound(own);
      });
      if (measured) {
        const V distance = innovated[j].squared_distance;
        nearest = j == 0 ? distance : select<V>(distance < nearest, distance, nearest);
      }
    }

    // Step 3: the weights of the modes, (62) or (63), and the most likely one, (64).
    V sum{};
    for (int j = 0; j < modes; ++j) {
      posterior[j] = prior[j];
      if (measured) {
        const V fit = exponential<V>((nearest - innovated[j].squared_distance) * NumberOf<V>(0.5));
        const bool density = plan.likelihood == LikelihoodForm::density;
        const V scale = density ? one / root<V>(innovated[j].determinant) : one;
        posterior[j] *= select<V>(measured->there > V{}, fit * scale, one);
      }
      sum = plus(sum, posterior[j]);
    }
    for (int j = 0; j < modes; ++j) {
      prior[j] /= total;
      posterior[j] /= sum;
      good = good & (posterior[j] > least);
    }
    next_most_likely = winner<V>(modes, posterior, most_likely, plan.output_tie);
    return good;
  }
};

}  // namespace
}  // namespace sigmax::detail::kinematic
