#include <algorithm>
#include <stdexcept>
#include <string>
#include <type_traits>

#include <sigmax/hybrid/history_filter.hpp>
#include <sigmax/hybrid/interacting_multiple_model.hpp>
#include <sigmax/hybrid/mode_transition.hpp>
#include <sigmax/hybrid/second_order_multiple_model.hpp>
#include <sigmax/hybrid/target.hpp>

#include "chosen_start.hpp"
#include "chosen_target.hpp"

// All schemes and both kinds of mode in one file: what they share is most of what they take to compile.
namespace sigmax::detail {
namespace {

template <ScalableUncertainty Kind>
ModeTransition<Kind> chosen_transition(const TargetChoice& choice) {
  const Variable<Kind> mode{"mode", choice.models};
  if (choice.scheme == Scheme::independent) return identity(mode);
  if (!choice.sojourn_s.empty()) return TimedTransition<Kind>(mode, rates_of_sojourns(choice.sojourn_s));
  return Relation<Kind, Kind>{mode, mode, choice.transition};
}

template <ScalableUncertainty Kind>
Interaction<Kind> chosen_interaction(const TargetChoice& choice) {
  Interaction<Kind> interaction;
  interaction.lift = choice.lift;
  interaction.entry = choice.entry;
  interaction.output_tie = choice.output_tie;
  interaction.mixed_start = choice.scheme == Scheme::common_start ? MixedStart::common : MixedStart::of_each_mode;
  interaction.likelihood = choice.likelihood;
  if constexpr (std::is_same_v<Kind, Fuzzy>)
    interaction.collapse = {choice.mixed_covariance, choice.mixing_tie};
  else
    interaction.collapse = {choice.imm_mixing, choice.output_spread};
  return interaction;
}

/// The filter of a choice; what it holds before it starts means nothing.
template <class Filter>
Filter chosen_filter(const TargetChoice& choice) {
  using Kind = typename Filter::kind;
  auto bank = known_bank(choice);
  auto transition = chosen_transition<Kind>(choice);
  auto nowhere = ChosenStart(choice).nowhere();
  auto interaction = chosen_interaction<Kind>(choice);
  if constexpr (requires { typename Filter::Rules; }) {
    typename Filter::Rules rules;
    rules.histories = choice.histories;
    rules.cut = choice.cut;
    rules.tempering = choice.tempering;
    return {std::move(bank), std::move(transition), std::move(nowhere), rules, std::move(interaction)};
  } else {
    return {std::move(bank), std::move(transition), std::move(nowhere), std::move(interaction)};
  }
}

void require_size(int size, int expected) {
  if (size < 1 || size > 6 || (expected != Eigen::Dynamic && size != expected))
    throw std::invalid_argument("a plot has " + std::to_string(size) + " measured quantities; expected " +
                                (expected == Eigen::Dynamic ? "1 to 6" : std::to_string(expected)));
}

/// The plot in the types of the target. Throws std::invalid_argument if its numbers do not fit its sensor.
Plot<KnownSensor> chosen_plot(const AnyPlot& plot, int axes) {
  if (plot.sensor == AnyPlot::Sensor::none) return Plot<KnownSensor>(plot.time, plot.tag);
  require_size(plot.size, Eigen::Dynamic);
  const KnownSensor sensor = axes == 1   ? known_sensor_of_a_line(plot)
                             : axes == 2 ? known_sensor<2>(plot)
                                         : known_sensor<3>(plot);
  sensor.visit([&]<Sensing Sensor>(const Sensor&) { require_size(plot.size, Sensor::measurement_size); });
  MeasurementOf<KnownSensor> z;
  z.mean = Eigen::Map<const Eigen::VectorXd>(plot.z.data(), plot.size);
  z.covariance = Eigen::Map<const Eigen::MatrixXd>(plot.covariance.data(), plot.size, plot.size);
  return {plot.time, z, sensor, plot.tag};
}

/// The Target of a scheme and a kind of mode.
template <class Filter>
class ChosenTargetOf final : public ChosenTarget {
  using TargetType = Target<Filter, ChosenStart, KnownSensor>;
  using PlotType = typename TargetType::PlotType;

 public:
  explicit ChosenTargetOf(const TargetChoice& choice)
      : target_(chosen_filter<Filter>(choice), ChosenStart(choice), choice.rules),
        axes_(choice.axes),
        most_likely_output_(choice.most_likely_output) {}

  std::unique_ptr<ChosenTarget> clone() const override { return std::make_unique<ChosenTargetOf>(*this); }

  Verdict take(const AnyPlot& plot, const AnyTarget::Stepped& stepped) override {
    return target_.take(chosen_plot(plot, axes_), [&](const PlotType& taken, bool is_start) {
      compared_ = !is_start && taken.seen;
      if (stepped) stepped(taken.tag, is_start);
    });
  }
  bool running() const override { return target_.running(); }
  std::size_t starts() const override { return target_.starts(); }
  std::size_t rejected() const override { return target_.rejected(); }
  double time() const override { return target_.time(); }
  double accepted_time() const override { return target_.accepted_time(); }
  bool transform(std::span<const double> A, std::span<const double> b) override {
    const auto axes = static_cast<std::size_t>(axes_);
    if (A.size() != axes * axes || b.size() != axes)
      throw std::invalid_argument("a transformation of " + std::to_string(axes_) +
                                  " axes has as many rows and columns");
    return target_.transform(Eigen::Map<const Eigen::MatrixXd>(A.data(), axes_, axes_).transpose(),
                             Eigen::Map<const Eigen::VectorXd>(b.data(), axes_));
  }
  const std::vector<std::string>& components() const override { return target_.filter().components(); }

  void output(TargetPoint& result) const override {
    const Filter& filter = target_.filter();
    result.time = target_.time();
    result.nis.reset();
    result.normalized_innovation.clear();
    if (filter.measured()) {
      const auto innovation = filter.normalized_innovation();
      result.nis = innovation.squaredNorm();
      result.normalized_innovation.assign(innovation.begin(), innovation.end());
    }
    result.log_evidence = compared_ ? std::optional(filter.log_evidence()) : std::nullopt;
    result.log_score = compared_ ? std::optional(filter.log_score()) : std::nullopt;
    tell(most_likely_output_ ? filter.most_likely_estimate() : filter.estimate(), filter.belief(),
         filter.most_likely_mode(), result);
  }
  void smoothed(const std::function<void(const TargetPoint&)>& visit,
                const std::function<void(const ModePairs&)>& paired) const override {
    TargetPoint point;
    const auto tell_point = [&](const auto& kept, const auto& state) {
      if (!visit) return;
      point.time = kept.time;
      point.tag = kept.tag;
      point.is_start = kept.is_start;
      point.nis = kept.nis;
      const Filter& filter = target_.filter();
      tell(most_likely_output_ ? filter.most_likely_estimate(state) : filter.estimate(state), state.belief,
           state.most_likely_mode, point);
      visit(point);
    };
    target_.smoothed(tell_point, [&](const auto& kept, const Table& log_pairs, bool is_last) {
      if (paired) paired({kept.tag, kept.step.dt, is_last, {log_pairs.data(), log_pairs.size()}});
    });
  }
  std::vector<ModeStay> explained() const override {
    std::vector<ModeStay> stays;
    if constexpr (KeepsHistories<Filter>)
      target_.explained([&](const auto& kept, std::size_t mode) {
        stays.push_back({kept.time, kept.tag, mode, kept.is_start});
      });
    return stays;
  }

 private:
  static void tell(const typename Filter::Estimate& estimate, const Belief<typename Filter::kind>& belief,
                   std::size_t most_likely_mode, TargetPoint& result) {
    result.mean.assign(estimate.mean.data(), estimate.mean.data() + estimate.mean.size());
    result.covariance.assign(estimate.covariance.data(), estimate.covariance.data() + estimate.covariance.size());
    result.weights.resize(belief.size());
    for (std::size_t j = 0; j < belief.size(); ++j) result.weights[j] = belief[j];
    result.most_likely_mode = most_likely_mode;
  }

  TargetType target_;
  int axes_;
  bool most_likely_output_;
  bool compared_ = false;  ///< whether the last step had a measurement, taken or not
};

template <class Filter>
std::unique_ptr<ChosenTarget> target_of(const TargetChoice& choice) {
  return std::make_unique<ChosenTargetOf<Filter>>(choice);
}

template <ScalableUncertainty Kind>
std::unique_ptr<ChosenTarget> target_of_scheme(const TargetChoice& choice) {
  switch (choice.scheme) {
    case Scheme::histories:
      return target_of<HistoryFilter<KnownBank, Kind>>(choice);
    case Scheme::second_order:
      return target_of<SecondOrderMultipleModel<KnownBank, Kind>>(choice);
    case Scheme::interacting:
    case Scheme::common_start:
    case Scheme::independent:
      break;
  }
  return target_of<InteractingMultipleModel<KnownBank, Kind>>(choice);
}

}  // namespace

std::unique_ptr<ChosenTarget> chosen_target(const TargetChoice& choice) {
  return choice.fuzzy ? target_of_scheme<Fuzzy>(choice) : target_of_scheme<Random>(choice);
}

}  // namespace sigmax::detail
