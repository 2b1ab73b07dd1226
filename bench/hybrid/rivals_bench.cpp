/// One step of every multiple-model filter over the same two models, with its output, and one step back of the
/// smoother.

#include <tuple>
#include <vector>

#include <benchmark/benchmark.h>

#include <sigmax/hybrid/fixed_interval_smoother.hpp>
#include <sigmax/hybrid/interacting_multiple_model.hpp>
#include <sigmax/hybrid/second_order_multiple_model.hpp>

#include "hybrid/paper_step.hpp"

namespace {

using namespace sigmax;
using namespace sigmax::bench;

const std::tuple models{dwna<3>(sigma_w), dwpa<3>(sigma_w)};

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
  run(state, InteractingMultipleModel{models, identity(transition<Kind>().to()), start()});
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
