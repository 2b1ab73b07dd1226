/// One step, a prediction and an update, of each member of the Kalman family over the same target: a linear motion and
/// a coordinated turn, seen by a radar in its own space, or converted for the Kalman filter. Beside the turn's the same
/// written by hand with Eigen, in the same program, so that ratios mean something.

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <type_traits>

#include <benchmark/benchmark.h>

#include <sigmax/estimation/coordinated_turn.hpp>
#include <sigmax/estimation/cubature.hpp>
#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/estimation/doppler_sensor.hpp>
#include <sigmax/estimation/extended.hpp>
#include <sigmax/estimation/radar.hpp>
#include <sigmax/estimation/sensors.hpp>
#include <sigmax/estimation/unscented.hpp>

#include "estimation/bare_members.hpp"

namespace {

using namespace sigmax;

constexpr double T = 0.2;
constexpr Polar sigma{10.0, radians(0.002), radians(0.002)};

/// A target that circles 12 km away, with errors that repeat.
std::array<Polar, 100> measurements() {
  std::array<Polar, 100> all;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const double t = 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(all.size());
    Polar seen = to_polar({12e3 + 300.0 * std::cos(t), 8e3 + 300.0 * std::sin(t), 1e3});
    seen.range += sigma.range * std::sin(7.0 * t);
    seen.azimuth += std::cos(11.0 * t) * sigma.azimuth;
    seen.elevation += std::sin(13.0 * t) * sigma.elevation;
    all[k] = seen;
  }
  return all;
}

template <int N>
Gaussian<N> start() {
  Gaussian<N> x{Vector<N>::Zero(), SquareMatrix<N>::Identity()};
  x.mean.template head<3>() << 12.3e3, 8e3, 1e3;
  x.covariance.diagonal().template head<6>().setConstant(100.0);
  return x;
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

template <class Filter, class Sensor, class Convert>
void run(benchmark::State& state, const Filter& filter, const Sensor& sensor, const Convert& convert) {
  EstimateOf<Filter> x = start<Filter::state_size>();
  run(state, [&](const Polar& seen) {
    predict(filter, x, T, x);
    auto innovation = update(filter, x, convert(seen), sensor, x);
    benchmark::DoNotOptimize(innovation.log_likelihood);
    benchmark::DoNotOptimize(x.covariance.data());
    benchmark::ClobberMemory();
  });
}

const auto polar = [](const Polar& seen) { return PolarSensor<3>{}.measurement(seen, sigma).z; };
const auto position = [](const Polar& seen) { return to_cartesian(seen, sigma, Conversion::unbiased); };
const auto doppler = [](const Polar& seen) { return DopplerSensor<3>{}.measurement(seen, sigma, 0.0, 1.0).z; };
const auto bearing = [](const Polar& seen) { return BearingSensor{}.measurement(seen.azimuth, sigma.azimuth).z; };

template <Conversion How>
void Converted(benchmark::State& state) {
  run(state, dwna<3>(3.0), PositionSensor<3>{}, [](const Polar& seen) { return to_cartesian(seen, sigma, How); });
}
BENCHMARK(Converted<Conversion::standard>)->Name("Step/dwna/kalman_converted");
BENCHMARK(Converted<Conversion::unbiased>)->Name("Step/dwna/kalman_unbiased");
BENCHMARK(Converted<Conversion::debiased>)->Name("Step/dwna/kalman_debiased");

/// The turn by a function of any scalar, which is differentiated automatically.
struct Undifferentiated : CoordinatedTurn<3> {
  using CoordinatedTurn<3>::CoordinatedTurn;
  void transition_jacobian() const {}

  template <class Scalar>
  Eigen::Matrix<Scalar, 7, 1> propagate(const Eigen::Matrix<Scalar, 7, 1>& x, double dt) const {
    using std::cos, std::sin;
    const Scalar half = 0.5 * dt * x(6), s = sin(half), c = cos(half);
    const Scalar ratio = half * half < 1e-8 ? Scalar(1.0 - half * half / 6.0) : Scalar(s / half);
    const Scalar along = dt * ratio * c, across = dt * ratio * s, cosine = 1.0 - 2.0 * s * s, sine = 2.0 * s * c;
    Eigen::Matrix<Scalar, 7, 1> image = x;
    image(0) += along * x(3) - across * x(4);
    image(1) += across * x(3) + along * x(4);
    image(2) += dt * x(5);
    image(3) = cosine * x(3) - sine * x(4);
    image(4) = sine * x(3) + cosine * x(4);
    return image;
  }
};

constexpr double q = 9.0, q_omega = 0.01;
const auto linear = dwna<3>(3.0);
const auto accelerated = dwpa<3>(1.0);
const CoordinatedTurn<3> turn{std::sqrt(q), std::sqrt(q_omega)};
const Undifferentiated undifferentiated{std::sqrt(q), std::sqrt(q_omega)};

template <template <class> class Filter, const auto& motion, class Sensor = PolarSensor<3>, const auto& convert = polar>
void Step(benchmark::State& state) {
  run(state, Filter<std::remove_cvref_t<decltype(motion)>>{motion}, Sensor{}, convert);
}
BENCHMARK_TEMPLATE(Step, Extended, linear)->Name("Step/dwna/extended");
BENCHMARK_TEMPLATE(Step, Unscented, linear)->Name("Step/dwna/unscented");
BENCHMARK_TEMPLATE(Step, Cubature, linear)->Name("Step/dwna/cubature");
BENCHMARK_TEMPLATE(Step, Extended, turn)->Name("Step/turn/extended");
BENCHMARK_TEMPLATE(Step, Extended, undifferentiated)->Name("Step/turn/extended_autodiff");
BENCHMARK_TEMPLATE(Step, Unscented, turn)->Name("Step/turn/unscented");
BENCHMARK_TEMPLATE(Step, Cubature, turn)->Name("Step/turn/cubature");
BENCHMARK_TEMPLATE(Step, Extended, turn, PositionSensor<3>, position)->Name("Step/turn/kalman_converted");
BENCHMARK_TEMPLATE(Step, Extended, accelerated)->Name("Step/dwpa/extended");
BENCHMARK_TEMPLATE(Step, Unscented, accelerated)->Name("Step/dwpa/unscented");
BENCHMARK_TEMPLATE(Step, Cubature, accelerated)->Name("Step/dwpa/cubature");
BENCHMARK_TEMPLATE(Step, Extended, accelerated, PositionSensor<3>, position)->Name("Step/dwpa/kalman_converted");
BENCHMARK_TEMPLATE(Step, Extended, accelerated, DopplerSensor<3>, doppler)->Name("Step/dwpa/extended_doppler");
BENCHMARK_TEMPLATE(Step, Extended, accelerated, BearingSensor, bearing)->Name("Step/dwpa/extended_bearing");

template <class Filter>
void BareStep(benchmark::State& state) {
  const auto x = start<7>();
  Filter filter(T, q, q_omega, x.mean, x.covariance);
  run(state, [&](const Polar& seen) {
    const Gaussian<3> z = polar(seen);
    filter.step(z.mean, z.covariance);
    benchmark::DoNotOptimize(filter.log_likelihood);
    benchmark::DoNotOptimize(filter.P.data());
    benchmark::ClobberMemory();
  });
}
BENCHMARK(BareStep<bench::BareExtended>)->Name("BareStep/turn/extended");
BENCHMARK(BareStep<bench::BareUnscented>)->Name("BareStep/turn/unscented");
BENCHMARK(BareStep<bench::BareCubature>)->Name("BareStep/turn/cubature");

}  // namespace
