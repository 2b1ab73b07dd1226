#include "multiple_model_filter.hpp"

#include <numeric>

#include <sigmax/core/compose.hpp>
#include <sigmax/hybrid/sound.hpp>

namespace sigmax {

using detail::ConstView;
using detail::View;

template <ScalableUncertainty Kind>
MultipleModelFilter<Kind>::MultipleModelFilter(const std::vector<AnyModel>& models, ModeTransition<Kind> transition,
                                               const Estimates& start, const Interaction<Kind>& interaction)
    : system_(models, std::move(transition)),
      interaction_(interaction),
      components_(models),
      innovations_(modes()),
      prior_(uninformative(system_.mode_variable())),
      entries_(detail::estimates_of(models)),
      laws_(modes()),
      states_{State{start, prior_}, State{start, prior_}} {
  check::starts(models, start);
  check::prior(interaction_.entry);
  detail::write_entries(models, interaction_.entry, interaction_.entry.root_mean_square(), entries_);
  forget_mode();
}

template <ScalableUncertainty Kind>
void MultipleModelFilter<Kind>::restore(const State& state) {
  check::starts(system_.models(), state.estimates);
  check::same(system_.mode_variable(), state.belief.variable(), "restore");
  states_[current_] = state;
  ++version_;
  seen_ = accepted_ = false;
}

template <ScalableUncertainty Kind>
void MultipleModelFilter<Kind>::restart(const Estimates& starts) {
  check::starts(system_.models(), starts);
  states_[current_].estimates = starts;
  forget_mode();
  begin();
}

template <ScalableUncertainty Kind>
void MultipleModelFilter<Kind>::restart(ConstView start) {
  restart(components_.shares(start));
}

template <ScalableUncertainty Kind>
void MultipleModelFilter<Kind>::forget_mode() {
  states_[current_].belief = Belief{uninformative(system_.mode_variable())};
  ++version_;
  states_[current_].most_likely_mode = detail::select(modes(), logs_of(belief()), 0, interaction_.output_tie);
  seen_ = accepted_ = false;
}

template <ScalableUncertainty Kind>
void MultipleModelFilter<Kind>::transform(const double* A, const double* b, int axes) {
  ++version_;
  for (std::size_t j = 0; j < modes(); ++j) detail::transform(A, b, axes, states_[current_].estimates.view(j));
}

template <ScalableUncertainty Kind>
detail::Mixture MultipleModelFilter<Kind>::mixture(ConstView receiver, const detail::Correspondence* maps,
                                                   const Estimates& estimates, detail::Mixture::Part* parts) const {
  for (std::size_t l = 0; l < modes(); ++l) parts[l] = {estimates.view(l), maps + l};
  return {receiver, {parts, modes()}, interaction_.augmentation};
}

template <ScalableUncertainty Kind>
void MultipleModelFilter<Kind>::output_receiver(const State& state, View result) const {
  const auto count = static_cast<std::size_t>(component_count());
  detail::Scratch<32, std::size_t> carriers(component_count());
  for (std::size_t i = 0; i < count; ++i)
    carriers[i] = detail::select(
        modes(),
        [&](std::size_t l) {
          const bool has = components_.of_all()[l].in_source[i] >= 0;
          return has ? std::max(state.belief.log(l), std::numeric_limits<double>::lowest()) : log_zero;
        },
        state.most_likely_mode, interaction_.output_tie);
  components_.carry(lenders(state.estimates), carriers, result);
}

/// act(the estimates of a state as a mixture in `components()`, its weights, its winner).
template <ScalableUncertainty Kind>
template <class Act>
auto MultipleModelFilter<Kind>::of_output(const State& state, const Act& act) const {
  const int n = component_count();
  detail::Scratch mean(n), covariance(n * n);
  const View receiver{mean, covariance, n};
  output_receiver(state, receiver);
  detail::Parts parts(static_cast<int>(modes()));
  detail::OfModes weights(static_cast<int>(modes()));
  for (std::size_t j = 0; j < modes(); ++j) weights[j] = state.belief[j];
  return act(mixture(receiver, components_.of_all(), state.estimates, parts), weights.data(), state.most_likely_mode);
}

template <ScalableUncertainty Kind>
void MultipleModelFilter<Kind>::output(const State& state, View result) const {
  of_output(state, [&](const auto&... mixture) { detail::collapse(interaction_.collapse, mixture..., result); });
}
template <ScalableUncertainty Kind>
void MultipleModelFilter<Kind>::most_likely_output(const State& state, View result) const {
  of_output(state, [&](const auto&... mixture) { detail::collapse(Selection{}, mixture..., result); });
}

template <ScalableUncertainty Kind>
double MultipleModelFilter<Kind>::beta() const requires SelectiveAlgebra<AlgebraOf<Kind>> {
  const int n = component_count();
  detail::Scratch mean(n), covariance(n * n);
  return of_output(state(), [&](const auto& mixture, const double* weights, std::size_t) {
    return detail::match_envelope(mixture, weights, {mean, covariance, n});
  });
}

template <ScalableUncertainty Kind>
double MultipleModelFilter<Kind>::nis() const {
  double numbers[max_measurement_size];
  return normalize(predicted_innovation(), numbers);
}

template <ScalableUncertainty Kind>
int MultipleModelFilter<Kind>::normalized_innovation(double* numbers) const {
  const AnyInnovation innovation = predicted_innovation();
  normalize(innovation, numbers);
  return innovation.size;
}

template <ScalableUncertainty Kind>
AnyInnovation MultipleModelFilter<Kind>::predicted_innovation() const {
  if (!seen_) throw std::logic_error("nis() after a step without a measurement");
  const auto [innovations, log_weights, most_likely] = predictors();
  detail::OfModes weights(static_cast<int>(log_weights.size()));
  std::transform(log_weights.begin(), log_weights.end(), weights.data(), [](double log) { return std::exp(log); });
  return collapsed(innovations, weights, most_likely);
}

template <ScalableUncertainty Kind>
double MultipleModelFilter<Kind>::log_evidence() const {
  const Predictors by = predictors();
  return detail::log_total<Kind>(by.log_weights.size(),
                                 [&](std::size_t i) { return by.log_weights[i] + by.innovations[i].log_likelihood; });
}

template <ScalableUncertainty Kind>
double MultipleModelFilter<Kind>::log_score() const {
  const auto log_weights = predictors().log_weights;
  return log_evidence() - detail::log_total<Random>(log_weights.size(), [&](std::size_t i) { return log_weights[i]; });
}

template <ScalableUncertainty Kind>
double MultipleModelFilter<Kind>::gate_distance() const {
  if (gate_distance_) return *gate_distance_;
  const Predictors by = predictors();
  return -2.0 * detail::log_total<Kind>(by.log_weights.size(), [&](std::size_t i) {
    return by.log_weights[i] - 0.5 * by.innovations[i].squared_distance;
  });
}

template <ScalableUncertainty Kind>
typename MultipleModelFilter<Kind>::Predictors MultipleModelFilter<Kind>::predictors() const {
  return {innovations_, prior_.logs(), detail::select(modes(), logs_of(prior_), mode_before_, interaction_.output_tie)};
}

template <ScalableUncertainty Kind>
bool MultipleModelFilter<Kind>::passes(double limit, std::optional<double> distance) {
  gate_distance_ = distance;
  return limit == std::numeric_limits<double>::infinity() || gate_distance() <= limit;
}

template <ScalableUncertainty Kind>
void MultipleModelFilter<Kind>::predict_mode(double dt) {
  seen_ = accepted_ = false;
  compose(system_.transition(dt), belief(), prior_);
  laws(dt);
}

template <ScalableUncertainty Kind>
const std::vector<detail::AxisLaw>& MultipleModelFilter<Kind>::laws(double dt) {
  if (dt == laws_dt_) return laws_;
  laws_dt_ = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t j = 0; j < modes(); ++j) {
    const detail::ModelRef& ref = model(j).ref();
    if (ref.table->law) ref.table->law(ref.motion, dt, laws_[j]);
  }
  laws_dt_ = dt;
  return laws_;
}

template <ScalableUncertainty Kind>
void MultipleModelFilter<Kind>::predict_model(std::size_t j, ConstView prior, double dt, View result) const {
  const detail::ModelRef& ref = model(j).ref();
  if (ref.table->law)
    detail::predict(laws_[j], ref.table->axes, prior, result);
  else
    detail::predict(ref, prior, dt, result);
}

template <ScalableUncertainty Kind>
void MultipleModelFilter<Kind>::update_model(std::size_t j, ConstView prior, const Seen& seen, View posterior,
                                             AnyInnovation& innovation) const {
  innovation.size = seen.z.n;
  detail::InnovationView told{innovation.residual_numbers.data(), innovation.covariance_numbers.data()};
  detail::update(model(j).ref(), prior, seen.z, seen.sensor.of(system_.models(), j), posterior, told);
  innovation.squared_distance = told.squared_distance;
  innovation.log_likelihood =
      interaction_.likelihood == LikelihoodForm::possibility ? -0.5 * told.squared_distance : told.log_likelihood;
  if (std::isnan(innovation.log_likelihood))
    throw std::domain_error("the likelihood in mode '" + system_.mode_variable().label(j) + "' is not a number");
}

template <ScalableUncertainty Kind>
void MultipleModelFilter<Kind>::step(double dt, const Seen* seen, const Gate& gate) {
  require(dt, seen);
  mode_before_ = most_likely_mode();
  const double limit = seen ? gate.limit(seen->z.n) : 0.0;
  bool accepted = false;
  try {
    next().most_likely_mode = modes();  // none yet
    if (seen) accepted = measure(dt, *seen, limit);
    if (!accepted) {
      next().most_likely_mode = modes();
      miss(dt);
    }
  } catch (const std::domain_error& error) {
    throw std::domain_error(this_step(dt) + ": " + error.what());
  }
  conclude(accepted);
  seen_ = seen != nullptr;
}

template <ScalableUncertainty Kind>
RecordedStep<Kind> MultipleModelFilter<Kind>::recorded(double dt, const Seen* seen) const {
  if (!seen && accepted_)
    throw std::logic_error("recorded(dt) after a step with a measurement; expected recorded(dt, z)");
  RecordedStep<Kind> result{dt, {estimates(), belief(), most_likely_mode()}, {}};
  if (!accepted_) return result;
  const Estimates predicted = this->predicted();
  const int m = seen->z.n;
  for (std::size_t j = 0; j < modes(); ++j) {
    const ConstView before = predicted.view(j), after = estimates().view(j);
    const int n = before.n;
    double residual[max_measurement_size], R[max_measurement_size * max_measurement_size], L[sizeof(R) / sizeof(*R)];
    detail::Scratch<64> H(m * n);
    detail::linearised_measurement(model(j).ref(), before, seen->z, seen->sensor.of(system_.models(), j), residual, H,
                                   R);
    if (!detail::cholesky_factor(R, m, L)) {  // where R is singular, the rounding of S stands for its zeros
      for (int i = 0; i < m; ++i) R[i + i * m] += 1e-24;
      detail::cholesky_factor(R, m, L);
    }
    for (int i = 0; i < m; ++i)
      for (int k = 0; k < n; ++k) residual[i] -= H[i + k * m] * (after.mean[k] - before.mean[k]);
    for (int k = 0; k < n; ++k) detail::lower_solve(L, m, H + k * m);
    detail::lower_solve(L, m, residual);
    result.seen.emplace_back(n).add(H, residual, m);
  }
  return result;
}

template <ScalableUncertainty Kind>
void MultipleModelFilter<Kind>::conclude(bool accepted) {
  if (next().most_likely_mode == modes())
    next().most_likely_mode =
        detail::select(modes(), logs_of(next().belief), most_likely_mode(), interaction_.output_tie);
  current_ = 1 - current_;
  ++version_;
  accepted_ = accepted;
  ++steps_;
}

template <ScalableUncertainty Kind>
AnyInnovation MultipleModelFilter<Kind>::collapsed(std::span<const AnyInnovation> innovations, const double* weights,
                                                   std::size_t winner) {
  detail::Parts parts(static_cast<int>(innovations.size()));
  for (std::size_t l = 0; l < innovations.size(); ++l) parts[l] = {innovations[l].view()};
  AnyInnovation result = innovations[winner];
  detail::collapse(Collapse<Kind>{}, {innovations[winner].view(), {parts.data(), innovations.size()}}, weights, winner,
                   {result.residual_numbers.data(), result.covariance_numbers.data(), result.size});
  return result;
}

template <ScalableUncertainty Kind>
double MultipleModelFilter<Kind>::normalize(const AnyInnovation& innovation, double* numbers) {
  double L[max_measurement_size * max_measurement_size];
  const int m = innovation.size;
  std::fill_n(numbers, m, std::numeric_limits<double>::infinity());
  if (detail::cholesky_factor(innovation.covariance_numbers.data(), m, L)) {
    std::copy_n(innovation.residual_numbers.begin(), m, numbers);
    detail::lower_solve(L, m, numbers);
  }
  return std::inner_product(numbers, numbers + m, numbers, 0.0);
}

template <ScalableUncertainty Kind>
void MultipleModelFilter<Kind>::require(double dt, const Seen* seen) const {
  if (!(dt >= 0.0 && std::isfinite(dt)))
    throw std::invalid_argument(this_step(dt) + ": expected a finite time that is not negative");
  if (seen && !check::finite(seen->z))
    throw std::invalid_argument(this_step(dt) + ": the measurement, or its covariance, is not finite");
}

template <ScalableUncertainty Kind>
std::string MultipleModelFilter<Kind>::this_step(double dt) const {
  return "step " + std::to_string(steps_ + 1) + " of " + std::to_string(dt) + " s";
}

template class MultipleModelFilter<Random>;
template class MultipleModelFilter<Fuzzy>;

}  // namespace sigmax
