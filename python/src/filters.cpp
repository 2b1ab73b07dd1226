#include "tracking.hpp"

#include <array>
#include <type_traits>
#include <utility>

#include <pybind11/stl.h>

#include <sigmax/hybrid/filter_bank.hpp>
#include <sigmax/hybrid/history_filter.hpp>
#include <sigmax/hybrid/interacting_multiple_model.hpp>
#include <sigmax/hybrid/mode_transition.hpp>
#include <sigmax/hybrid/second_order_multiple_model.hpp>

namespace sigmax::python {
namespace {

template <class Kind>
Interaction<Kind> interaction_of(const TargetChoice& choice) {
  Interaction<Kind> interaction;
  interaction.augmentation = choice.augmentation;
  interaction.entry = choice.entry;
  interaction.output_tie = choice.output_tie;
  interaction.likelihood = choice.likelihood;
  if constexpr (std::is_same_v<Kind, Fuzzy>)
    interaction.collapse = {choice.mixed_covariance, choice.mixing_tie};
  else
    interaction.collapse = {choice.imm_mixing, choice.output_spread};
  return interaction;
}

/// What a filter, or a bank of tracks, is made of.
template <class Kind>
struct Made {
  Made(const std::string& filter, const std::vector<Model>& own, const py::object& transition, const py::dict& rules) {
    if (own.empty()) throw std::invalid_argument(filter + ": expected one model or more");
    choice = choice_of(filter, own, transition, rules, relation);
    for (const Model& each : own)
      models.push_back(each.known ? known_model(*each.known, each.model.axes(), choice.member) : each.model);
  }
  ModeTransition<Kind> transition() const {
    const auto own = relation.cast<Relation<Kind, Kind>>();
    if (choice.sojourn_s.empty()) return own;
    return TimedTransition<Kind>(own.to(), rates_of_sojourns(choice.sojourn_s));
  }

  std::vector<AnyModel> models;
  py::object relation;
  TargetChoice choice;
};

/// A start of n components in the order of `components`.
detail::ConstView start_of(const Array& x, const Array& P, int n) {
  expect_shape(x, "x", n);
  expect_shape(P, "P", n, n);
  return {x.data(), P.data(), n};
}

template <class Kind>
void believe(MultipleModelFilter<Kind>& filter, const py::object& mode) {
  const Variable<Kind>& variable = filter.system().mode_variable();
  if (!py::isinstance<Distribution<Kind>>(mode) && py::hasattr(mode, "variable"))
    throw py::type_error("mode: a " + std::string(Kind::name) + " mode and a " + class_name(mode));
  auto state = filter.state();
  if (py::isinstance<Distribution<Kind>>(mode))
    state.belief = Belief<Kind>(mode.cast<Distribution<Kind>>());
  else
    state.belief = Belief<Kind>(Distribution<Kind>(variable, row_of(as_array(mode))));
  state.most_likely_mode = index_of_greatest(state.belief.logs());
  for (std::size_t h = 0; h < state.histories.size(); ++h)
    state.histories[h].log_weight = state.belief.log(state.histories[h].mode);
  filter.restore(state);
}

/// Mean (n,) and covariance (n, n), written by write(view).
template <class Write>
std::pair<Array, Array> estimate(int n, const Write& write) {
  std::pair<Array, Array> result{Array(n), Array({n, n})};
  write(detail::View{result.first.mutable_data(), result.second.mutable_data(), n});
  return result;
}
template <class Kind>
std::pair<Array, Array> estimate(const MultipleModelFilter<Kind>& filter) {
  return estimate(filter.component_count(), [&](detail::View result) { filter.output(result); });
}

template <class Filter, class Kind>
void bind_filter(py::module_& module, const char* name, const std::string& by_name, const char* doc) {
  py::class_<Filter, MultipleModelFilter<Kind>> type(module, name, doc);
  type.def(py::init([by_name](const std::vector<Model>& models, const py::object& transition, const py::object& x,
                              const py::object& P, const py::object& mode, const py::kwargs& rules) {
             const Made<Kind> made(by_name, models, transition, rules);
             const Estimates nowhere = detail::anywhere(made.models);
             const auto interaction = interaction_of<Kind>(made.choice);
             const auto make = [&] {
               if constexpr (std::is_same_v<Filter, HistoriesOfModes<Kind>>)
                 return std::make_unique<Filter>(made.models, made.transition(), nowhere,
                                                 HistoryRules<Kind>{.histories = made.choice.histories,
                                                                    .cut = made.choice.cut,
                                                                    .tempering = made.choice.tempering},
                                                 interaction);
               else
                 return std::make_unique<Filter>(made.models, made.transition(), nowhere, interaction);
             };
             auto filter = make();
             if (x.is_none() != P.is_none()) throw py::type_error("a start needs both of x and P");
             if (!x.is_none()) {
               const Array mean = as_array(x), covariance = as_array(P);
               filter->restart(start_of(mean, covariance, filter->component_count()));
             }
             if (!mode.is_none()) believe(*filter, mode);
             return filter;
           }),
           py::arg("models"), py::arg("transition") = py::none(), py::kw_only(), py::arg("x") = py::none(),
           py::arg("P") = py::none(), py::arg("mode") = py::none());
}

template <class Kind>
void bind_kind(py::module_& module) {
  using Filter = MultipleModelFilter<Kind>;
  const std::string kind = capital(Kind::name);
  py::class_<Filter> type(module, (kind + "ModeFilter").c_str(), "A multiple-model filter with a mode of this kind.");
  type.def(
      "step",
      [](Filter& self, double dt, const py::object& numbers, const py::object& noise, const py::object& sensor,
         const py::object& gate) {
        static const Gate open;
        const Array z = quick_array(numbers), R = quick_array(noise);
        expect_shape(z, "z", -1);
        const auto m = static_cast<int>(z.size());
        if (m < 1 || m > (sensor.is_none() ? 3 : max_measurement_size))
          throw std::invalid_argument("z has " + std::to_string(m) +
                                      " numbers; expected 1 to 3 of a position, or 1 to 6 "
                                      "of a sensor");
        double covariance[max_measurement_size * max_measurement_size];
        write_covariance(R, 0, 1, m, covariance);
        const AnySensor& own = sensor.is_none() ? detail::position_sensor(m) : argument<Sensor>("sensor", sensor).any;
        const Seen seen{{z.data(), covariance, m}, detail::sensor_of_models(own)};
        self.step(dt, &seen, gate.is_none() ? open : argument<Gate>("gate", gate));
      },
      "One cycle, dt seconds after the last, without a detection or with z (m,) and its R, (m, m) or variances "
      "(m,).\n\n"
      "Without a sensor z is a position. Beyond the gate it counts as missed.",
      py::arg("dt"), py::arg("z"), py::arg("R"), py::arg("sensor") = py::none(), py::arg("gate") = py::none());
  type.def(
      "step", [](Filter& self, double dt) { self.step(dt); }, py::arg("dt"));
  type.def(
      "restart",
      [](Filter& self, const Array& x, const Array& P) { self.restart(start_of(x, P, self.component_count())); },
      "Starts again from x (n,) and P (n, n); nothing is known of the mode.", py::arg("x"), py::arg("P"));
  property(type, "components", "Names of the n states.", [](const Filter& self) { return self.components(); });
  property(type, "x", "Mean of the output, (n,): (64)–(68).", [](const Filter& self) { return estimate(self).first; });
  property(type, "P", "Covariance of the output, (n, n).", [](const Filter& self) { return estimate(self).second; });
  property(type, "estimates", "(x, P) of each model in its own components.", [](const Filter& self) {
    py::list all;
    for (std::size_t j = 0; j < self.modes(); ++j) {
      const detail::ConstView from = self.estimates().view(j);
      all.append(estimate(from.n, [&](detail::View to) { detail::copy(from, to); }));
    }
    return all;
  });
  property(type, "weights", "Distribution of the mode.",
           [](const Filter& self) { return self.belief().distribution(); });
  property(type, "most_likely_mode", "Its label.",
           [](const Filter& self) { return self.system().mode_variable().label(self.most_likely_mode()); });
  property(type, "nis", "Normalised innovation squared of the last step, or None if no detection passed the gate.",
           [](const Filter& self) { return self.accepted() ? std::optional(self.nis()) : std::nullopt; });
  property(type, "log_score", "How well the last detection was predicted, in nats; None if it was missed.",
           [](const Filter& self) { return self.accepted() ? std::optional(self.log_score()) : std::nullopt; });
}

/// Many tracks: a row of every array is a track's.
template <class Kind>
struct Bank {
  explicit Bank(const Made<Kind>& made) : tracks(made.models, made.transition(), interaction_of<Kind>(made.choice)) {}

  /// (x, P, weights).
  std::array<Array, 3> series() const {
    const auto& filter = tracks.filter();
    const int n = filter.component_count();
    std::array<Array, 3> all{unknown(count, n), unknown(count, n, n), unknown(count, filter.modes())};
    auto& [x, P, weights] = all;
    for (std::size_t t = 0; t < count; ++t) {
      if (!tracks.lives(t)) continue;
      const auto state = tracks.state(t);
      filter.output(state, {x.mutable_data(t, 0), P.mutable_data(t, 0, 0), n});
      for (std::size_t j = 0; j < filter.modes(); ++j) *weights.mutable_data(t, j) = state.belief[j];
    }
    return all;
  }

  TrackBank<Kind, double> tracks;
  std::size_t count = 0;  ///< one more than the greatest number of a track
};

template <class Kind>
void bind_bank(py::module_& module, const char* name, const std::string& filter) {
  using B = Bank<Kind>;
  py::class_<B> type(
      module, name,
      "Many tracks at once, each as by its own filter: for models along independent axes, and positions.");
  type.def(py::init([filter](const std::vector<Model>& models, const py::object& transition, const py::kwargs& rules) {
             return B(Made<Kind>(filter, models, transition, rules));
           }),
           py::arg("models"), py::arg("transition") = py::none());
  method(type, "add", "Begins a track from x (n,) and P (n, n); returns its number, which is its row.",
         [](B& self, const Array& x, const Array& P) {
           const std::size_t track = self.tracks.add(start_of(x, P, self.tracks.filter().component_count()));
           self.count = std::max(self.count, track + 1);
           return track;
         });
  method(type, "remove", "Ends a track.", [](B& self, std::size_t track) { self.tracks.remove(track); });
  type.def("__len__", [](const B& self) { return self.tracks.size(); });
  type.def(
      "step",
      [](B& self, double dt, const py::object& positions, const Array& R, std::size_t threads) {
        const Array z = unmasked(positions);
        const int m = self.tracks.filter().fast_path().axes();
        expect_shape(z, "z", self.count, m);
        auto scan = self.tracks.scan();
        double covariance[max_measurement_size * max_measurement_size];
        for (py::ssize_t t = 0; t < z.shape(0); ++t) {
          const double* const row = z.data() + t * m;
          if (std::all_of(row, row + m, [](double number) { return std::isnan(number); })) continue;
          write_covariance(R, t, z.shape(0), m, covariance);
          scan.set(static_cast<std::size_t>(t), {row, covariance, m});
        }
        unlocked([&] { self.tracks.run(dt, {&scan, 1}, threads); });
      },
      "Steps all tracks by z (T, m), a row of NaN where one was missed, and R (m, m), (m,) or (T, m, m).",
      py::arg("dt"), py::arg("z"), py::arg("R"), py::arg("threads") = 1);
  property(type, "x", "Means (T, n), NaN where no track is.", [](const B& self) { return self.series()[0]; });
  property(type, "P", "Covariances (T, n, n).", [](const B& self) { return self.series()[1]; });
  property(type, "weights", "Of the modes, (T, modes).", [](const B& self) { return self.series()[2]; });
}

}  // namespace

void bind_filters(py::module_& module) {
  py::class_<Gate>(module, "Gate", "Gate(probability): lets a right detection pass with this probability.")
      .def(py::init(&Gate::probability), py::arg("probability") = 1.0);
  bind_kind<Random>(module);
  bind_kind<Fuzzy>(module);
  bind_filter<InteractingFilter<Random>, Random>(
      module, "IMM", "imm", "The interacting multiple-model filter of Blom and Bar-Shalom: a random mode.");
  bind_filter<InteractingFilter<Fuzzy>, Fuzzy>(module, "HIMM", "himm",
                                               "The same with a fuzzy mode, section V: Mei, Xu and Liu.");
  bind_filter<SecondOrderFilter<Random>, Random>(module, "GPB2", "gpb2", "Merges predecessors after the measurement.");
  bind_filter<SecondOrderFilter<Fuzzy>, Fuzzy>(module, "Viterbi", "viterbi",
                                               "Keeps the best predecessor of each mode.");
  bind_filter<HistoriesOfModes<Random>, Random>(module, "IMMHistories", "imm_histories",
                                                "Prunes histories of a random mode and never merges them.");
  bind_filter<HistoriesOfModes<Fuzzy>, Fuzzy>(module, "HIMMHistories", "himm_histories",
                                              "Keeps the most possible histories of a fuzzy mode, (A-1), (A-11).");
  bind_bank<Random>(module, "IMMBank", "imm");
  bind_bank<Fuzzy>(module, "HIMMBank", "himm");
}

}  // namespace sigmax::python
