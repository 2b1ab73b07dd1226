#include "rooms.hpp"
#include "tracking.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <tuple>
#include <type_traits>
#include <utility>

#include <pybind11/stl.h>

#include <sigmax/hybrid/any_target.hpp>
#include <sigmax/hybrid/fit_target.hpp>
#include <sigmax/hybrid/multi_target_tracker.hpp>

#ifdef SIGMAX_TUNING
#include <sigmax/tuning/target.hpp>
#include <sigmax/tuning/tune.hpp>
#endif

namespace sigmax::python {
namespace {

/// Filters as programs call them, in the order of Scheme: of a random mode, then of a fuzzy one.
const std::vector<std::string> filters = {"imm",  "gpb1",        "gpb2",    "static_random", "imm_histories",
                                          "himm", "himm_global", "viterbi", "static_fuzzy",  "himm_histories"};

/// What sets members of plain data by keywords.
template <class Data>
using Rules = std::map<std::string, std::function<void(Data&, const py::object&)>>;

template <class Data, class Value>
auto number(Value Data::*member) {
  return [=](Data& data, const py::object& value) { data.*member = value.cast<Value>(); };
}
template <class Data, class Enum>
auto word(Enum Data::*member, const char* key, std::vector<std::string> words) {
  return [=, words = std::move(words)](Data& data, const py::object& value) {
    data.*member = static_cast<Enum>(index_among(key, value.cast<std::string>(), words));
  };
}
auto target_rule(auto TargetRules::*member) {
  return [=](TargetChoice& choice, const py::object& value) { number(member)(choice.rules, value); };
}

const Rules<TargetChoice>& target_rules() {
  using C = TargetChoice;
  static const std::vector<std::string> ties = {"stay", "first", "last"};
  static const Rules<C> rules = {
      {"sojourn", number(&C::sojourn_s)},
      {"mixed_covariance",
       word(&C::mixed_covariance, "mixed_covariance", {"selected", "own", "own_recentred", "released", "envelope"})},
      {"imm_mixing", word(&C::imm_mixing, "imm_mixing", {"correct", "released"})},
      {"augmentation", word(&C::augmentation, "augmentation", {"zero", "borrowed_variance", "unbiased", "prior"})},
      {"entry_scales",
       [](C& choice, const py::object& value) { value.cast<std::vector<double>>().swap(choice.entry.scales); }},
      {"mixing_tie", word(&C::mixing_tie, "mixing_tie", ties)},
      {"output_tie", word(&C::output_tie, "output_tie", ties)},
      {"member", word(&C::member, "member", {"kf", "ekf", "ukf", "ckf"})},
      {"likelihood", word(&C::likelihood, "likelihood", {"density", "possibility"})},
      {"output_spread", word(&C::output_spread, "output_spread", {"included", "omitted"})},
      {"histories", number(&C::histories)},
      {"cut", number(&C::cut)},
      {"tempering", number(&C::tempering)},
      {"start", word(&C::start, "start", {"points", "released", "given"})},
      {"start_mean", number(&C::start_mean)},
      {"start_variances", number(&C::start_covariance_diagonal)},
      {"start_time", number(&C::start_time_s)},
      {"gate", target_rule(&TargetRules::gate_probability)},
      {"rejections", target_rule(&TargetRules::rejections)},
      {"longest_gap", target_rule(&TargetRules::longest_gap)},
      {"buffer", target_rule(&TargetRules::buffer)}};
  return rules;
}

const Rules<MultiTargetRules>& scene_rules() {
  using M = MultiTargetRules;
  static const Rules<M> rules = {{"detection_probability", number(&M::detection_probability)},
                                 {"gate_probability", number(&M::gate_probability)},
                                 {"clutter_density", number(&M::clutter_density)},
                                 {"survival_per_s", number(&M::survival_per_s)},
                                 {"birth_existence", number(&M::birth_existence)},
                                 {"confirmation", number(&M::confirmation)},
                                 {"deletion", number(&M::deletion)},
                                 {"explained", number(&M::explained)},
                                 {"greatest_speed", number(&M::greatest_speed)},
                                 {"duplicate_scans", number(&M::duplicate_scans)},
                                 {"tentative_scans", number(&M::tentative_scans)},
                                 {"detection_possibilities", number(&M::detection_possibilities)}};
  return rules;
}

/// Sets what the rules name; returns the keywords that are none of them.
template <class Data>
py::dict set_rules(Data& data, const Rules<Data>& rules, const py::dict& given) {
  py::dict others;
  for (const auto& [key, value] : given) {
    const auto rule = rules.find(py::cast<std::string>(key));
    if (rule == rules.end())
      others[key] = value;
    else
      rule->second(data, py::reinterpret_borrow<py::object>(value));
  }
  return others;
}

/// The transition of a mode of this kind, by default that of himm_demo. Throws TypeError for one of another kind.
template <class Kind>
py::object transition_of(const std::string& filter, const std::vector<std::string>& models, const py::object& given) {
  constexpr bool fuzzy = std::is_same_v<Kind, Fuzzy>;
  using Other = std::conditional_t<fuzzy, Random, Fuzzy>;
  if (py::isinstance<Relation<Kind, Kind>>(given)) return given;
  if (py::hasattr(given, "from_"))
    throw py::type_error(filter + ": a " + std::string(Kind::name) + " mode and a transition " + class_name(given));
  const py::object mode = py::cast(Variable<Kind>{"mode", models});
  const std::size_t n = models.size();
  Array table = given.is_none() ? unknown(n, n) : as_array(given);
  expect_shape(table, "transition", n, n);
  for (std::size_t i = 0; given.is_none() && i < n * n; ++i)
    table.mutable_data()[i] =
        i % (n + 1) > 0 ? (fuzzy ? 0.5 : 0.05 / static_cast<double>(n - 1)) : (fuzzy || n == 1 ? 1.0 : 0.95);
  const auto is_table_of = [&]<class Each>(Each) {
    for (std::size_t i = 0; i < n; ++i) {
      double total = 0.0;
      for (std::size_t j = 0; j < n; ++j) total = AlgebraOf<Each>::plus(total, table.data()[i * n + j]);
      if (!(std::abs(total - 1.0) <= 1e-9)) return false;
    }
    return true;
  };
  if (!is_table_of(Kind{}) && is_table_of(Other{})) refuse(filter, Kind::name, "mode", Other::name, "transition");
  return py::type::of<Relation<Kind, Kind>>()(mode, mode, table);
}

/// A recording at the speed of the library: (x, P, weights, nis, components, stays), smoothed or not. Rows are NaN
/// where there was no step.
py::tuple follow(TargetChoice choice, const Detections& detections, bool smoothed) {
  choice.rules.record = smoothed || choice.scheme == Scheme::histories;
  AnyTarget target(choice);
  const std::size_t rows = detections.rows.size(), n = target.components().size();
  const Array x = unknown(rows, n), P = unknown(rows, n, n), weights = unknown(rows, choice.models.size()),
              nis = unknown(rows);
  const auto write = [&](const TargetPoint& point) {  // needs no lock of Python
    const auto put = [&](const std::vector<double>& row, const Array& series) {
      std::ranges::copy(row, const_cast<double*>(series.data()) + point.tag * row.size());
    };
    put(point.mean, x);
    put(point.covariance, P);
    put(point.weights, weights);
    put({point.nis.value_or(std::numeric_limits<double>::quiet_NaN())}, nis);
  };
  py::list changes;
  for (const ModeStay& stay : unlocked([&] {
         if (!smoothed) return target.follow(detections.rows, write), target.explained();
         target.follow(detections.rows, [](const TargetPoint&) {});
         return target.smoothed(write), target.explained();
       }))
    changes.append(py::make_tuple(stay.since, choice.models[stay.mode]));
  return py::make_tuple(x, P, weights, nis, target.components(), changes);
}

/// The same for whole recordings, which the library runs alone. Throws TypeError for a model of the user's own.
TargetChoice known_choice(const std::string& filter, const std::vector<Model>& models, const py::object& transition,
                          const py::dict& rules, py::object& relation) {
  for (const Model& each : models)
    if (!each.known)
      throw py::type_error(filter + ": a recording needs motions of the library; '" + std::string(each.model.name()) +
                           "' is your own, so call the filter's step");
  return choice_of(filter, models, transition, rules, relation);
}

struct Settings {
  TargetChoice choice;
  py::object relation;
};

void bind_targets(py::module_& module) {
  py::class_<Settings> settings(module, "_Settings");
  settings.def(py::init([](const std::string& filter, const std::vector<Model>& models, const py::object& transition,
                           const py::dict& rules) {
    Settings made;
    made.choice = known_choice(filter, models, transition, rules, made.relation);
    return made;
  }));
  settings.def_property_readonly("mode", [](const Settings& self) { return self.relation.attr("to"); });
  settings.def("follow", [](const Settings& self, const Detections& detections, bool smoothed) {
    return follow(self.choice, detections, smoothed);
  });
}

/// A tracker, and the variable of its modes.
struct Scene : MultiTargetTracker {
  py::object mode;
};

void bind_tracker(py::module_& module) {
  py::class_<Scene> tracker(
      module, "MultiTargetTracker",
      "Tracks of many targets among false detections, by JPDA, JPDA* or GNN: the kinds of what is eliminated.\n\n"
      "models, transition and rules are as of track; further rules: detection_probability, clutter_density, …");
  tracker.def(
      py::init([](const std::vector<Model>& models, const std::string& filter, const std::string& pattern,
                  const std::string& permutation, const py::object& transition, const py::kwargs& given) {
        MultiTargetRules scene;
        py::object relation;
        const py::dict others = set_rules(scene, scene_rules(), given);
        const TargetChoice choice = known_choice(filter, models, transition, others, relation);
        const auto fuzzy = [](const char* what, const std::string& kind) {
          return index_among(what, kind, {"random", "fuzzy"}) == 1;
        };
        return Scene{MultiTargetTracker(choice, {fuzzy("pattern", pattern), fuzzy("permutation", permutation)}, scene),
                     relation.attr("to")};
      }),
      py::arg("models"), py::arg("filter") = "himm", py::arg("pattern") = "random", py::arg("permutation") = "random",
      py::arg("transition") = py::none());
  method(tracker, "scan", "Takes a scan; returns whose each detection is, (N,): the number of a track, or 0.",
         [](Scene& self, const Detections& detections) {
           std::vector<std::int64_t> owners(detections.rows.size());
           unlocked([&] { self.scan(detections.rows); });
           for (const DetectionOwner& owner : self.owners())
             owners[owner.tag] = static_cast<std::int64_t>(owner.track.value_or(0));
           return array_of(owners);
         });
  tracker.def(
      "tracks",
      [](const Scene& self, std::optional<double> time) {
        py::list all;
        for (const TrackedTarget& each : self.tracks(time)) {
          const std::size_t n = each.point.mean.size();
          all.append(record(py::arg("number") = each.number, py::arg("time") = each.point.time,
                            py::arg("x") = array_of(each.point.mean),
                            py::arg("P") = copied(each.point.covariance.data(), n, n),
                            py::arg("weights") = array_of(each.point.weights), py::arg("existence") = each.existence,
                            py::arg("necessity") = each.necessity, py::arg("confirmed") = each.confirmed,
                            py::arg("detected") = each.detected));
        }
        return all;
      },
      py::arg("time") = py::none(),
      "All tracks, confirmed or not, predicted to a time in s if it is given: number, time, x (n,), P (n, n), "
      "weights,\n"
      "existence, necessity, confirmed, and detected, in so many scans.");
  tracker.def_readonly("mode", &Scene::mode);
  property(tracker, "components", "Names of what is estimated.", [](const Scene& self) { return self.components(); });
  property(tracker, "time", "The latest time of all detections, in s.", [](const Scene& self) { return self.time(); });
  property(tracker, "finding", "A sentence if rules contradict the data, or None.",
           [](const Scene& self) { return self.finding(); });
}

/// Fits the noise of the motions, the transition and a factor on all standard deviations of the sensors.
py::tuple tune_targets([[maybe_unused]] const Settings& start,
                       [[maybe_unused]] const std::vector<Detections>& recordings, [[maybe_unused]] bool noise,
                       [[maybe_unused]] std::size_t folds, [[maybe_unused]] std::uint64_t seed) {
#ifdef SIGMAX_TUNING
  Tracks tracks;
  std::vector<std::size_t> sizes;
  for (const Detections& recording : recordings) sizes.push_back(tracks.emplace_back(recording.rows).size());
  const TrackScale scale(tracks);
  const RobustLoss robust(tracks, scale);
  auto numbers = motion_numbers(start.choice, scale);
  for (auto& each : transition_numbers(start.choice, scale)) numbers.push_back(std::move(each));
  std::vector<FitParameter> parameters = parameters_of(numbers);
  if (noise) parameters.push_back({.name = "noise", .least = 0.01, .most = 100.0});
  const auto tried = [&](const std::vector<double>& values) {
    TargetChoice choice = start.choice;
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i].set(choice, values[i]);
    return choice;
  };
  const auto losses = [&](const std::vector<double>& values) {
    const TargetChoice choice = tried(values);
    RowLosses all;
    for (std::size_t t = 0; t < tracks.size(); ++t) {
      auto detections = tracks[t];
      for (AnyDetection& each : detections)
        for (double& entry : each.covariance) entry *= noise ? values.back() * values.back() : 1.0;
      all.push_back(robust(t, log_scores(choice, detections)));
    }
    return all;
  };
  const auto objective = [&](const RowLosses& all, const RowCounts& counts) { return robust.objective(all, counts); };
  const TuneProblem problem{parameters, losses, objective};
  const auto [tuned, errors, before] = unlocked([&] {
    std::vector<double> now;
    for (const FitParameter& parameter : parameters) now.push_back(parameter.start);
    Tuned found = tune(problem, folds_of(sizes, folds), {.seed = seed});
    auto standard = standard_errors(problem, found);
    return std::tuple(std::move(found), std::move(standard), objective(losses(now), {}));
  });
  py::dict found;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const double value = tuned.fit.values[i];
    const double unit = parameters[i].scale == Scale::logarithmic ? value : parameters[i].unit;
    found[py::str(parameters[i].name)] = py::make_tuple(value, errors[i] * unit);
  }
  const TargetChoice choice = tried(tuned.fit.values);
  std::vector<Model> models;
  for (const MotionChoice& motion : choice.motions) models.push_back({known_model(motion, choice.axes), motion});
  return py::make_tuple(found, models, choice.transition, choice.sojourn_s, tuned.fit.loss, before);
#else
  throw std::runtime_error("sigmax was built without NLopt (libnlopt-cxx-dev), so it cannot tune");
#endif
}

}  // namespace

TargetChoice choice_of(const std::string& filter, const std::vector<Model>& models, const py::object& transition,
                       const py::dict& rules, py::object& relation) {
  const std::size_t known = index_among("filter", filter, filters), schemes = filters.size() / 2;
  TargetChoice choice;
  choice.fuzzy = known >= schemes;
  choice.scheme = static_cast<Scheme>(known % schemes);
  if (choice.scheme == Scheme::histories) choice.augmentation = StateAugmentation::prior;
  if (choice.scheme == Scheme::histories && !choice.fuzzy) choice.cut = 0.0;
  for (const Model& each : models) {
    const std::string name(each.model.name());
    choice.models.push_back(name);
    for (int k = 2; std::ranges::count(choice.models, choice.models.back()) > 1; ++k)
      choice.models.back() = name + "_" + std::to_string(k);
    choice.motions.push_back(each.known.value_or(MotionChoice{""}));
    choice.axes = each.model.axes();
  }
  for (const auto& [key, value] : set_rules(choice, target_rules(), rules))
    throw py::type_error(filter + ": there is no rule '" + py::cast<std::string>(key) + "'");
  relation = (choice.fuzzy ? transition_of<Fuzzy> : transition_of<Random>)(filter, choice.models, transition);
  choice.models = relation.attr("to").attr("labels").cast<std::vector<std::string>>();
  choice.transition = relation.attr("table").attr("tolist")().cast<std::vector<std::vector<double>>>();
  return choice;
}

void bind_hybrid(py::module_& module) {
  bind_filters(module);
  bind_targets(module);
  bind_tracker(module);
  module.def("_tune", &tune_targets);
}

}  // namespace sigmax::python
