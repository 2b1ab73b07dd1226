#include "rooms.hpp"
#include "tracking.hpp"

#include <functional>
#include <map>
#include <type_traits>
#include <utility>

#include <pybind11/stl.h>

#ifdef SIGMAX_TUNING
#include <sigmax/hybrid/fit_target.hpp>
#include <sigmax/tuning/target.hpp>
#include <sigmax/tuning/tune.hpp>
#endif

namespace sigmax::python {
namespace {

/// What sets a member of the settings by a keyword.
using Rules = std::map<std::string, std::function<void(Settings&, const std::string& key, const py::object&)>>;

/// Of a member of one of their parts; words are of an enumeration, or of a choice of two, in their order.
template <class Part, class Value>
auto rule(Part Settings::*part, Value Part::*member, const std::vector<std::string>& words = {}) {
  return [=](Settings& made, [[maybe_unused]] const std::string& key, const py::object& value) {
    if constexpr (std::is_enum_v<Value> || std::is_same_v<Value, bool>)
      made.*part.*member = static_cast<Value>(index_among(key, value.cast<std::string>(), words));
    else
      made.*part.*member = value.cast<Value>();
  };
}

using S = Settings;
using C = TargetChoice;
using M = MultiTargetRules;
const std::vector<std::string> ties = {"stay", "first", "last"}, kinds = {"random", "fuzzy"};
const Rules target_rules = {
    {"sojourn", rule(&S::choice, &C::sojourn_s)},
    {"mixed_covariance",
     rule(&S::choice, &C::mixed_covariance, {"selected", "own", "own_recentred", "released", "envelope"})},
    {"augmentation", rule(&S::choice, &C::augmentation, {"zero", "borrowed_variance", "unbiased", "prior"})},
    {"mixing_tie", rule(&S::choice, &C::mixing_tie, ties)},
    {"output_tie", rule(&S::choice, &C::output_tie, ties)},
    {"member", rule(&S::choice, &C::member, {"kf", "ekf", "ukf", "ckf"})},
    {"likelihood", rule(&S::choice, &C::likelihood, {"density", "possibility"})},
    {"histories", rule(&S::choice, &C::histories)},
    {"cut", rule(&S::choice, &C::cut)},
    {"tempering", rule(&S::choice, &C::tempering)},
    {"start", rule(&S::choice, &C::start, {"points", "released", "given"})},
    {"start_mean", rule(&S::choice, &C::start_mean)},
    {"start_variances", rule(&S::choice, &C::start_covariance_diagonal)},
    {"start_time", rule(&S::choice, &C::start_time_s)},
    {"gate", rule(&S::target, &TargetRules::gate_probability)},
    {"rejections", rule(&S::target, &TargetRules::rejections)},
    {"longest_gap", rule(&S::target, &TargetRules::longest_gap)},
    {"buffer", rule(&S::target, &TargetRules::buffer)}};
const Rules scene_rules = {{"pattern", rule(&S::association, &AssociationChoice::fuzzy_pattern, kinds)},
                           {"permutation", rule(&S::association, &AssociationChoice::fuzzy_permutation, kinds)},
                           {"detection_probability", rule(&S::scene, &M::detection_probability)},
                           {"gate_probability", rule(&S::scene, &M::gate_probability)},
                           {"clutter_density", rule(&S::scene, &M::clutter_density)},
                           {"survival_per_s", rule(&S::scene, &M::survival_per_s)},
                           {"birth_existence", rule(&S::scene, &M::birth_existence)},
                           {"confirmation", rule(&S::scene, &M::confirmation)},
                           {"deletion", rule(&S::scene, &M::deletion)},
                           {"greatest_speed", rule(&S::scene, &M::greatest_speed)},
                           {"detection_possibilities", rule(&S::scene, &M::detection_possibilities)}};

Settings settings_of(bool fuzzy, int scheme, const std::vector<Model>& models, const py::object& relation,
                     const py::dict& rules, bool many) {
  Settings made;
  made.relation = relation;
  TargetChoice& choice = made.choice;
  choice.fuzzy = fuzzy;
  choice.scheme = static_cast<Scheme>(scheme);
  choice.models = relation.attr("to").attr("labels").cast<std::vector<std::string>>();
  choice.transition = relation.attr("table").attr("tolist")().cast<std::vector<std::vector<double>>>();
  if (choice.scheme == Scheme::histories) choice.augmentation = StateAugmentation::prior;
  if (choice.scheme == Scheme::histories && !fuzzy) choice.cut = 0.0;
  for (const auto& [key, value] : rules) {
    const auto name = py::cast<std::string>(key);
    const Rules& known = many && scene_rules.contains(name) ? scene_rules : target_rules;
    if (!known.contains(name)) throw py::type_error("there is no rule '" + name + "'");
    known.at(name)(made, name, py::reinterpret_borrow<py::object>(value));
  }
  choice.rules = made.target;
  for (const Model& each : models) {
    choice.axes = each.model.axes();
    choice.motions.push_back(each.known.value_or(MotionChoice{""}));
    made.models.push_back(each.known ? known_model(*each.known, choice.axes, choice.member) : each.model);
  }
  return made;
}

/// A recording at the speed of the library: (times, x, P, weights, nis, components), smoothed or not. Rows are NaN
/// where there was no step.
py::tuple follow(const Settings& made, const Detections& detections, bool smoothed) {
  TargetChoice choice = made.choice;
  choice.rules.record = smoothed;
  AnyTarget target(choice);
  const std::size_t rows = detections.size(), n = target.components().size();
  Array times = unknown(rows);
  std::ranges::transform(detections, times.mutable_data(), &AnyDetection::time);
  const Array x = unknown(rows, n), P({rows, n, n}), weights = unknown(rows, choice.models.size()), nis = unknown(rows);
  const auto write = [&](const TargetPoint& point) {  // needs no lock of Python
    const auto put = [&](std::span<const double> row, const Array& series) {
      std::ranges::copy(row, const_cast<double*>(series.data()) + point.tag * row.size());
    };
    put(point.mean, x);
    put(point.covariance, P);
    put(point.weights, weights);
    const_cast<double*>(nis.data())[point.tag] = point.nis.value_or(unknown_number);
  };
  unlocked([&] {
    target.follow(detections, write);
    if (smoothed) target.smoothed(write);
    for (std::size_t row = 0; row < rows; ++row)  // filled last, since it is the most
      if (std::isnan(*x.data(row))) std::fill_n(const_cast<double*>(P.data(row)), n * n, unknown_number);
  });
  return py::make_tuple(times, x, P, weights, nis, target.components());
}

py::list tracks_of(const MultiTargetTracker& tracker, std::optional<double> time) {
  py::list all;
  for (const TrackedTarget& each : tracker.tracks(time.value_or(tracker.time()))) {
    const std::size_t n = each.point.mean.size();
    all.append(record(py::arg("number") = each.number, py::arg("time") = each.point.time,
                      py::arg("x") = array_of(each.point.mean),
                      py::arg("P") = copied(each.point.covariance.data(), n, n),
                      py::arg("weights") = array_of(each.point.weights), py::arg("existence") = each.existence,
                      py::arg("necessity") = each.necessity, py::arg("confirmed") = each.confirmed));
  }
  return all;
}

void bind_tracker(py::module_& module) {
  using Tracker = MultiTargetTracker;
  py::class_<Tracker> tracker(module, "_Tracker");
  tracker.def(py::init([](const Settings& made) { return Tracker(made.choice, made.association, made.scene); }));
  method(tracker, "scan", "Takes a scan; returns whose each detection is, (N,): the number of a track, or 0.",
         [](Tracker& self, const Detections& detections) {
           std::vector<std::int64_t> owners(detections.size());
           unlocked([&] { self.scan(detections); });
           for (const DetectionOwner& owner : self.owners())
             owners[owner.tag] = static_cast<std::int64_t>(owner.track.value_or(0));
           return array_of(owners);
         });
  tracker.def(
      "tracks", &tracks_of, py::arg("time") = py::none(),
      "All tracks, confirmed or not, predicted to a time in s, or that of the last detection: number, time, x (n,),\n"
      "P (n, n), weights, existence, necessity, confirmed.");
  property(tracker, "components", "Names of what is estimated.", [](const Tracker& self) { return self.components(); });
}

#ifdef SIGMAX_TUNING
/// Fits the noise of the motions, the transition and a factor on all standard deviations of the sensors: the numbers
/// with their errors, models, transition, sojourn times, loss and loss before.
py::tuple tune_targets(const Settings& start, const std::vector<Detections>& recordings, std::size_t folds,
                       std::uint64_t seed) {
  Tracks tracks;
  std::vector<std::size_t> sizes;
  for (const Detections& recording : recordings) sizes.push_back(tracks.emplace_back(recording).size());
  const TrackScale scale(tracks);
  const RobustLoss robust(tracks, scale);
  auto numbers = motion_numbers(start.choice, scale);
  for (auto& each : transition_numbers(start.choice, scale)) numbers.push_back(std::move(each));
  numbers.push_back({{.name = "noise", .least = 0.01, .most = 100.0}, [](TargetChoice&, double) {}});
  const auto tried = [&](const std::vector<double>& values) {
    TargetChoice choice = start.choice;
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i].set(choice, values[i]);
    return choice;
  };
  const auto losses = [&](const std::vector<double>& values) {
    RowLosses all;
    for (std::size_t t = 0; t < tracks.size(); ++t) {
      auto detections = tracks[t];
      for (AnyDetection& each : detections)
        for (double& entry : each.covariance) entry *= values.back() * values.back();
      all.push_back(robust(t, log_scores(tried(values), detections)));
    }
    return all;
  };
  const auto objective = [&](const RowLosses& all, const RowCounts& counts) { return robust.objective(all, counts); };
  const TuneProblem problem{parameters_of(numbers), losses, objective};
  std::optional<py::gil_scoped_release> release(std::in_place);
  const Tuned tuned = tune(problem, folds_of(sizes, folds), {.seed = seed});
  const std::vector<double> errors = standard_errors(problem, tuned);
  std::vector<double> now;
  for (const FitParameter& parameter : problem.parameters) now.push_back(parameter.start);
  const double before = objective(losses(now), {});
  release.reset();
  py::dict found;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const FitParameter& parameter = problem.parameters[i];
    const double value = tuned.fit.values[i], unit = parameter.scale == Scale::logarithmic ? value : parameter.unit;
    found[py::str(parameter.name)] = py::make_tuple(value, errors[i] * unit);
  }
  const TargetChoice choice = tried(tuned.fit.values);
  std::vector<Model> models;
  for (const MotionChoice& motion : choice.motions) models.push_back({known_model(motion, choice.axes), motion});
  return py::make_tuple(found, models, choice.transition, choice.sojourn_s, tuned.fit.loss, before);
}
#endif

}  // namespace

void bind_hybrid(py::module_& module) {
  py::class_<Settings> settings(module, "_Settings");
  settings.def(py::init(&settings_of));
  settings.def_readonly("relation", &Settings::relation);
  settings.def("follow", &follow);
#ifdef SIGMAX_TUNING
  settings.def("tune", &tune_targets);
#endif
  bind_filters(module);
  bind_tracker(module);
}

}  // namespace sigmax::python
