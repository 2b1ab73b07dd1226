/// What fast_path.cpp chooses from, defined for one instruction set: SIGMAX_INSTRUCTIONS names it.

#include "kinematic/kernel.hpp"
#include "kinematic/kernels.hpp"

namespace sigmax::detail::kinematic {
namespace {

/// One track along so many axes. What shuffles eight numbers is one instruction of AVX-512 alone.
template <int A>
using OneTrack = std::conditional_t<A == 3 && SIGMAX_LANE_BYTES >= 64, InSpace, Tracks<double, A>>;
constexpr double log_two_pi = 1.8378770664093454836;

template <class L, class Algebra, int Modes = 0>
[[gnu::flatten]] bool step_one(const StepPlan& plan, const double* now, std::size_t most_likely, double* next,
                               const ConstView* z, Result& result) {
  constexpr int A = L::axes;
  Step<L, Algebra, Modes> step(plan, now, next);
  step.most_likely = static_cast<double>(most_likely);
  Measured<double, A> measured;
  if (z) {
    for (int i = 0; i < A; ++i) measured.z[i] = z->mean[i];
    for (int i = 0; i < A * A; ++i) measured.R[i] = z->covariance[i];
    measured.there = 1.0;
  }
  constexpr int stride = Modes ? Modes : max_modes, lanes = Lane<Doubles>::count;
  Doubles logs[(3 * stride + lanes - 1) / lanes];  // of the weights before and after, and of the precisions
  const auto log = [&](int i) { return logs[i / lanes][i % lanes]; };
  const auto predicted = [&](int j, auto own) { L::read_mean(own, result.predicted[j]); };
  const auto weighed = [&] {
    for (auto& each : logs) each = all<Doubles>(1.0);
    SIGMAX_UNROLL for (int j = 0; j < stride; ++j) {
      if (j >= step.modes) break;
      logs[j / lanes][j % lanes] = step.prior[j] / step.total;
      logs[(stride + j) / lanes][(stride + j) % lanes] = step.posterior[j];
      if (z) logs[(2 * stride + j) / lanes][(2 * stride + j) % lanes] = step.innovated[j].precision;
    }
    for (auto& each : logs) each = logarithm(each);
  };
  if (!step.take(z ? &measured : nullptr, predicted, weighed)) return false;
  result.most_likely = static_cast<std::size_t>(step.next_most_likely);
  step.for_modes([&](int j, auto own) {
    L::read(own, result.estimate[j]);
    result.log_prior[j] = log(j);
    result.log_posterior[j] = log(stride + j);
    if (!z) return;
    const auto& innovated = step.innovated[j];
    InnovationView& innovation = result.innovation[j];
    SIGMAX_UNROLL for (int i = 0; i < A; ++i) {
      innovation.residual[i] = innovated.residual[i];
      SIGMAX_UNROLL for (int k = 0; k < A; ++k) innovation.covariance[i * A + k] =
          innovated.S[i < k ? triangle(k) + i : triangle(i) + k];
    }
    innovation.squared_distance = innovated.squared_distance;
    innovation.log_likelihood = -0.5 * innovated.squared_distance;
    if (plan.likelihood == LikelihoodForm::density)
      innovation.log_likelihood += 0.5 * (log(2 * stride + j) - A * log_two_pi);
  });
  return true;
}

/// Step 4: the output in the components of a model of the greatest order, (64)–(68), augmented by the rule in force.
/// What an augmentation borrows: each derivative that a model lacks, of the most likely model that has it, with the
/// covariances within that model.
template <class L, class Algebra, int Modes = 0>
[[gnu::flatten]] void output_one(const StepPlan& plan, const double* block, std::size_t most_likely, View result) {
  const Track<L, Modes> track(plan, block);
  with_order(result.n / L::axes, [&]<int order>(Constant<order>) {
    double weight[max_modes];
    for (int l = 0; l < track.modes; ++l) weight[l] = plan.order_of(l) == order ? track.weight[l] : -1.0;
    const double lender = winner(track.modes, weight, static_cast<double>(most_likely), plan.output_tie);
    Mixture<L, order, Modes> mixture(track, static_cast<int>(lender));
    if constexpr (SelectiveAlgebra<Algebra>) {
      mixture.select_one(static_cast<double>(most_likely));
      mixture.first = static_cast<int>(most_likely);
      mixture.last = mixture.first + 1;
    } else {
      mixture.match_moments(track.weight, 1.0);
    }
    typename L::OfPairs P[L::place(order - 1, order - 1, L::pair_vectors - 1) + 1];
    const Estimate<L, order> estimate{mixture.x, P};
    for_each<L::pair_vectors>([&](auto k) {
      typename L::OfPairs M[order][order];
      mixture.read_pair(k, M);
      SIGMAX_UNROLL for (int a = 0; a < order; ++a)
          SIGMAX_UNROLL for (int b = 0; b < order; ++b) if (!L::is_mirrored(a, b, k)) estimate(a, b, k) = M[a][b];
    });
    L::mirror(estimate);
    L::read(estimate, result);
  });
}

template <class L>
double* write_one(const StepPlan& plan, const ConstView* estimates, double* block) {
  for (int j = 0; j < plan.modes; ++j) {
    L::write(estimates[j], block);
    block += L::size(plan.order_of(j));
  }
  return block;
}

/// One step of a block of tracks, in place.
template <class L, class Algebra, class Number = NumberOf<typename L::Number>>
unsigned step_block(const StepPlan& plan, Number* block, const Number* measurements) {
  using V = typename L::Number;
  constexpr int lanes = Lane<V>::count, A = L::axes;
  V next[max_modes * L::size(3) / lanes + max_modes + 1];
  Step<L, Algebra> step(plan, block, reinterpret_cast<Number*>(next));
  Measured<V, A> measured;
  __builtin_memcpy(&measured, measurements, sizeof(measured));

  const bool some = failures<V>(measured.there == V{}) != 0;
  const Mask<V> good = step.take(
      some ? &measured : nullptr, [](auto...) {}, [] {});
  const unsigned bad = failures<V>(good);
  const auto count = (step.for_modes([](auto...) {}) - step.next) / lanes + plan.modes + 1;
  for (int t = 0; t < count; ++t)  // what is not good stays as it was
    write(block, t, bad == 0 ? next[t] : select(good, next[t], read<V>(block, t)));
  return bad;
}

template <int A, class Algebra, int Modes>
constexpr Functions functions{step_one<OneTrack<A>, Algebra, Modes>, output_one<OneTrack<A>, Algebra, Modes>,
                              write_one<OneTrack<A>>, step_block<Tracks<Doubles, A>, Algebra>,
                              step_block<Tracks<Floats, A>, Algebra>};

template <int A>
constexpr ByKind of_axes{
    {{functions<A, Sigma, 0>, functions<A, Sigma, 2>}, {functions<A, Max, 0>, functions<A, Max, 2>}}};

}  // namespace

const Kernels& SIGMAX_INSTRUCTIONS() {
  static constexpr Kernels kernels{{of_axes<1>, of_axes<2>, of_axes<3>}, SIGMAX_LANE_BYTES};
  return kernels;
}

}  // namespace sigmax::detail::kinematic
