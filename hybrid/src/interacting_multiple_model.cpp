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
      likelihood_(system_.mode_variable()) {
  move_in_.unreachable.reserve(modes());
}

template <ScalableUncertainty Kind>
void InteractingFilter<Kind>::step(double dt, const Seen& seen, double gate) {
  this->require(dt, &seen);
  if (this->shortened(dt, &seen, gate, predicted_)) return;
  bool taken = false;
  this->located(dt, [&] {
    mix(dt);                                     // step 1, (51)–(59)
    for (std::size_t j = 0; j < modes(); ++j) {  // step 2, (60), (61)
      this->predict_model(j, next().estimates.view(j), dt, predicted_.view(j));
      this->update_model(j, predicted_.view(j), seen, next().estimates.view(j), innovations_[j]);
    }
    taken = this->passes(gate);
    if (!taken) return;
    for (std::size_t j = 0; j < modes(); ++j) {
      check::sound(this->model(j), next().estimates.view(j));
      likelihood_.set_log(j, innovations_[j].log_likelihood);
    }
    update(prior_, likelihood_, next().belief);  // step 3, (62), (63)
  });
  if (!taken) return step(dt);
  this->conclude(true);  // (64); step 4 is `output`
}

template <ScalableUncertainty Kind>
void InteractingFilter<Kind>::step(double dt) {
  this->require(dt, nullptr);
  if (this->shortened(dt, nullptr, no_gate, predicted_)) return;
  this->located(dt, [&] {
    mix(dt);
    for (std::size_t j = 0; j < modes(); ++j) {
      const detail::View estimate = next().estimates.view(j);
      this->predict_model(j, estimate, dt, estimate);
      check::sound(this->model(j), estimate);
    }
    next().belief = prior_;
  });
  this->conclude(false);
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
