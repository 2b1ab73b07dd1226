#include <sigmax/hybrid/interacting_multiple_model.hpp>

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
      likelihood_(system_.mode_variable()),
      fast_path_(models, interaction) {
  move_in_.unreachable.reserve(modes());
}

template <ScalableUncertainty Kind>
bool InteractingFilter<Kind>::measure(double dt, const Seen& seen, double limit) {
  if (try_fast_path(dt, &seen)) return this->passes(limit);
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
  if (try_fast_path(dt, nullptr)) return;
  mix(dt);
  for (std::size_t j = 0; j < modes(); ++j) {
    const detail::View estimate = next().estimates.view(j);
    this->predict_model(j, estimate, dt, estimate);
    check::sound(this->model(j), estimate);
  }
  next().belief = prior_;
}

template <ScalableUncertainty Kind>
bool InteractingFilter<Kind>::prepare_fast_path(double dt) {
  const auto* const transition = std::get_if<Table>(&system_.transition(dt).rows());
  return transition && fast_path_.prepare(this->laws(dt), transition->data());
}

template <ScalableUncertainty Kind>
bool InteractingFilter<Kind>::try_fast_path(double dt, const Seen* seen) {
  return fast_path_.takes(seen) && prepare_fast_path(dt) &&
         fast_path_.step(this->state(), this->version(), seen ? &seen->z : nullptr, next(), prior_, predicted_,
                         innovations_);
}

template <ScalableUncertainty Kind>
void InteractingFilter<Kind>::output(const State& state, detail::View result) const {
  if (!fast_path_.output(state, &state == &this->state() ? this->version() : 0, result)) Filter::output(state, result);
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
