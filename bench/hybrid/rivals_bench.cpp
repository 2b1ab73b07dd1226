/// One step of every multiple-model filter over the same two models, with its output, and one step back of the
/// smoother.

#include <tuple>
#include <vector>

#include <benchmark/benchmark.h>

#include <sigmax/hybrid/fixed_interval_smoother.hpp>
#include <sigmax/hybrid/interacting_multiple_model.hpp>
#include <sigmax/hybrid/second_order_multiple_model.hpp>

namespace {

using namespace sigmax;

constexpr double T = 0.2;
const std::tuple models{dwna<3>(3.0), dwpa<3>(3.0)};

/// A target that turns now and then; what is measured is exact, which costs a filter nothing.
std::vector<Gaussian<3>> measurements() {
  std::vector<Gaussian<3>> all;
  Vector<3> x(12e3, 8e3, 1e3), v(-100.0, -100.0, 0.0);
  for (int k = 0; k < 1000; ++k) {
    const double sign = k / 50 % 4 == 1 ? -1.0 : k / 50 % 4 == 3 ? 1.0 : 0.0;
    const Vector<3> a = sign * Vector<3>(30.0, 50.0, 0.0);
    x += T * v + 0.5 * T * T * a;
    v += T * a;
    all.push_back({x, 100.0 * SquareMatrix<3>::Identity()});
  }
  return all;
}

Gaussian<9> start() {
  Gaussian<9> result{Vector<9>::Zero(), 100.0 * SquareMatrix<9>::Identity()};
  result.mean.head<6>() << 12e3, 8e3, 1e3, -100.0, -100.0, 0.0;
  return result;
}

template <Uncertainty Kind>
const Variable<Kind> mode_of{"mode", {"dwna", "dwpa"}};

/// The paper's transition for a mode of this kind.
template <Uncertainty Kind>
Relation<Kind, Kind> transition() {
  const double stays = std::same_as<Kind, Fuzzy> ? 1.0 : 0.95, leaves = std::same_as<Kind, Fuzzy> ? 0.5 : 0.05;
  return {mode_of<Kind>, mode_of<Kind>, {{stays, leaves}, {leaves, stays}}};
}

template <class Filter>
void run(benchmark::State& state, Filter filter) {
  const auto all = measurements();
  std::size_t k = 0;
  for (auto _ : state) {
    filter.step(T, all[k]);
    auto estimate = filter.estimate();
    benchmark::DoNotOptimize(estimate.covariance.data());
    benchmark::ClobberMemory();
    if (++k == all.size()) {
      state.PauseTiming();
      filter.restart(start());
      k = 0;
      state.ResumeTiming();
    }
  }
}

template <Uncertainty Kind>
void Interacting(benchmark::State& state) {
  run(state, InteractingMultipleModel{models, transition<Kind>(), start()});
}
BENCHMARK(Interacting<Random>)->Name("Step/IMM");
BENCHMARK(Interacting<Fuzzy>)->Name("Step/HIMM");

template <Uncertainty Kind>
void Common(benchmark::State& state) {
  Interaction<Kind> interaction;
  interaction.mixed_start = MixedStart::common;
  run(state, InteractingMultipleModel{models, transition<Kind>(), start(), interaction});
}
BENCHMARK(Common<Random>)->Name("Step/GPB1");
BENCHMARK(Common<Fuzzy>)->Name("Step/HIMM, one arg max");

template <Uncertainty Kind>
void SecondOrder(benchmark::State& state) {
  run(state, SecondOrderMultipleModel{models, transition<Kind>(), start()});
}
BENCHMARK(SecondOrder<Random>)->Name("Step/GPB2");
BENCHMARK(SecondOrder<Fuzzy>)->Name("Step/Viterbi");

template <Uncertainty Kind>
void Static(benchmark::State& state) {
  run(state, InteractingMultipleModel{models, identity(mode_of<Kind>), start()});
}
BENCHMARK(Static<Random>)->Name("Step/static bank");

template <Uncertainty Kind>
void StepBack(benchmark::State& state) {
  InteractingMultipleModel filter{models, transition<Kind>(), start()};
  std::vector record{filter.recorded(0.0)};
  for (const auto& z : measurements()) {
    filter.step(T, z);
    record.push_back(filter.recorded(T, z));
  }
  FixedIntervalSmoother<Kind> smoother{filter};
  smoother.begin(record.back());
  std::size_t k = record.size() - 1;
  for (auto _ : state) {
    smoother.step(record[--k]);
    benchmark::DoNotOptimize(&smoother.state());
    if (k == 0) {
      smoother.begin(record.back());
      k = record.size() - 1;
    }
  }
}
BENCHMARK(StepBack<Random>)->Name("StepBack/IMM");
BENCHMARK(StepBack<Fuzzy>)->Name("StepBack/HIMM");

}  // namespace
