#include "himm_demo/tune_fitter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <vector>

#include <sigmax/hybrid/fit_target.hpp>

#include "himm_demo/tune_numbers.hpp"
#include "himm_demo/tune_search.hpp"

namespace sigmax::apps {
namespace {

constexpr std::size_t rounds = 2;           // of a search and the transition's EM
constexpr std::size_t most_em_steps = 3;    // in each
constexpr double least_improvement = 1e-4;  // nats a row

constexpr std::array factors = {0.03, 0.1, 0.3, 3.0, 10.0, 30.0};  // by which a number may be off at first
constexpr std::size_t most_sweeps = 4;

/// How often a search of n numbers may ask.
std::size_t budget(std::size_t numbers) { return numbers == 0 ? 1 : 25 * (numbers + 1); }

}  // namespace

Fitter::Found Fitter::fit(const FilterSettings& settings, std::size_t start) const {
  Found best{settings, value(settings)};
  scan(best);
  for (std::size_t round = 0; round < rounds; ++round)
    if (!improve(best, round == 0 ? start : 0, 1.0)) {
      advance_((rounds - 1 - round) * budget(free_numbers(settings, data_, options_).size()));
      break;
    }
  return best;
}

Fitter::Found Fitter::refine(const FilterSettings& settings) const {
  Found best{settings, value(settings)};
  improve(best, 0, 0.3);
  return best;
}

/// The objective; infinite where the filter fails.
double Fitter::value(const FilterSettings& settings) const {
  try {
    const double found = objective_of(losses(data_, judged_settings(settings, options_.objective), options_.objective),
                                      options_.objective, counts_);
    return std::isnan(found) ? std::numeric_limits<double>::infinity() : found;
  } catch (const std::exception&) {
    return std::numeric_limits<double>::infinity();
  }
}

bool Fitter::take_if_better(Found& best, const FilterSettings& settings) const {
  const double found = value(settings);
  if (!(found < best.value)) return false;
  best = {settings, found};
  return true;
}

/// Whether there may be more to gain.
bool Fitter::improve(Found& best, std::size_t start, double step) const {
  const double before = best.value;
  search_numbers(best, start, step);
  if (has_transition(best.settings, options_)) learn_transition(best);
  if (options_.fits("lift")) try_lifts(best);
  return before - best.value > least_improvement;
}

/// One number after the other by great factors, the sensors' first: a search would be caught where measurements that
/// are thought exact are explained by a wild target, or all by great errors.
void Fitter::scan(Found& best) const {
  auto numbers = free_numbers(best.settings, data_, options_);
  std::erase_if(numbers, [](const FreeNumber& number) { return number.parameter.scale != Scale::logarithmic; });
  std::stable_partition(numbers.begin(), numbers.end(), [](const FreeNumber& number) { return number.sensor; });
  for (std::size_t sweep = 0; sweep < most_sweeps; ++sweep) {
    const double before = best.value;
    for (FreeNumber& number : numbers) {
      const FilterSettings base = best.settings;
      double taken = number.parameter.start;
      for (const double factor : factors) {
        FilterSettings tried = base;
        number.set(tried, factor * number.parameter.start);
        if (take_if_better(best, tried)) taken = factor * number.parameter.start;
      }
      if (!number.relative) number.parameter.start = taken;
      advance_(factors.size());
    }
    if (before - best.value > least_improvement) continue;
    advance_((most_sweeps - 1 - sweep) * factors.size() * numbers.size());
    return;
  }
}

void Fitter::search_numbers(Found& best, std::size_t start, double step) const {
  const auto numbers = free_numbers(best.settings, data_, options_);
  std::vector<FitParameter> parameters;
  for (const auto& number : numbers) {
    parameters.push_back(number.parameter);
    parameters.back().step = step * (number.parameter.scale == Scale::linear ? 1.0 : 0.7);
  }
  const std::size_t most = budget(numbers.size());
  std::size_t asked = 0;
  const auto loss = [&](const std::vector<double>& values) {
    if (asked++ < most) advance_(1);
    return value(with(best.settings, numbers, values));
  };
  const auto by_nlopt = [&](const auto& function, const FitSearch& from) { search(function, from, most - 1); };
  const Fit found = fit_from(parameters, loss, by_nlopt, fit_search(parameters, options_.seed, start));
  advance_(most - std::min(asked, most));
  if (found.loss < best.value) best = {with(best.settings, numbers, found.values), found.loss};
}

/// EM for the transition, as long as it helps: the filters' weights are not exact, so that it need not.
void Fitter::learn_transition(Found& best) const {
  for (std::size_t k = 0; k < most_em_steps; ++k) {
    const double before = best.value;
    FilterSettings next = best.settings;
    TransitionCounts counts(next.models.size(), next.fuzzy);
    const FilterSettings judged = judged_settings(next, options_.objective);
    try {
      for (std::size_t t = 0; t < data_.tracks.size(); ++t)
        count_transitions(
            judged_choice(data_, judged), data_.plots(data_.tracks[t], judged),
            [&](std::size_t row) { return counts_(t, row); }, counts);
    } catch (const std::exception&) {
      return;  // what cannot be smoothed is not learned from
    }
    if (next.sojourn_s.empty())
      next.transition = counts.transition(next.transition);
    else
      next.sojourn_s = counts.sojourns(next.sojourn_s);
    take_if_better(best, next);
    if (!(before - best.value > least_improvement)) return;
  }
}

/// The lift matters where one model lacks what another has.
void Fitter::try_lifts(Found& best) const {
  const auto& motions = best.settings.motions;
  const auto other = [&](const MotionChoice& motion) {
    return motion.known().derivatives != motions[0].known().derivatives || motion.linear() != motions[0].linear();
  };
  if (std::none_of(motions.begin(), motions.end(), other)) return;
  for (const Lift lift : {Lift::zero, Lift::borrowed_variance, Lift::unbiased}) {
    FilterSettings next = best.settings;
    next.lift = lift;
    if (lift != best.settings.lift) take_if_better(best, next);
  }
}

std::size_t Fitter::work_of_fit(const FilterSettings& settings, const TuneData& data, const TuneOptions& options) {
  const auto numbers = free_numbers(settings, data, options);
  const auto scanned = static_cast<std::size_t>(std::count_if(
      numbers.begin(), numbers.end(), [](const auto& each) { return each.parameter.scale == Scale::logarithmic; }));
  return most_sweeps * factors.size() * scanned + rounds * budget(numbers.size());
}

std::size_t Fitter::work_of_refine(const FilterSettings& settings, const TuneData& data, const TuneOptions& options) {
  return budget(free_numbers(settings, data, options).size());
}

}  // namespace sigmax::apps
