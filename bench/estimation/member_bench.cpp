/// One step, a prediction and an update, of each member of the Kalman family over the same target: a linear motion and
/// a coordinated turn, seen by a radar in its own space, or converted for the Kalman filter.

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <type_traits>

#include <benchmark/benchmark.h>

#include <sigmax/estimation/converted_measurement.hpp>
#include <sigmax/estimation/coordinated_turn.hpp>
#include <sigmax/estimation/cubature.hpp>
#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/estimation/extended.hpp>
#include <sigmax/estimation/sensors.hpp>
#include <sigmax/estimation/unscented.hpp>

namespace {

using namespace sigmax;

constexpr double T = 0.2;
constexpr Polar sigma{10.0, 0.002, 0.002};

/// A target that circles 12 km away, with errors that repeat.
std::array<Polar, 100> measurements() {
  std::array<Polar, 100> all;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const double t = 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(all.size());
    Polar seen = to_polar({12e3 + 300.0 * std::cos(t), 8e3 + 300.0 * std::sin(t), 1e3});
    seen.range += sigma.range * std::sin(7.0 * t);
    seen.azimuth += sigma.azimuth * std::cos(11.0 * t);
    seen.elevation += sigma.elevation * std::sin(13.0 * t);
    all[k] = seen;
  }
  return all;
}

template <class Filter, class Sensor, class Convert>
void run(benchmark::State& state, const Filter& filter, const Sensor& sensor, const Convert& convert) {
  const auto all = measurements();
  EstimateOf<Filter> x;
  x.mean.setZero(filter.size());
  x.mean.template head<3>() << 12.3e3, 8e3, 1e3;
  x.covariance.setIdentity(filter.size(), filter.size());
  x.covariance.diagonal().template head<6>().setConstant(100.0);
  std::size_t k = 0;
  for (auto _ : state) {
    predict(filter, x, T, x);
    update(filter, x, convert(all[k]), sensor, x);
    benchmark::DoNotOptimize(x.covariance.data());
    benchmark::ClobberMemory();
    k = k + 1 == all.size() ? 0 : k + 1;
  }
  state.SetItemsProcessed(state.iterations());
}

const auto polar = [](const Polar& seen) { return PolarSensor<3>::measurement(seen, sigma); };

template <Conversion How>
void Converted(benchmark::State& state) {
  run(state, dwna<3>(3.0), PositionSensor<3>{}, [](const Polar& seen) { return to_cartesian(seen, sigma, How); });
}
BENCHMARK(Converted<Conversion::standard>)->Name("Step/dwna/kalman_converted");
BENCHMARK(Converted<Conversion::unbiased>)->Name("Step/dwna/kalman_unbiased");
BENCHMARK(Converted<Conversion::debiased>)->Name("Step/dwna/kalman_debiased");

/// The turn without its Jacobians.
struct Undifferentiated : CoordinatedTurn<3> {
  using CoordinatedTurn<3>::CoordinatedTurn;
  void transition_jacobian() const {}
};

const auto linear = dwna<3>(3.0);
const CoordinatedTurn<3> turn{9.0, 0.01};
const Undifferentiated undifferentiated{9.0, 0.01};

template <template <class> class Filter, const auto& motion>
void Step(benchmark::State& state) {
  run(state, Filter<std::remove_cvref_t<decltype(motion)>>{motion}, PolarSensor<3>{}, polar);
}
BENCHMARK_TEMPLATE(Step, Extended, linear)->Name("Step/dwna/extended");
BENCHMARK_TEMPLATE(Step, Unscented, linear)->Name("Step/dwna/unscented");
BENCHMARK_TEMPLATE(Step, Cubature, linear)->Name("Step/dwna/cubature");
BENCHMARK_TEMPLATE(Step, Extended, turn)->Name("Step/turn/extended");
BENCHMARK_TEMPLATE(Step, Extended, undifferentiated)->Name("Step/turn/extended_autodiff");
BENCHMARK_TEMPLATE(Step, Unscented, turn)->Name("Step/turn/unscented");
BENCHMARK_TEMPLATE(Step, Cubature, turn)->Name("Step/turn/cubature");

}  // namespace
