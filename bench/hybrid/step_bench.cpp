/// One step of the filters, with its output, beside a bare IMM as one would write it by hand with Eigen for these two
/// models and a fixed step: plainly, and with care. All in one program, so that ratios mean something.

#include <tuple>
#include <vector>

#include <benchmark/benchmark.h>

#include <sigmax/estimation/any_model.hpp>
#include <sigmax/hybrid/any_target.hpp>
#include <sigmax/hybrid/interacting_multiple_model.hpp>

#include "hybrid/bare_imm.hpp"
#include "hybrid/paper_step.hpp"

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

/// Whether what is compared does the same work, to 1e-9 of each number from one on.
template <class Kalman>
bool is_the_librarys() {
  BareImm<Kalman> bare(T, sigma_w, start().mean, start().covariance);
  InteractingMultipleModel filter{std::tuple{dwna<3>(sigma_w), dwpa<3>(sigma_w)}, transition<Random>(), start()};
  for (const auto& z : measurements()) {
    bare.step(z.mean, z.covariance);
    filter.step(T, z);
  }
  bare.output();
  const auto estimate = filter.estimate();
  const auto near = [](const auto& a, const auto& b) {
    return ((a - b).array().abs() <= 1e-9 * b.array().abs().max(1.0)).all();
  };
  return near(bare.x, estimate.mean) && near(bare.P, estimate.covariance);
}

template <class Kalman>
void BareStep(benchmark::State& state) {
  if (!is_the_librarys<Kalman>()) return state.SkipWithError("its output is not the library's");
  BareImm<Kalman> filter(T, sigma_w, start().mean, start().covariance);
  run(state, [&](const Gaussian<3>& z) {
    filter.step(z.mean, z.covariance);
    filter.output();
    benchmark::DoNotOptimize(filter.P.data());
    benchmark::ClobberMemory();
  });
}
BENCHMARK(BareStep<PlainUpdate>)->Name("BareEigenImmStep");
BENCHMARK(BareStep<UpdateByBlocks>)->Name("GoodEigenImmStep");

template <Uncertainty Kind, class Models>
void step_with_output(benchmark::State& state, const Models& models,
                      const Relation<Kind, Kind>& mode_transition = transition<Kind>()) {
  InteractingMultipleModel filter{models, mode_transition, start()};
  run(state, [&](const Gaussian<3>& z) {
    filter.step(T, z, PositionSensor<3>{});
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
  step_with_output<Kind>(state, std::vector<AnyModel>{dwna<3>(sigma_w), dwpa<3>(sigma_w)});
}
BENCHMARK(VectorStep<Random>)->Name("ImmStep/vector");
BENCHMARK(VectorStep<Fuzzy>)->Name("HimmStep/vector");

/// How it grows with the number of models: DWNA and DWPA in turn, each of its own noise.
void ModesStep(benchmark::State& state) {
  const auto modes = static_cast<std::size_t>(state.range(0));
  std::vector<AnyModel> models;
  for (std::size_t j = 0; j < modes; ++j) {
    const double sigma = 1.0 + static_cast<double>(j);
    models.push_back(j % 2 == 0 ? AnyModel(dwna<3>(sigma)) : AnyModel(dwpa<3>(sigma)));
  }
  const RandomVariable mode{"mode", modes};
  const double leaves = 0.05 / static_cast<double>(modes - 1);
  std::vector<std::vector<double>> rows(modes, std::vector<double>(modes, leaves));
  for (std::size_t j = 0; j < modes; ++j) rows[j][j] = 0.95;
  step_with_output(state, models, Relation<Random, Random>{mode, mode, rows});
}
BENCHMARK(ModesStep)->Name("ImmStep/models")->Arg(2)->Arg(3)->Arg(4)->Arg(5)->Arg(8)->Arg(16);

/// A recording, its models chosen at run time: what `track` of the Python package does.
void FollowRecording(benchmark::State& state) {
  std::vector<AnyDetection> detections;
  for (const auto& z : measurements())
    detections.push_back(AnyDetection::position(T * static_cast<double>(detections.size()), {z.mean.data(), 3},
                                                {z.covariance.data(), 9}));
  const TargetChoice choice{
      .motions = {{"dwna"}, {"dwpa"}}, .models = {"dwna", "dwpa"}, .transition = {{0.95, 0.05}, {0.05, 0.95}}};
  for (auto _ : state)
    AnyTarget(choice).follow(detections, [](const TargetPoint& point) { benchmark::DoNotOptimize(point.mean.data()); });
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(detections.size()));
}
BENCHMARK(FollowRecording);

}  // namespace
