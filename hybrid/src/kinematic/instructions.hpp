/// What dispatch.cpp chooses from, defined for one instruction set: SIGMAX_INSTRUCTIONS names it.

#include "kinematic/kernel.hpp"
#include "kinematic/kernels.hpp"

namespace sigmax::detail::kinematic {
namespace {

/// A column of A numbers from memory, and to it; `whole` if a fourth number follows, which may be overwritten.
template <int A>
SIGMAX_INLINE Quad load(const double* from) {
  if constexpr (A == 1) return Quad{from[0]};
  if constexpr (A == 2) return Quad{from[0], from[1]};
  return Quad{from[0], from[1], from[2]};
}
template <int A>
SIGMAX_INLINE void store(Quad column, double* to, bool whole) {
  if (whole)
    __builtin_memcpy(to, &column, sizeof(Quad));
  else
    __builtin_memcpy(to, &column, A * sizeof(double));
}

/// Of a whole matrix, the blocks on and below the diagonal.
template <int A>
SIGMAX_INLINE void load(int order, const double* mean, const double* covariance, Estimate<Quad, A>& estimate) {
  with_order(order, [&](auto known) {
    constexpr int Order = decltype(known)::value;
#pragma GCC unroll 8
    for (int a = 0; a < Order; ++a) estimate.x[a] = load<A>(mean + a * A);
    for_each_column<A, Order>(
        [&](int a, int b, int k) { estimate.P[at(a, b)][k] = load<A>(covariance + (b * A + k) * Order * A + a * A); });
  });
}

/// Into a whole matrix, in the order of memory: what spills over a column is overwritten by the next one.
template <int A>
SIGMAX_INLINE void store(int order, const Estimate<Quad, A>& estimate, double* mean, double* covariance) {
  with_order(order, [&](auto known) {
    constexpr int Order = decltype(known)::value;
#pragma GCC unroll 8
    for (int a = 0; a < Order; ++a) store<A>(estimate.x[a], mean + a * A, a * A + 4 <= Order * A);
    Quad above[triangle(Order)][A];
    for (int block = 0; block < triangle(Order); ++block) transpose<A>(estimate.P[block], above[block]);
    for (int a = 0; a < Order; ++a) {  // symmetric to the bit
      const Quad* const block = estimate.P[at(a, a)];
      Quad* const mirrored = above[at(a, a)];
      mirrored[0] = block[0];
      if constexpr (A > 1) mirrored[1] = __builtin_shufflevector(mirrored[1], block[1], 0, 5, 6, 7);
      if constexpr (A > 2) mirrored[2] = __builtin_shufflevector(mirrored[2], block[2], 0, 1, 6, 7);
    }
    constexpr int N = Order * A;
#pragma GCC unroll 8
    for (int b = 0; b < Order; ++b)
#pragma GCC unroll 8
      for (int k = 0; k < A; ++k)
#pragma GCC unroll 8
        for (int a = 0; a < Order; ++a) {
          const Quad& column = a > b ? estimate.P[at(a, b)][k] : above[at(b, a)][k];
          const int place = (b * A + k) * N + a * A;
          store<A>(column, covariance + place, place + 4 <= N * N);
        }
  });
}

template <int A, bool selects>
bool step_one(const Plan& plan, const Track& now, const double* z, const double* R, Track& next, Told& told) {
  const auto index = [](int j) { return static_cast<std::size_t>(j); };
  Estimate<Quad, A> before[max_modes], after[max_modes];
  for (int j = 0; j < plan.modes; ++j)
    load<A>(plan.order[index(j)], now.mean[index(j)], now.covariance[index(j)], before[j]);
  Step<Quad, A> step(plan, before, now.weight.data(), static_cast<double>(now.most_likely), after);
  Measured<Quad, A> measured{};
  if (z) {
    measured.z = load<A>(z);
    for (int k = 0; k < A; ++k) measured.R[k] = load<A>(R + k * A);
    measured.there = 1.0;
  }
  if (!step.template take<selects>(z ? &measured : nullptr)) return false;
  for (int j = 0; j < plan.modes; ++j) {
    store<A>(plan.order[index(j)], after[j], next.mean[index(j)], next.covariance[index(j)]);
    told.log_prior[index(j)] = __builtin_log(step.prior[j]);
    told.log_posterior[index(j)] = z ? __builtin_log(step.posterior[j]) : told.log_prior[index(j)];
    for (int a = 0; a < plan.order[index(j)]; ++a)
      for (int k = 0; k < A; ++k) told.predicted[index(j)][index(a * A + k)] = step.predicted[j][a][k];
    if (!z) continue;
    const auto& innovated = step.innovated[j];
    for (int i = 0; i < A; ++i) {
      told.residual[index(j)][index(i)] = innovated.residual[i];
      for (int k = 0; k < A; ++k) told.S[index(j)][index(i * A + k)] = i < k ? innovated.S[i][k] : innovated.S[k][i];
    }
    told.squared_distance[index(j)] = innovated.squared_distance;
    told.log_determinant[index(j)] = __builtin_log(innovated.determinant);
  }
  return true;
}

template <int A, bool selects>
void output_one(const Plan& plan, const Track& track, double* mean, double* covariance) {
  const auto index = [](int j) { return static_cast<std::size_t>(j); };
  Estimate<Quad, A> parts[max_modes], result;
  double weight[max_modes]{};
  int greatest = 1;
  for (int j = 0; j < plan.modes; ++j) {
    load<A>(plan.order[index(j)], track.mean[index(j)], track.covariance[index(j)], parts[j]);
    weight[j] = track.weight[index(j)];
    if (plan.order[index(j)] > greatest) greatest = plan.order[index(j)];
  }
  with_order(greatest, [&](auto order) {
    output<Quad, A, decltype(order)::value, selects>(plan, parts, weight, static_cast<double>(track.most_likely),
                                                     result);
  });
  store<A>(greatest, result, mean, covariance);
}

/// Reads and writes the numbers of a block of tracks, one after another: for each model the mean and the columns of the
/// covariance's lower blocks, of diagonal ones from the diagonal down; then the weights of the modes.
template <class V, int A>
struct Block {
  typename LaneOf<V>::Real* at;

  SIGMAX_INLINE void operator()(V& lanes, bool reads) {
    if (reads)
      __builtin_memcpy(&lanes, at, sizeof(V));
    else
      __builtin_memcpy(at, &lanes, sizeof(V));
    at += LaneOf<V>::count;
  }
  SIGMAX_INLINE void pass(const Plan& plan, Estimate<Axes<V, A>, A>* parts, V* weight, V& most_likely, bool reads) {
    for (int j = 0; j < plan.modes; ++j)
      with_order(plan.order[static_cast<std::size_t>(j)], [&](auto order) {
        constexpr int Order = decltype(order)::value;
        for (int a = 0; a < Order; ++a)
          for (int i = 0; i < A; ++i) (*this)(parts[j].x[a][i], reads);
        for_each_column<A, Order>([&](int a, int b, int k) {
          for (int i = a == b ? k : 0; i < A; ++i) (*this)(parts[j].P[at_block(a, b)][k][i], reads);
        });
      });
    for (int j = 0; j < plan.modes; ++j) (*this)(weight[j], reads);
    (*this)(most_likely, reads);
  }
  static constexpr int at_block(int a, int b) { return kinematic::at(a, b); }
};

/// One step of a block of tracks, in place. `measurements` is for each lane z, the columns of R, and one where there is
/// a measurement. A bit for each track that must take the general step, and is as it was.
template <class V, int A, bool selects, class Number = typename LaneOf<V>::Real>
unsigned step_block(const Plan& plan, Number* block, const Number* measurements) {
  using C = Axes<V, A>;
  Estimate<C, A> before[max_modes], after[max_modes];
  V weight[max_modes], most_likely{};
  Block<V, A>{block}.pass(plan, before, weight, most_likely, true);
  Measured<C, A> measured;
  Block<V, A> reader{const_cast<Number*>(measurements)};  // it only reads
  for (int i = 0; i < A; ++i) reader(measured.z[i], true);
  for (int k = 0; k < A; ++k)
    for (int i = 0; i < A; ++i) reader(measured.R[k][i], true);
  reader(measured.there, true);
  Step<C, A> step(plan, before, weight, most_likely, after);
  const MaskOf<V> good = step.template take<selects>(&measured);
  unsigned bad = 0;
  for (int lane = 0; lane < LaneOf<V>::count; ++lane)
    if (!good[lane]) bad |= 1U << static_cast<unsigned>(lane);
  if (bad == 0) {
    Block<V, A>{block}.pass(plan, after, step.posterior, step.next_most_likely, false);
    return bad;
  }
  for (int j = 0; j < plan.modes; ++j) {
    const int order = plan.order[static_cast<std::size_t>(j)];
    for (int a = 0; a < order; ++a) after[j].x[a] = select(good, after[j].x[a], before[j].x[a]);
    for (int of = 0; of < triangle(order); ++of)
      for (int k = 0; k < A; ++k) after[j].P[of][k] = select(good, after[j].P[of][k], before[j].P[of][k]);
    step.posterior[j] = select(good, step.posterior[j], weight[j]);
  }
  step.next_most_likely = select(good, step.next_most_likely, most_likely);
  Block<V, A>{block}.pass(plan, after, step.posterior, step.next_most_likely, false);
  return bad;
}

}  // namespace

const Kernels& SIGMAX_INSTRUCTIONS() {
  static constexpr Kernels kernels{{{step_one<1, false>, step_one<1, true>},
                                    {step_one<2, false>, step_one<2, true>},
                                    {step_one<3, false>, step_one<3, true>}},
                                   {{output_one<1, false>, output_one<1, true>},
                                    {output_one<2, false>, output_one<2, true>},
                                    {output_one<3, false>, output_one<3, true>}},
                                   {{step_block<Doubles, 1, false>, step_block<Doubles, 1, true>},
                                    {step_block<Doubles, 2, false>, step_block<Doubles, 2, true>},
                                    {step_block<Doubles, 3, false>, step_block<Doubles, 3, true>}},
                                   {{step_block<Floats, 1, false>, step_block<Floats, 1, true>},
                                    {step_block<Floats, 2, false>, step_block<Floats, 2, true>},
                                    {step_block<Floats, 3, false>, step_block<Floats, 3, true>}},
                                   SIGMAX_LANE_BYTES};
  return kernels;
}

}  // namespace sigmax::detail::kinematic
