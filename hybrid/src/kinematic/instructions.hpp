/// What shortcut.cpp chooses from, defined for one instruction set: SIGMAX_INSTRUCTIONS names it.

#include "kinematic/kernel.hpp"
#include "kinematic/kernels.hpp"

namespace sigmax::detail::kinematic {
namespace {

constexpr std::size_t place(int j) { return static_cast<std::size_t>(j); }

/// The upper triangle from the lower.
template <int N>
inline void mirror(double* covariance) {
  SIGMAX_UNROLL for (int i = 0; i < N; ++i) SIGMAX_UNROLL for (int k = 0; k < i; ++k) covariance[k * N + i] =
      covariance[i * N + k];
}

template <int A, bool selects>
bool step_one(const Plan& plan, const Track& now, const double* z, const double* R, Told& told) {
  Step<double, A, selects> step(plan);
  for (int j = 0; j < plan.modes; ++j) {
    step.mean[j] = now.mean[j];
    step.covariance[j] = now.covariance[j];
    step.next_mean[j] = told.mean[j];
    step.next_covariance[j] = told.covariance[j];
    step.predicted[j] = told.predicted[j];
    step.weight[j] = now.weight[j];
  }
  step.most_likely = static_cast<double>(now.most_likely);
  Measured<double, A> measured;
  if (z) {
    for (int i = 0; i < A; ++i) measured.z[i] = z[i];
    for (int i = 0; i < A * A; ++i) measured.R[i] = R[i];
    measured.there = 1.0;
  }
  if (!step.take(z ? &measured : nullptr)) return false;
  for (int j = 0; j < plan.modes; ++j) {
    with_size<A>(plan.order[place(j)], [&](auto N) { mirror<N>(told.covariance[j]); });
    told.prior[j] = step.prior[j] / step.total;
    told.posterior[j] = step.posterior[j];
    if (!z) continue;
    const auto& innovated = step.innovated[j];
    SIGMAX_UNROLL for (int i = 0; i < A; ++i) {
      told.residual[j][i] = innovated.residual[i];
      SIGMAX_UNROLL for (int k = 0; k < A; ++k) told.S[j][i * A + k] =
          innovated.S[i < k ? triangle(k) + i : triangle(i) + k];
    }
    told.squared_distance[j] = innovated.squared_distance;
    told.precision[j] = innovated.precision;
  }
  return true;
}

/// Step 4: the output in the components of a model of the greatest order, (64)–(68), augmented by the rule in force.
/// What an augmentation borrows: each derivative that a model lacks, of the most likely model that has it, with the
/// covariances within that model.
template <int A, bool selects>
void output_one(const Plan& plan, const Track& track, double* mean, double* covariance) {
  int greatest = 0;
  for (int l = 0; l < plan.modes; ++l) greatest = plan.order[place(l)] > greatest ? plan.order[place(l)] : greatest;
  with_size<A>(greatest, [&](auto size) {
    constexpr int N = size;
    double weight[max_modes], most_likely = static_cast<double>(track.most_likely);
    for (int l = 0; l < plan.modes; ++l) weight[l] = plan.order[place(l)] == greatest ? track.weight[l] : -1.0;
    const double lender = winner<double>(plan.modes, weight, most_likely, plan.output_tie);
    Mixture<double, A, N> mixture(plan, track.mean, track.covariance, static_cast<int>(lender));
    if constexpr (selects) {
      const int l = mixture.first = static_cast<int>(track.most_likely);
      mixture.last = l + 1;
      mixture.weight[l] = 1.0;
      with_size<A>(plan.order[track.most_likely], [&](auto n) {
        SIGMAX_UNROLL for (int i = 0; i < N; ++i) mixture.x[i] = mixture.template mean_of<n>(l, i);
      });
    } else {
      mixture.match_moments(track.weight, 1.0);
    }
    SIGMAX_UNROLL for (int i = 0; i < N; ++i) mean[i] = mixture.x[i];
    mixture.write({mean, covariance}, [](auto, auto, auto&) {});
    mirror<N>(covariance);
  });
}

/// One step of a block of tracks, in place. A bit for each track that must take the general step, and is as it was.
template <class V, int A, bool selects, class Number = NumberOf<V>>
unsigned step_block(const Plan& plan, Number* block, const Number* measurements) {
  constexpr int lanes = Lane<V>::count;
  Step<V, A, selects> step(plan);
  const Number* from = block;
  V next[max_modes][max_state_size + triangle(max_state_size)];
  for (int j = 0; j < plan.modes; ++j) {
    const int n = plan.state_size(j);
    step.mean[j] = from;
    step.covariance[j] = from + n * lanes;
    step.next_mean[j] = next[j];
    step.next_covariance[j] = next[j] + n;
    from = step.covariance[j] + triangle(n) * lanes;
  }
  for (int j = 0; j < plan.modes; ++j) step.weight[j] = read<V>(from, j);
  step.most_likely = read<V>(from, plan.modes);
  Measured<V, A> measured;
  for (int i = 0; i < A; ++i) measured.z[i] = read<V>(measurements, i);
  for (int i = 0; i < A * A; ++i) measured.R[i] = read<V>(measurements, A + i);
  measured.there = read<V>(measurements, A + A * A);

  bool some = false;
  for (int lane = 0; lane < lanes; ++lane) some |= measurements[(A + A * A) * lanes + lane] > 0;

  const Mask<V> good = step.take(some ? &measured : nullptr);
  const unsigned bad = failures<V>(good);
  auto write = [&, to = block](const V* number, int count) mutable {  // what is not good stays as it was
    for (int t = 0; t < count; ++t) {
      const V kept = bad == 0 ? number[t] : select<V>(good, number[t], read<V>(to, 0));
      __builtin_memcpy(to, &kept, sizeof(V));
      to += lanes;
    }
  };
  for (int j = 0; j < plan.modes; ++j) write(next[j], plan.state_size(j) + triangle(plan.state_size(j)));
  write(step.posterior, plan.modes);
  write(&step.next_most_likely, 1);
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
