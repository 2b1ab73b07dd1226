/// One step of the filters, with its output, beside a bare IMM as one would write it by hand with Eigen for these two
/// models and a fixed step: plainly, and with care. All in one program, so that ratios mean something.

#include <tuple>
#include <vector>

#include <benchmark/benchmark.h>

#include <sigmax/estimation/any_member.hpp>
#include <sigmax/estimation/any_motion.hpp>
#include <sigmax/hybrid/interacting_multiple_model.hpp>

#include "support/bare_imm.hpp"

namespace {

using namespace sigmax;

constexpr double T = 0.2;
constexpr double sigma_w = 3.0;

/// A target that turns now and then, measured to 10 m.
std::vector<Gaussian<3>> measurements() {
  std::vector<Gaussian<3>> all;
  unsigned state = 1;
  const auto noise = [&state] {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i)
      sum += static_cast<double>((state = state * 1664525U + 1013904223U) >> 8U) / 16777216.0;
    return 10.0 * sum;
  };
  Vector<3> x(12e3, 8e3, 1e3), v(-100.0, -100.0, 0.0);
  for (int k = 0; k < 1000; ++k) {
    const Vector<3> a = k / 50 % 4 == 1   ? Vector<3>(-30.0, -50.0, 0.0)
                        : k / 50 % 4 == 3 ? Vector<3>(30.0, 50.0, 0.0)
                                          : Vector<3>(0.0, 0.0, 0.0);
    x += T * v + 0.5 * T * T * a;
    v += T * a;
    SquareMatrix<3> R = SquareMatrix<3>::Identity() * 100.0;
    R(0, 1) = R(1, 0) = 20.0;
    all.push_back({x + Vector<3>(noise(), noise(), noise()), R});
  }
  return all;
}

Gaussian<9> start() {
  Gaussian<9> result{Vector<9>::Zero(), SquareMatrix<9>::Identity()};
  result.mean.head<6>() << 12e3, 8e3, 1e3, -100.0, -100.0, 0.0;
  result.covariance.diagonal() << 100.0, 100.0, 100.0, 400.0, 400.0, 400.0, 100.0, 100.0, 100.0;
  return result;
}

template <Uncertainty Kind>
Relation<Kind, Kind> transition(double stays, double leaves) {
  const Variable<Kind> mode{"mode", {"dwna", "dwpa"}};
  return {mode, mode, {{stays, leaves}, {leaves, stays}}};
}

template <class Step>
void run(benchmark::State& state, const Step& step) {
  const auto all = measurements();
  std::size_t k = 0;
  for (auto _ : state) {
    step(all[k]);
    k = k + 1 == all.size() ? 0 : k + 1;
  }
  state.SetItemsProcessed(state.iterations());
}

template <class Kalman>
void BareStep(benchmark::State& state) {
  support::BareImm<Kalman> filter(T, sigma_w, start().mean, start().covariance);
  run(state, [&](const Gaussian<3>& z) {
    filter.step(z.mean, z.covariance);
    filter.output();
    benchmark::DoNotOptimize(filter.P.data());
    benchmark::ClobberMemory();
  });
}
BENCHMARK(BareStep<support::PlainUpdate>)->Name("BareEigenImmStep");
BENCHMARK(BareStep<support::UpdateByBlocks>)->Name("GoodEigenImmStep");

/// A filter over the models, with the paper's transition for its kind of mode.
template <Uncertainty Kind, class Models>
void step_with_output(benchmark::State& state, const Models& models) {
  constexpr bool fuzzy = std::same_as<Kind, Fuzzy>;
  InteractingMultipleModel filter{models, fuzzy ? transition<Kind>(1.0, 0.5) : transition<Kind>(0.95, 0.05), start()};
  run(state, [&](const Gaussian<3>& z) {
    filter.step(T, z);
    auto estimate = filter.estimate();
    benchmark::DoNotOptimize(estimate.covariance.data());
    benchmark::ClobberMemory();
  });
}

template <Uncertainty Kind>
void TupleStep(benchmark::State& state) {
  step_with_output<Kind>(state, std::tuple{dwna<3>(sigma_w), dwpa<3>(sigma_w)});
}
BENCHMARK(TupleStep<Random>)->Name("ImmStep/tuple");
BENCHMARK(TupleStep<Fuzzy>)->Name("HimmStep/tuple");

template <Uncertainty Kind>
void VectorStep(benchmark::State& state) {
  using Moves = AnyMotion<9, IndependentAxes<3, DiscreteWhiteNoise<2>>, IndependentAxes<3, DiscreteWhiteNoise<3>>>;
  step_with_output<Kind>(
      state, std::vector<AnyMember<Moves>>{Extended<Moves>{dwna<3>(sigma_w)}, Extended<Moves>{dwpa<3>(sigma_w)}});
}
BENCHMARK(VectorStep<Random>)->Name("ImmStep/vector");
BENCHMARK(VectorStep<Fuzzy>)->Name("HimmStep/vector");

}  // namespace
