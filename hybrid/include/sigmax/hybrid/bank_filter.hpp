#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <sigmax/hybrid/multiple_model_filter.hpp>

namespace sigmax {

/// A multiple-model filter with the types of its models: what is of another size does not compile. All that it computes
/// is compiled, in `Filter`, over plain numbers.
template <class Models, class Filter>
class BankFilter : public Filter {
 public:
  using kind = typename Filter::kind;
  using State = typename Filter::State;
  /// Along how many axes the models have their position; Eigen::Dynamic if they are chosen at run time.
  static constexpr int axes = Bank<Models>::axes;
  /// A measurement of the position, which every model has if any has: that of the default sensor.
  using Measurement = Gaussian<axes, axes == Eigen::Dynamic ? 3 : axes>;
  /// Starts of the models, as a tuple or a vector of their estimates.
  using Starts = typename Bank<Models>::Estimates;
  /// An estimate in the components of all models together.
  using Estimate = Gaussian<Eigen::Dynamic, Bank<Models>::max_components>;

  /// Starts every model from its own estimate; nothing is known of the mode. The transition is a relation that serves
  /// every step, or a function of the step such as TimedTransition. `rules` are those of the filter, and its
  /// Interaction. Throws std::invalid_argument if the transition does not fit the models, or a start is not finite or
  /// of another size than its model.
  template <class... Rules>
  BankFilter(const Models& models, ModeTransition<kind> transition, const Starts& start, const Rules&... rules)
      : BankFilter(models, std::move(transition), detail::starts_of(start), rules...) {}
  template <class... Rules>
  BankFilter(const Models& models, ModeTransition<kind> transition, const Estimates& start, const Rules&... rules)
      : Filter(detail::bank_of(models), std::move(transition), start, rules...) {
    if (this->component_count() > Bank<Models>::max_components)
      throw std::invalid_argument("the models have " + std::to_string(this->component_count()) +
                                  " different components, but their type allows " +
                                  std::to_string(Bank<Models>::max_components));
  }

  /// Starts every model from the components that it has of one estimate, given in the order of `components()`.
  template <int N, int MaxN, class... Rules>
  BankFilter(const Models& models, ModeTransition<kind> transition, const Gaussian<N, MaxN>& start,
             const Rules&... rules)
      : BankFilter(models, std::move(transition),
                   detail::Components(detail::bank_of(models)).shares(detail::view(start)), rules...) {}

  /// One cycle, `dt` ≥ 0 seconds after the last, with the measurement z, its covariance R, and the sensor that measured
  /// it: another one each time, if need be. Where its `gate_distance()` is beyond the gate, it counts as missed, and
  /// `accepted()` is false.
  /// Throws std::invalid_argument if dt or the measurement is not finite, std::domain_error, saying in which step, if S
  /// is not positive definite or every mode is excluded. The filter's state is then what it was before.
  template <SensorOfBank<Models> Sensor>
  void step(double dt, const MeasurementOf<Sensor>& z, const Sensor& sensor, const Gate& gate = {}) {
    const Seen seen{detail::view(z), detail::sensor_of_models<Models>(sensor)};
    Filter::step(dt, &seen, gate);
  }

  /// The same with what says by which sensor it was measured.
  template <class Sensor>
  void step(double dt, const MeasuredBy<Sensor>& measured, const Gate& gate = {}) {
    static_assert(SensorOfBank<Sensor, Models>, "this sensor does not measure the states of the bank: other axes?");
    step(dt, measured.z, measured.sensor, gate);
  }

  /// The same with a measurement of the position, which leads the state of every model.
  void step(double dt, const Measurement& z, const Gate& gate = {}) requires(axes != 0) {
    const Seen seen = seen_at(z);
    Filter::step(dt, &seen, gate);
  }
  template <int N, int MaxN>
    requires(axes != Eigen::Dynamic && axes != N)
  void step(double, const Gaussian<N, MaxN>&, const Gate& = {}) {
    static_assert(axes == N, "a Gaussian is a position along the bank's axes; give another with its sensor");
  }

  /// One cycle without a measurement, `step(dt)`: the models predict and the mode moves on.
  using Filter::step;

  /// The record of the last step for a smoother, with the arguments of that step. A measurement that the gate rejected
  /// counts as missed. Throws std::logic_error without a measurement if the step had one.
  using Filter::recorded;
  template <Sensing Sensor>
  RecordedStep<kind> recorded(double dt, const MeasurementOf<Sensor>& z, const Sensor& sensor, const Gate& = {}) const {
    const Seen seen{detail::view(z), detail::sensor_of_models<Models>(sensor)};
    return Filter::recorded(dt, &seen);
  }
  template <Sensing Sensor>
  RecordedStep<kind> recorded(double dt, const MeasuredBy<Sensor>& measured, const Gate& = {}) const {
    return recorded(dt, measured.z, measured.sensor);
  }
  RecordedStep<kind> recorded(double dt, const Measurement& z, const Gate& = {}) const requires(axes != 0) {
    const Seen seen = seen_at(z);
    return Filter::recorded(dt, &seen);
  }

  /// @{
  /// As of MultipleModelFilter, from estimates of the models or one of them all.
  void restart(const Starts& starts) { Filter::restart(detail::starts_of(starts)); }
  void restart(const Estimates& starts) { Filter::restart(starts); }
  template <int N, int MaxN>
  void restart(const Gaussian<N, MaxN>& start) {
    Filter::restart(detail::view(start));
  }
  using Filter::transform;
  void transform(const SquareMatrix<Eigen::Dynamic, 3>& A, const Vector<Eigen::Dynamic, 3>& b) {
    Filter::transform(A.data(), b.data(), static_cast<int>(b.size()));
  }
  /// @}

  /// The output: of the filter's own state, of another by modes, say a smoothed one, and of the most likely mode alone.
  Estimate estimate() const { return estimate(this->state()); }
  Estimate estimate(const HybridEstimate<kind>& state) const {
    return written([&](detail::View result) { Filter::output(state, result); });
  }
  Estimate most_likely_estimate() const { return most_likely_estimate(this->state()); }
  Estimate most_likely_estimate(const HybridEstimate<kind>& state) const {
    return written([&](detail::View result) { Filter::most_likely_output(state, result); });
  }

  /// The innovation of the predicted measurement in its own standard deviations, L⁻¹ν with S = LLᵀ; `nis()` is the
  /// square of its norm. If the filter is right, its numbers have mean 0 and variance 1 and tell nothing of those of
  /// other steps. Throws std::logic_error if the last step had no measurement.
  Vector<Eigen::Dynamic, max_measurement_size> normalized_innovation() const {
    double numbers[max_measurement_size];
    const int m = Filter::normalized_innovation(numbers);
    return Eigen::Map<const Eigen::VectorXd>(numbers, m);
  }

 private:
  template <class Write>
  Estimate written(const Write& write) const {
    Estimate result;
    write(detail::sized_view(result, this->component_count()));
    return result;
  }

  static Seen seen_at(const Measurement& z) {
    return {detail::view(z), detail::sensor_of_models(detail::position_sensor(static_cast<int>(z.size())))};
  }
};

}  // namespace sigmax
