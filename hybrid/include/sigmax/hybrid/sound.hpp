#pragma once

#include <limits>

#include <sigmax/estimation/any_model.hpp>
#include <sigmax/hybrid/estimates.hpp>
#include <sigmax/hybrid/state_augmentation.hpp>

/// What a filter asks of its starts, and of every new estimate.
namespace sigmax::check {

/// There is a start for each model, of its size and finite. Throws std::invalid_argument, naming the model.
void starts(const std::vector<AnyModel>& models, const Estimates& starts);

/// The numbers of an entry prior are positive, and there is a scale. Throws std::invalid_argument.
void prior(const EntryPrior& prior);

/// The estimate is finite and no variance is negative beyond rounding: what a lost definiteness shows first, and costs
/// next to nothing to see. Throws std::domain_error, naming the model.
void sound(const AnyModel& model, detail::ConstView estimate);

/// All numbers of an estimate are finite, and of a size of at most `greatest`.
bool finite(detail::ConstView estimate, double greatest = std::numeric_limits<double>::max());

}  // namespace sigmax::check
