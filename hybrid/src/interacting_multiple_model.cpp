#include <sigmax/hybrid/interacting_multiple_model.hpp>

#include <numbers>

#include <sigmax/core/compose.hpp>
#include <sigmax/hybrid/sound.hpp>

#include "multiple_model_filter.hpp"

namespace sigmax {

template <ScalableUncertainty Kind>
InteractingFilter<Kind>::InteractingFilter(const std::vector<AnyModel>& models, ModeTransition<Kind> transition,
                                           const Estimates& start, const Interaction<Kind>& interaction)
    : Filter(models, std::move(transition), start, interaction),
      predicted_(start),
      move_in_(invert(system_.transition(), belief())),
      likelihood_(system_.mode_variable()) {
  move_in_.unreachable.reserve(modes());
}

template <ScalableUncertainty Kind>
bool InteractingFilter<Kind>::measure(double dt, const Seen& seen, double limit) {
  mix(dt);                                     // step 1, (51)–(59)
  for (std::size_t j = 0; j < modes(); ++j) {  // step 2, (60), (61)
    this->predict_model(j, next().estimates.view(j), dt, predicted_.view(j));
    this->update_model(j, predicted_.view(j), seen, next().estimates.view(j), innovations_[j]);
  }
  if (!this->passes(limit)) return false;
  for (std::size_t j = 0; j < modes(); ++j) {
    check::sound(this->model(j), next().estimates.view(j));
    likelihood_.set_log(j, innovations_[j].log_likelihood);
  }
  update(prior_, likelihood_, next().belief);  // step 3, (62), (63)
  return true;                                 // (64) is `conclude`, step 4 `output`
}

template <ScalableUncertainty Kind>
void InteractingFilter<Kind>::miss(double dt) {
  mix(dt);
  for (std::size_t j = 0; j < modes(); ++j) {
    const detail::View estimate = next().estimates.view(j);
    this->predict_model(j, estimate, dt, estimate);
    check::sound(this->model(j), estimate);
  }
  next().belief = prior_;
}

/// By the short form for motions along independent axes, with a measurement of the position or none.
template <ScalableUncertainty Kind>
bool InteractingFilter<Kind>::shortened(double dt, const Seen* seen, double limit) {
  if (!this->shortcut_.takes(seen ? &seen->sensor : nullptr, seen ? seen->z.n : 0)) return false;
  if (!this->shortens(dt)) return false;
  detail::kinematic::Told told;
  for (std::size_t j = 0; j < modes(); ++j) {
    const detail::View result = next().estimates.view(j);
    told.mean[j] = result.mean;
    told.covariance[j] = result.covariance;
    told.predicted[j] = predicted_.view(j).mean;
    told.residual[j] = innovations_[j].residual_numbers.data();
    told.S[j] = innovations_[j].covariance_numbers.data();
  }
  const auto take = [&](const double* z, const double* R) {
    return this->shortcut_.step(estimates(), this->weights_.data(), this->most_likely_mode(), z, R, told);
  };
  if (!(seen ? take(seen->z.mean, seen->z.covariance) : take(nullptr, nullptr))) return false;
  const auto prior = prior_.logs(detail::ByLaw{});
  for (std::size_t j = 0; j < modes(); ++j) prior[j] = std::log(told.prior[j]);
  this->predicted_mode_ =
      detail::select(modes(), Filter::logs_of(prior_), this->most_likely_mode(), interaction_.output_tie);
  bool taken = seen != nullptr;
  if (seen) {
    for (std::size_t j = 0; j < modes(); ++j) {
      AnyInnovation& innovation = innovations_[j];
      innovation.size = seen->z.n;
      innovation.squared_distance = told.squared_distance[j];
      innovation.log_likelihood = -0.5 * told.squared_distance[j];
      if (interaction_.likelihood == LikelihoodForm::density)
        innovation.log_likelihood += 0.5 * (std::log(told.precision[j]) - seen->z.n * std::log(2.0 * std::numbers::pi));
    }
    taken = this->passes(limit);
  }
  if (seen && !taken && !take(nullptr, nullptr)) return false;
  const auto posterior = next().belief.logs(detail::ByLaw{});
  for (std::size_t j = 0; j < modes(); ++j) posterior[j] = taken ? std::log(told.posterior[j]) : prior[j];
  this->conclude(taken);
  return true;
}

/// Step 1: prior and move-in weights of the mode, (51), (52) or (53), (54), and the mixed starts.
template <ScalableUncertainty Kind>
void InteractingFilter<Kind>::mix(double dt) {
  this->predict_mode(dt);
  invert(system_.transition(), belief(), move_in_);
  const bool common = interaction_.mixed_start == MixedStart::common;
  const auto count = static_cast<int>(modes());
  detail::Parts parts(count);
  detail::OfModes move_in(count), transposed(count);
  for (std::size_t j = 0; j < modes(); ++j) {
    const detail::ConstView own = estimates().view(j);
    const detail::View mixed = next().estimates.view(j);
    if (prior_.log(j) == log_zero) {  // (52) is 0/0: nothing moves in, the filter keeps its state
      detail::copy(own, mixed);
      continue;
    }
    for (std::size_t l = 0; l < modes(); ++l) {
      move_in[l] = common ? belief()[l] : move_in_.relation(j, l);
      transposed[l] = common ? belief()[l] : move_in_.relation(l, j);
    }
    const auto lender = this->lenders(estimates()).view(j);
    detail::mix(interaction_.collapse, this->mixture(lender, this->correspondences(j), estimates(), parts), move_in,
                transposed, common ? this->most_likely_mode() : j, own, mixed);
  }
}

template class InteractingFilter<Random>;
template class InteractingFilter<Fuzzy>;

}  // namespace sigmax
