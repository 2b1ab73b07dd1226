// Sensors that take turns, step by step, in one multiple-model filter, against the restatement.
#include <gtest/gtest.h>

#include <cmath>
#include <concepts>
#include <random>

#include <sigmax/estimation/any_sensor.hpp>

#include "hybrid/laws.hpp"
#include "support/nonlinear_restatement.hpp"

namespace sigmax {
namespace {

using namespace support;

/// A position, a radar away from the origin, a bearing taken from across the ±180° line, or nothing.
enum class Turn { position, polar, bearing, nothing };

struct Sighting {
  double dt;
  Turn turn;
  Gaussian<2> position, polar;
  Gaussian<1> bearing;
};
const Vector<2> radar_at(14000.0, 6000.0), camera_at(30000.0, 7000.0);

/// The manoeuvring target, seen by each in turn.
std::vector<Sighting> sightings(std::size_t count) {
  std::mt19937_64 generator(23);
  std::normal_distribution<double> normal;
  std::vector<Sighting> result;
  for (const Scan& scan : manoeuvring_target(count)) {
    Sighting next{scan.dt, scan.z ? static_cast<Turn>(result.size() % 3) : Turn::nothing, {}, {}, {}};
    if (scan.z) {
      next.position = *scan.z;
      const Vector<2> from_radar = scan.z->mean - radar_at, from_camera = scan.z->mean - camera_at;
      next.polar = {Vector<2>(from_radar.norm() + 5.0 * normal(generator),
                              std::atan2(from_radar(1), from_radar(0)) + 0.002 * normal(generator)),
                    SquareMatrix<2>{{25.0, 0.001}, {0.001, 4e-6}}};
      next.bearing = {Vector<1>(std::atan2(from_camera(1), from_camera(0)) + 0.003 * normal(generator)),
                      SquareMatrix<1>(9e-6)};
    }
    result.push_back(next);
  }
  return result;
}

template <class Filter>
void see(Filter& filter, const Sighting& seen) {
  switch (seen.turn) {
    case Turn::position:
      return filter.step(seen.dt, seen.position);
    case Turn::polar:
      return filter.step(seen.dt, seen.polar, PolarSensor<2>{radar_at});
    case Turn::bearing:
      return filter.step(seen.dt, seen.bearing, BearingSensor{camera_at});
    case Turn::nothing:
      return filter.step(seen.dt);
  }
}
template <std::derived_from<restatement::Filter> Restated>
void see(Restated& filter, const Sighting& seen) {
  switch (seen.turn) {
    case Turn::position:
      return filter.step(seen.dt, entries(seen.position.mean), dense(seen.position.covariance));
    case Turn::polar:
      return filter.step(seen.dt, restatement::seen_by_radar(entries(seen.polar.mean), radar_at(0), radar_at(1)),
                         dense(seen.polar.covariance));
    case Turn::bearing:
      return filter.step(seen.dt, restatement::seen_by_bearing(seen.bearing.mean(0), camera_at(0), camera_at(1)),
                         dense(seen.bearing.covariance));
    case Turn::nothing:
      return filter.step(seen.dt);
  }
}

/// Some moves are impossible, so that some pairs of modes are not there whatever measures.
template <Uncertainty Kind>
Relation<Kind, Kind> with_gaps() {
  return std::is_same_v<Kind, Random> ? transition_by<Kind>({{0.8, 0.2, 0.0}, {0.0, 0.7, 0.3}, {0.25, 0.0, 0.75}})
                                      : transition_by<Kind>({{1.0, 0.5, 0.0}, {0.0, 1.0, 0.5}, {0.25, 0.0, 1.0}});
}

template <class Order, Uncertainty Kind>
void sensors_take_turns() {
  for (const auto& transition : {transition_of<Kind>(), with_gaps<Kind>()}) {
    const VectorBank models{calm(1.0), calm(5.0), turning()};
    Filter<Order, Kind> filter{models, transition, starts()};
    auto expected = restated<Order, Kind>(models, transition, starts(), {});
    double least = 0.0, greatest = 0.0;
    for (const Sighting& seen : sightings(150)) {
      see(filter, seen);
      see(expected, seen);
      ASSERT_TRUE(agrees(filter, expected));
      if (seen.turn != Turn::bearing) continue;
      least = std::min(least, seen.bearing.mean(0));
      greatest = std::max(greatest, seen.bearing.mean(0));
    }
    EXPECT_LT(least, -3.0) << "the bearings should go across the line";
    EXPECT_GT(greatest, 3.0);
  }
}

TEST(InteractingSensors, TakeTurnsAsInTheRestatement) {
  sensors_take_turns<Interacting, Random>();
  sensors_take_turns<Interacting, Fuzzy>();
}
TEST(InteractingSensors, TakeTurnsInASecondOrderFilterAsInTheRestatement) {
  sensors_take_turns<SecondOrder, Random>();
  sensors_take_turns<SecondOrder, Fuzzy>();
}

/// The same filters, whose next sensor is known at run time only, do the same.
TEST(InteractingSensors, AreThoseThatAnySensorIs) {
  using Any = AnySensor<PositionSensor<2>, PolarSensor<2>, BearingSensor>;
  auto filter = vector_filter<Interacting, Fuzzy>();
  auto expected = filter;
  for (const Sighting& seen : sightings(60)) {
    see(expected, seen);
    const auto step_with = [&](const auto& z, const Any& sensor) {
      filter.step(seen.dt, MeasurementOf<Any>{z.mean, z.covariance}, sensor);
    };
    if (seen.turn == Turn::position) step_with(seen.position, PositionSensor<2>{});
    if (seen.turn == Turn::polar) step_with(seen.polar, PolarSensor<2>{radar_at});
    if (seen.turn == Turn::bearing) step_with(seen.bearing, BearingSensor{camera_at});
    if (seen.turn == Turn::nothing) filter.step(seen.dt);
    ASSERT_PRED_FORMAT3(near_matrix, filter.estimate().mean, expected.estimate().mean, 1e-9);
    ASSERT_PRED_FORMAT3(near_matrix, filter.estimate().covariance, expected.estimate().covariance, 1e-9);
    ASSERT_PRED_FORMAT3(near, filter.belief().logs(), expected.belief().logs(), 1e-9);
  }
}

/// Six quantities at once, more than any model of the plane has states of the same kind.
TEST(InteractingSensors, MayMeasureSixQuantitiesAtOnce) {
  const RectangularMatrix<6, 4> H{{1, 0, 0, 0}, {0, 1, 0, 0},     {0, 0, 1, 0},
                                  {0, 0, 0, 1}, {0.5, 0.5, 0, 0}, {0, 0, 1, -1}};
  auto filter = vector_filter<Interacting, Random>();
  auto expected = restated<Interacting, Random>({calm(1.0), calm(5.0), turning()}, random_transition, starts(), {});
  std::mt19937_64 generator(3);
  std::normal_distribution<double> normal;
  SquareMatrix<6> R = 40.0 * SquareMatrix<6>::Identity();
  R(0, 5) = R(5, 0) = 7.0;
  for (int k = 0; k < 40; ++k) {
    const double t = 0.2 * (k + 1);
    Gaussian<6> z{H * Vector<4>(12000.0 - 100.0 * t, 8000.0 - 100.0 * t + (k > 20 ? 4.0 * (t - 4.0) * (t - 4.0) : 0.0),
                                -100.0, -100.0 + (k > 20 ? 8.0 * (t - 4.0) : 0.0)),
                  R};
    for (double& value : z.mean) value += 6.0 * normal(generator);
    filter.step(0.2, z, LinearSensor<6, 4>{H});
    expected.step(0.2, restatement::seen_by_rows(entries(z.mean), dense(H)), dense(R));
    ASSERT_TRUE(agrees(filter, expected));
    ASSERT_EQ(filter.innovations()[0].residual.size(), 6);
  }
}

// What does not fit does not compile.
template <class Filter, class Measurement, class Sensor>
concept Steps = requires(Filter& filter, const Measurement& z, const Sensor& sensor) {
  filter.step(0.2, z, sensor);
};
template <class Filter, class Measurement>
concept StepsByPosition = requires(Filter& filter, const Measurement& z) {
  filter.step(0.2, z);
};
using Imm = Filter<Interacting, Random>;
using Viterbi = SecondOrder::Filter<TupleBank, Fuzzy>;
static_assert(StepsByPosition<Imm, Gaussian<2>> && !StepsByPosition<Imm, Gaussian<3>>);
static_assert(Steps<Imm, Gaussian<2>, PolarSensor<2>> && Steps<Viterbi, Gaussian<2>, PolarSensor<2>>);
static_assert(!Steps<Imm, Gaussian<1>, PolarSensor<2>> && !Steps<Viterbi, Gaussian<3>, PolarSensor<2>>);
static_assert(!Steps<Imm, Gaussian<3>, PolarSensor<3>> && !Steps<Viterbi, Gaussian<3>, PositionSensor<3>>,
              "of another number of axes");
static_assert(Steps<Viterbi, Gaussian<1>, LinearSensor<1, 4>> && !Steps<Viterbi, Gaussian<1>, LinearSensor<1, 5>>,
              "one of its models lacks the fifth component");
static_assert(Steps<Imm, Gaussian<6>, LinearSensor<6, 4>> && !Steps<Imm, Gaussian<7>, LinearSensor<7, 4>>,
              "of more quantities than a filter keeps");

TEST(InteractingSensors, AComponentThatARunTimeModelLacksIsRefusedAndTheFilterIsAsItWas) {
  auto filter = vector_filter<Interacting, Fuzzy>();
  const auto before = filter;
  const LinearSensor<1, 6> acceleration{RectangularMatrix<1, 6>(0, 0, 0, 0, 1, 0)};
  EXPECT_TRUE(throws<std::invalid_argument>(
      [&] {
        filter.step(0.2, {Vector<1>(0.0), SquareMatrix<1>(1.0)}, acceleration);
      },
      {"sees 6", "dwna", "4"}));
  require_same<Interacting, Fuzzy>(filter, before);
}

}  // namespace
}  // namespace sigmax
