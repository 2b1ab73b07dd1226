#include "tracking.hpp"

#include <cmath>
#include <functional>
#include <memory>
#include <type_traits>

#include <pybind11/stl.h>

#include <sigmax/hybrid/history_filter.hpp>
#include <sigmax/hybrid/interacting_multiple_model.hpp>
#include <sigmax/hybrid/mode_transition.hpp>
#include <sigmax/hybrid/second_order_multiple_model.hpp>

namespace sigmax::python {
namespace {

/// A start of n components in the order of `components`.
detail::ConstView start_of(const Array& x, const Array& P, int n) {
  expect_shape(x, "x", n);
  expect_shape(P, "P", n, n);
  return {x.data(), P.data(), n};
}

template <class Kind>
void believe(MultipleModelFilter<Kind>& filter, const py::object& mode) {
  if (!py::isinstance<Distribution<Kind>>(mode))
    throw py::type_error("mode: a " + std::string(Kind::name) + " mode and a " + class_name(mode));
  auto state = filter.state();
  state.belief = Belief<Kind>(mode.cast<Distribution<Kind>>());
  state.most_likely_mode = index_of_greatest(state.belief.logs());
  for (std::size_t h = 0; h < state.histories.size(); ++h)
    state.histories[h].log_weight = state.belief.log(state.histories[h].mode);
  filter.restore(state);
}

template <class Kind>
std::unique_ptr<MultipleModelFilter<Kind>> filter_of(const Settings& made, const py::object& x, const py::object& P,
                                                     const py::object& mode) {
  const TargetChoice& choice = made.choice;
  const Estimates nowhere = detail::anywhere(made.models);
  const auto& given = made.relation.cast<const Relation<Kind, Kind>&>();
  ModeTransition<Kind> transition = given;
  if (!choice.sojourn_s.empty()) transition = TimedTransition<Kind>(given.to(), rates_of_sojourns(choice.sojourn_s));
  Interaction<Kind> interaction{choice.augmentation};
  interaction.output_tie = choice.output_tie;
  interaction.likelihood = choice.likelihood;
  if constexpr (std::is_same_v<Kind, Fuzzy>) interaction.collapse = {choice.mixed_covariance, choice.mixing_tie};
  const HistoryRules<Kind> rules{.histories = choice.histories, .cut = choice.cut, .tempering = choice.tempering};
  std::unique_ptr<MultipleModelFilter<Kind>> filter;
  if (choice.scheme == Scheme::histories)
    filter = std::make_unique<HistoriesOfModes<Kind>>(made.models, transition, nowhere, rules, interaction);
  else if (choice.scheme == Scheme::second_order)
    filter = std::make_unique<SecondOrderFilter<Kind>>(made.models, transition, nowhere, interaction);
  else
    filter = std::make_unique<InteractingFilter<Kind>>(made.models, transition, nowhere, interaction);
  if (x.is_none() != P.is_none()) throw py::type_error("a start needs both of x and P");
  if (!x.is_none()) filter->restart(start_of(as_array(x), as_array(P), filter->component_count()));
  if (!mode.is_none()) believe(*filter, mode);
  return filter;
}

/// Mean (n,) and covariance (n, n).
template <class Kind>
std::pair<Array, Array> estimate(const MultipleModelFilter<Kind>& filter) {
  const int n = filter.component_count();
  std::pair<Array, Array> result{Array(n), Array({n, n})};
  filter.output({result.first.mutable_data(), result.second.mutable_data(), n});
  return result;
}

/// An argument of this class, quicker than by pybind11's own conversion. Throws TypeError for another class.
template <class T>
const T& argument(const py::object& object) {
  if (!py::isinstance<T>(object)) throw py::type_error("step: unexpected " + class_name(object));
  return object.cast<const T&>();
}

template <class Kind>
void bind_kind(py::module_& module) {
  using Filter = MultipleModelFilter<Kind>;
  py::class_<Filter> type(module, (capital(Kind::name) + "ModeFilter").c_str(),
                          "A multiple-model filter with a mode of this kind.");
  type.def(py::init(&filter_of<Kind>));
  type.def(
      "step",
      [](Filter& self, double dt, const py::object& numbers, const py::object& noise, const py::object& sensor,
         const py::object& gate) {
        if (numbers.is_none()) return self.step(dt);
        const Array z = measured(numbers), R = measured(noise);
        expect_shape(z, "z", -1);
        require_quantities(z.size(), sensor.is_none() ? 3 : max_measurement_size);
        const auto m = static_cast<int>(z.size());
        double covariance[max_measurement_size * max_measurement_size];
        write_covariance(R, 0, 1, m, covariance);
        const AnySensor& eye = sensor.is_none() ? detail::position_sensor(m) : argument<Sensor>(sensor).any;
        const Seen seen{{z.data(), covariance, m}, detail::sensor_of_models(eye)};
        self.step(dt, &seen, gate.is_none() ? Gate() : argument<Gate>(gate));
      },
      "One cycle, dt seconds after the last, without a detection or with z (m,) and its R, (m, m) or variances (m,).\n"
      "\nWithout a sensor z is a position. Beyond the gate it counts as missed.",
      py::arg("dt"), py::arg("z") = py::none(), py::arg("R") = py::none(), py::arg("sensor") = py::none(),
      py::arg("gate") = py::none());
  type.def_static(
      "step_all",
      [](const std::vector<std::reference_wrapper<Filter>>& filters, double dt, const py::object& numbers,
         const Array& R) {
        const Array z = measured(numbers);
        expect_shape(z, "z", filters.size(), -1);
        require_quantities(z.shape(1), 3);
        const auto m = static_cast<int>(z.shape(1));
        double covariance[max_measurement_size * max_measurement_size];
        for (py::ssize_t t = 0; t < z.shape(0); ++t) {
          write_covariance(R, t, z.shape(0), m, covariance);
          const Seen seen{{z.data(t, 0), covariance, m}, detail::sensor_of_models(detail::position_sensor(m))};
          filters[static_cast<std::size_t>(t)].get().step(dt, std::isnan(*z.data(t, 0)) ? nullptr : &seen);
        }
      },
      "Steps a bank of T filters by positions z (T, m), a row of NaN where one was missed, and R as of Detections.",
      py::arg("filters"), py::arg("dt"), py::arg("z"), py::arg("R"));
  property(type, "components", "Names of the n states.", [](const Filter& self) { return self.components(); });
  property(type, "x", "Mean of the output, (n,): (64)–(68).", [](const Filter& self) { return estimate(self).first; });
  property(type, "P", "Covariance of the output, (n, n).", [](const Filter& self) { return estimate(self).second; });
  property(type, "weights", "Distribution of the mode.",
           [](const Filter& self) { return self.belief().distribution(); });
  property(type, "nis", "Normalised innovation squared of the last step, or None if no detection passed the gate.",
           [](const Filter& self) { return self.accepted() ? std::optional(self.nis()) : std::nullopt; });
}

}  // namespace

void bind_filters(py::module_& module) {
  py::class_<Gate>(module, "Gate", "Gate(probability): lets a right detection pass with this probability.")
      .def(py::init(&Gate::probability), py::arg("probability") = 1.0);
  bind_kind<Random>(module);
  bind_kind<Fuzzy>(module);
}

}  // namespace sigmax::python
