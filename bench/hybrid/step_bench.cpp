/// One step of the filters, with its output, beside a bare IMM as one would write it by hand with Eigen for these two
/// models and a fixed step: plainly, and with care. All in one program, so that ratios mean something.

#include <tuple>
#include <vector>

#include <benchmark/benchmark.h>

#include <sigmax/estimation/any_member.hpp>
#include <sigmax/estimation/any_motion.hpp>
#include <sigmax/hybrid/interacting_multiple_model.hpp>

#include "hybrid/paper_step.hpp"
#include "support/bare_imm.hpp"

namespace {

using namespace sigmax;
using namespace sigmax::bench;

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

template <Uncertainty Kind, class Models>
void step_with_output(benchmark::State& state, const Models& models) {
  InteractingMultipleModel filter{models, transition<Kind>(), start()};
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

using Moves = AnyMotion<9, IndependentAxes<3, DiscreteWhiteNoise<2>>, IndependentAxes<3, DiscreteWhiteNoise<3>>>;

template <Uncertainty Kind>
void VectorStep(benchmark::State& state) {
  step_with_output<Kind>(
      state, std::vector<AnyMember<Moves>>{Extended<Moves>{dwna<3>(sigma_w)}, Extended<Moves>{dwpa<3>(sigma_w)}});
}
BENCHMARK(VectorStep<Random>)->Name("ImmStep/vector");
BENCHMARK(VectorStep<Fuzzy>)->Name("HimmStep/vector");

/// How it grows with the number of models: DWNA and DWPA in turn, each of its own noise.
void ModesStep(benchmark::State& state) {
  const auto modes = static_cast<std::size_t>(state.range(0));
  std::vector<AnyMember<Moves>> models;
  for (std::size_t j = 0; j < modes; ++j) {
    const double sigma = 1.0 + static_cast<double>(j);
    models.emplace_back(j % 2 == 0 ? Extended<Moves>{dwna<3>(sigma)} : Extended<Moves>{dwpa<3>(sigma)});
  }
  const RandomVariable mode{"mode", modes};
  const double leaves = 0.05 / static_cast<double>(modes - 1);
  std::vector<std::vector<double>> rows(modes, std::vector<double>(modes, leaves));
  for (std::size_t j = 0; j < modes; ++j) rows[j][j] = 0.95;
  InteractingMultipleModel filter{models, Relation<Random, Random>{mode, mode, rows}, start()};
  run(state, [&](const Gaussian<3>& z) {
    filter.step(T, z);
    auto estimate = filter.estimate();
    benchmark::DoNotOptimize(estimate.covariance.data());
    benchmark::ClobberMemory();
  });
}
BENCHMARK(ModesStep)->Name("ImmStep/models")->Arg(2)->Arg(3)->Arg(4)->Arg(5)->Arg(8)->Arg(16);

}  // namespace
