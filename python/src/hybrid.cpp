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

struct KnownFilter {
  const char* name;
  bool fuzzy;
  Scheme scheme;
};
constexpr KnownFilter known_filters[] = {
    {"imm", false, Scheme::interacting},           {"himm", true, Scheme::interacting},
    {"gpb1", false, Scheme::common_start},         {"himm_global", true, Scheme::common_start},
    {"gpb2", false, Scheme::second_order},         {"viterbi", true, Scheme::second_order},
    {"static_random", false, Scheme::independent}, {"static_fuzzy", true, Scheme::independent},
    {"imm_histories", false, Scheme::histories},   {"himm_histories", true, Scheme::histories}};

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
    const auto rule = rules.find(key.cast<std::string>());
    if (rule == rules.end())
      others[key] = value;
    else
      rule->second(data, py::reinterpret_borrow<py::object>(value));
  }
  return others;
}

/// Whether each row could be a distribution of this kind.
template <class Kind>
bool is_table_of(const Array& rows) {
  for (py::ssize_t i = 0; i < rows.shape(0); ++i) {
    double total = 0.0;
    for (py::ssize_t j = 0; j < rows.shape(1); ++j)
      total = AlgebraOf<Kind>::plus(total, rows.data()[i * rows.shape(1) + j]);
    if (!(std::abs(total - 1.0) <= 1e-9)) return false;
  }
  return true;
}

/// The transition of a mode of this kind. Throws TypeError for one of another kind.
template <class Kind>
Relation<Kind, Kind> transition_of(const std::string& filter, const std::vector<std::string>& models,
                                   const py::object& given) {
  using Other = std::conditional_t<std::is_same_v<Kind, Fuzzy>, Random, Fuzzy>;
  if (py::isinstance<Relation<Kind, Kind>>(given)) return given.cast<Relation<Kind, Kind>>();
  const Variable<Kind> mode{"mode", models};
  const std::size_t n = models.size();
  std::vector<std::vector<double>> rows(n, std::vector<double>(n, Kind::total == Fuzzy::total ? 0.5 : 0.05));
  if (given.is_none()) {  // as himm_demo has them
    for (std::size_t i = 0; i < n; ++i) {
      if constexpr (std::is_same_v<Kind, Random>)
        for (double& leaves : rows[i]) leaves /= static_cast<double>(std::max<std::size_t>(n, 2) - 1);
      rows[i][i] = std::is_same_v<Kind, Fuzzy> || n == 1 ? 1.0 : 0.95;
    }
    return {mode, mode, rows};
  }
  if (py::isinstance(given, py::module_::import("sigmax._sigmax").attr("Relation")))
    throw py::type_error(filter + ": a " + std::string(Kind::name) + " mode and a transition " + class_name(given));
  const Array table = as_array(given);
  expect_shape(table, "transition", n, n);
  if (!is_table_of<Kind>(table) && is_table_of<Other>(table))
    refuse(filter, Kind::name, "mode", Other::name, "transition");
  for (std::size_t i = 0; i < n; ++i) rows[i].assign(table.data() + i * n, table.data() + (i + 1) * n);
  return {mode, mode, rows};
}

/// What is known after each row, at its place in series; NaN where there was no step.
class Series {
 public:
  Series(std::size_t rows, std::size_t states, std::size_t modes)
      : x_(pair(rows, states)), P_(triple(rows, states)), weights_(pair(rows, modes)), nis_(py::ssize_t(rows)) {
    for (Array* array : {&x_, &P_, &weights_, &nis_})
      std::fill_n(array->mutable_data(), array->size(), std::numeric_limits<double>::quiet_NaN());
    at_ = {x_.mutable_data(), P_.mutable_data(), weights_.mutable_data(), nis_.mutable_data()};
  }

  /// Needs no lock of Python.
  void write(const TargetPoint& point) {
    std::ranges::copy(point.mean, at_[0] + point.tag * point.mean.size());
    std::ranges::copy(point.covariance, at_[1] + point.tag * point.covariance.size());
    std::ranges::copy(point.weights, at_[2] + point.tag * point.weights.size());
    at_[3][point.tag] = point.nis.value_or(std::numeric_limits<double>::quiet_NaN());
  }
  py::tuple arrays() const { return py::make_tuple(x_, P_, weights_, nis_); }

 private:
  static Array pair(std::size_t rows, std::size_t n) { return Array({py::ssize_t(rows), py::ssize_t(n)}); }
  static Array triple(std::size_t rows, std::size_t n) {
    return Array({py::ssize_t(rows), py::ssize_t(n), py::ssize_t(n)});
  }

  Array x_, P_, weights_, nis_;
  std::array<double*, 4> at_{};
};

/// A recording at the speed of the library: (x, P, weights, nis, components, stays), smoothed or not.
py::tuple follow(TargetChoice choice, const Detections& detections, bool smoothed) {
  choice.rules.record = smoothed || choice.scheme == Scheme::histories;
  AnyTarget target(choice);
  Series series(detections.rows.size(), target.components().size(), choice.models.size());
  const auto write = [&](const TargetPoint& point) { series.write(point); };
  const auto stays = unlocked([&] {
    target.follow(detections.rows,
                  smoothed ? [](const TargetPoint&) {} : std::function<void(const TargetPoint&)>(write));
    if (smoothed) target.smoothed(write);
    return target.explained();
  });
  py::list changes;
  for (const ModeStay& stay : stays) changes.append(py::make_tuple(stay.since, choice.models[stay.mode]));
  return series.arrays() + py::make_tuple(target.components(), changes);
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
    made.choice = choice_of(filter, models, transition, rules, made.relation);
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
  py::class_<TrackedTarget> target(module, "TrackedTarget", "A target as a track of MultiTargetTracker knows it.");
  target.def_readonly("number", &TrackedTarget::number);
  target.def_readonly("existence", &TrackedTarget::existence);
  target.def_readonly("necessity", &TrackedTarget::necessity);
  target.def_readonly("confirmed", &TrackedTarget::confirmed);
  target.def_readonly("detected", &TrackedTarget::detected);
  property(target, "time", "In s.", [](const TrackedTarget& self) { return self.point.time; });
  property(target, "x", "Mean, (n,).", [](const TrackedTarget& self) { return array_of(self.point.mean); });
  property(target, "P", "Covariance, (n, n).", [](const TrackedTarget& self) {
    return copied(self.point.covariance.data(), self.point.mean.size(), self.point.mean.size());
  });
  property(target, "weights", "Of the modes.", [](const TrackedTarget& self) { return array_of(self.point.weights); });

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
        const TargetChoice choice = choice_of(filter, models, transition, others, relation);
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
      "tracks", [](const Scene& self, std::optional<double> time) { return self.tracks(time); },
      py::arg("time") = py::none(), "All tracks, confirmed or not, predicted to a time in s if it is given.");
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
  std::vector<std::string> names;
  for (const KnownFilter& known : known_filters) names.emplace_back(known.name);
  const KnownFilter& known = known_filters[index_among("filter", filter, names)];
  TargetChoice choice;
  choice.fuzzy = known.fuzzy;
  choice.scheme = known.scheme;
  if (known.scheme == Scheme::histories) choice.augmentation = StateAugmentation::prior;
  if (known.scheme == Scheme::histories && !known.fuzzy) choice.cut = 0.0;
  for (const Model& each : models) {
    std::string name(each.model.name());
    for (int k = 2; std::ranges::find(choice.models, name) != choice.models.end(); ++k)
      name = std::string(each.model.name()) + "_" + std::to_string(k);
    choice.models.push_back(name);
    choice.motions.push_back(each.known.value_or(MotionChoice{""}));
    choice.axes = each.model.axes();
  }
  const py::dict others = set_rules(choice, target_rules(), rules);
  for (const auto& [key, value] : others)
    throw py::type_error(filter + ": there is no rule '" + key.cast<std::string>() + "'");
  const auto take = [&](const auto& made) {
    choice.models.clear();
    for (std::size_t j = 0; j < made.to().size(); ++j) choice.models.push_back(made.to().label(j));
    choice.transition.clear();
    for (std::size_t i = 0; i < made.from().size(); ++i) {
      const auto& row = choice.transition.emplace_back(made.to().size());
      for (std::size_t j = 0; j < row.size(); ++j) choice.transition[i][j] = made(i, j);
    }
    relation = py::cast(made);
  };
  if (known.fuzzy)
    take(transition_of<Fuzzy>(filter, choice.models, transition));
  else
    take(transition_of<Random>(filter, choice.models, transition));
  return choice;
}

void bind_hybrid(py::module_& module) {
  bind_filters(module);
  bind_targets(module);
  bind_tracker(module);
  module.def("_tune", &tune_targets);
}

}  // namespace sigmax::python
