#include "chosen.hpp"

#include <numbers>
#include <stdexcept>
#include <string>

#include <sigmax/estimation/doppler_sensor.hpp>
#include <sigmax/hybrid/history_filter.hpp>
#include <sigmax/hybrid/interacting_multiple_model.hpp>
#include <sigmax/hybrid/mode_transition.hpp>
#include <sigmax/hybrid/second_order_multiple_model.hpp>

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
  interaction.augmentation = choice.augmentation;
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

/// The sensor of a detection that has one; a branch here is all that a new one needs beside its name in AnyDetection.
/// Throws std::invalid_argument if the numbers of the detection do not fit it.
AnySensor chosen_sensor(const AnyDetection& detection, int axes) {
  using enum AnyDetection::Sensor;
  if (detection.size < 1 || detection.size > max_measurement_size)
    throw std::invalid_argument("a detection has " + std::to_string(detection.size) +
                                " measured quantities; expected 1 to 6");
  if (detection.sensor == components)
    return ComponentSensor<max_measurement_size>(
        std::span(detection.places).first(static_cast<std::size_t>(detection.size)), axes);
  if (axes == 1 && detection.sensor != position)
    throw std::invalid_argument("along one axis a detection is a position or components; a radar needs a plane");
  const Vector<3> origin(detection.origin.data());
  if (detection.sensor == polar && axes == 3 && detection.size == 2) return SlantSensor(origin);
  const int expected = detection.sensor == bearing ? 1 : detection.sensor == doppler ? axes + 1 : axes;
  if (detection.size != expected)
    throw std::invalid_argument("a detection has " + std::to_string(detection.size) +
                                " measured quantities; expected " + std::to_string(expected));
  const Vector<2> below(detection.origin.data());
  if (detection.sensor == bearing) return BearingSensor(below);
  if (detection.sensor == polar && axes == 2) return PolarSensor<2>(below);
  if (detection.sensor == polar) return PolarSensor<3>(origin);
  if (detection.sensor == doppler && axes == 2) return DopplerSensor<2>(below);
  if (detection.sensor == doppler) return DopplerSensor<3>(origin);
  return detail::position_sensor(axes);
}

void require_sound(const TargetChoice& choice) {
  if (choice.axes < 1 || choice.axes > 3)
    throw std::invalid_argument("a target along " + std::to_string(choice.axes) + " axes; expected 1, 2 or 3");
  if (choice.motions.empty() || choice.motions.size() != choice.models.size())
    throw std::invalid_argument("a target with " + std::to_string(choice.motions.size()) + " motions and " +
                                std::to_string(choice.models.size()) + " names of them");
  if (choice.start == StartRule::given &&
      (choice.start_mean.size() != 9 || choice.start_covariance_diagonal.size() != 9))
    throw std::invalid_argument("a given start has nine numbers and nine variances: x, y, z, vx, vy, vz, ax, ay, az");
}

}  // namespace

template <ScalableUncertainty Kind>
std::function<MultipleModelFilter<Kind>&()> chosen_filter(const TargetChoice& choice) {
  using Filter = MultipleModelFilter<Kind>;
  require_sound(choice);
  std::vector<AnyModel> models;
  for (const auto& motion : choice.motions) models.push_back(known_model(motion, choice.axes, choice.member));
  const Estimates nowhere = anywhere(models);
  const auto interaction = chosen_interaction<Kind>(choice);
  const auto transition = chosen_transition<Kind>(choice);
  const HistoryRules<Kind> rules{.histories = choice.histories, .cut = choice.cut, .tempering = choice.tempering};
  if (choice.scheme == Scheme::histories)
    return held<Filter>(HistoriesOfModes<Kind>(models, transition, nowhere, rules, interaction));
  if (choice.scheme == Scheme::second_order)
    return held<Filter>(SecondOrderFilter<Kind>(models, transition, nowhere, interaction));
  return held<Filter>(InteractingFilter<Kind>(models, transition, nowhere, interaction));
}

template std::function<MultipleModelFilter<Random>&()> chosen_filter(const TargetChoice&);
template std::function<MultipleModelFilter<Fuzzy>&()> chosen_filter(const TargetChoice&);

Detection chosen_detection(const AnyDetection& detection, int axes) {
  if (detection.sensor == AnyDetection::Sensor::none) return Detection(detection.time, detection.tag);
  return Detection(detection.time, ConstView{detection.z.data(), detection.covariance.data(), detection.size},
                   chosen_sensor(detection, axes), detection.tag);
}

Estimates chosen_start(const TargetChoice& choice, ConstView wide, ConstView narrow) {
  const double sigma_turn = choice.start_sigma_turn_deg_s * std::numbers::pi / 180.0;
  Estimates result;
  for (const MotionChoice& each : choice.motions) {
    const KnownMotion& motion = each.known();
    const int n = motion.derivatives * choice.axes;
    const EstimateAt<const double> from(n == wide.n ? wide : narrow);
    result.add(motion.linear ? n : n + 1);
    auto own = result[result.size() - 1];
    own.mean.head(n) = from.mean.head(n);
    own.covariance.topLeftCorner(n, n) = from.covariance.topLeftCorner(n, n);
    if (!motion.linear) own.covariance(n, n) = sigma_turn * sigma_turn;
  }
  return result;
}

}  // namespace sigmax::detail
