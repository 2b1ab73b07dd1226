#include "himm_demo/tune_fit.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <numeric>
#include <utility>

#include "himm_demo/tune_fitter.hpp"
#include "himm_demo/tune_numbers.hpp"
#include "support/parallel.hpp"

namespace sigmax::apps {
namespace {

/// The losses, or for each row that has a measurement a very great one where the filter fails.
Losses judged(const TuneData& data, const FilterSettings& settings, Objective objective) {
  try {
    return losses(data, judged_settings(settings, objective), objective);
  } catch (const std::exception&) {
    constexpr double of_failure = 1e6;
    Losses result;
    for (const TuneTrack& track : data.tracks)
      for (auto& of_track = result.emplace_back(); const Fix& fix : track.rows)
        of_track.push_back(fix.measured() ? of_failure : std::numeric_limits<double>::quiet_NaN());
    return result;
  }
}

std::string name_of_models(const FilterSettings& settings) {
  std::string name;
  for (const auto& motion : settings.motions) name += (name.empty() ? "" : "+") + motion.name;
  return name;
}

}  // namespace

std::vector<std::string> model_sets(const FilterSettings& settings, const TuneOptions& options) {
  if (!options.models.empty()) return options.models;
  std::vector<std::string> sets = {name_of_models(settings)};
  for (const auto& motion : settings.motions)
    if (std::find(sets.begin(), sets.end(), motion.name) == sets.end()) sets.push_back(motion.name);
  return sets;
}

std::size_t work_of(const FilterSettings& settings, const TuneData& data, const TuneOptions& options) {
  std::size_t work = 0;
  for (const auto& models : model_sets(settings, options)) {
    const FilterSettings base = with_models(settings, models);
    work += options.starts * Fitter::work_of_fit(base, data, options) +
            options.folds * Fitter::work_of_refine(base, data, options);
  }
  return work;
}

BlockMean block_mean_difference(const Losses& a, const Losses& b) {
  constexpr std::size_t most_blocks = 20;
  std::vector<double> differences;
  for (std::size_t t = 0; t < a.size(); ++t)
    for (std::size_t k = 0; k < a[t].size(); ++k)
      if (!std::isnan(a[t][k]) && !std::isnan(b[t][k])) differences.push_back(a[t][k] - b[t][k]);
  const std::size_t rows = differences.size(), blocks = std::min(most_blocks, rows);
  BlockMean result;
  if (rows == 0) return result;
  result.mean = std::accumulate(differences.begin(), differences.end(), 0.0) / static_cast<double>(rows);
  double squares = 0.0;
  for (std::size_t block = 0; block < blocks; ++block) {
    const std::size_t from = block * rows / blocks, to = (block + 1) * rows / blocks;
    double sum = 0.0;
    for (std::size_t k = from; k < to; ++k) sum += differences[k] - result.mean;
    squares += std::pow(sum, 2);
  }
  if (blocks > 1)
    result.error =
        std::sqrt(squares * static_cast<double>(blocks) / static_cast<double>(blocks - 1)) / static_cast<double>(rows);
  return result;
}

TunedFilter tune(const FilterSettings& settings, const TuneData& data, const TuneOptions& options,
                 const std::function<void(std::size_t work)>& advance) {
  const auto folds = data.folds(options.folds);
  TunedFilter tuned;
  tuned.candidates.push_back({"as before", settings});
  for (const auto& models : model_sets(settings, options)) {
    const FilterSettings base = with_models(settings, models);
    tuned.candidates.push_back({models, base, count_of(free_numbers(base, data, options), base, options)});
  }

  const auto all = [](std::size_t, std::size_t) { return true; };
  const std::size_t sets = tuned.candidates.size() - 1;
  std::vector<double> least(sets, std::numeric_limits<double>::infinity());
  const auto from_far = [&](std::size_t i) {
    return Fitter(data, options, all, advance).fit(tuned.candidates[1 + i % sets].settings, i / sets);
  };
  std::vector<FilterSettings> fitted(sets);
  for_each_run(sets * options.starts, options.threads, from_far, [&](std::size_t i, Fitter::Found&& found) {
    if (i >= sets && !(found.value < least[i % sets])) return;
    least[i % sets] = found.value;
    fitted[i % sets] = std::move(found.settings);
  });
  std::vector<Losses> of_folds(sets * options.folds);
  const auto without_fold = [&](std::size_t i) {
    const auto counts = [&](std::size_t t, std::size_t k) { return folds[t][k] != i / sets; };
    FilterSettings found = Fitter(data, options, counts, advance).refine(fitted[i % sets]).settings;
    round_off(found);
    return judged(data, found, options.objective);
  };
  for_each_run(of_folds.size(), options.threads, without_fold,
               [&](std::size_t i, Losses&& found) { of_folds[i] = std::move(found); });

  for (std::size_t c = 0; c < tuned.candidates.size(); ++c) {
    Candidate& candidate = tuned.candidates[c];
    if (c > 0) {
      candidate.settings = fitted[c - 1];
      round_off(candidate.settings);
    }
    candidate.losses = judged(data, candidate.settings, options.objective);
    candidate.fitted = objective_of(candidate.losses, options.objective, all);
    for (std::size_t t = 0; c > 0 && t < folds.size(); ++t)
      for (std::size_t k = 0; k < folds[t].size(); ++k)
        candidate.losses[t][k] = of_folds[folds[t][k] * sets + c - 1][t][k];
    candidate.held_out = objective_of(candidate.losses, options.objective, all);
    const BlockMean gain = block_mean_difference(tuned.candidates[0].losses, candidate.losses);
    candidate.gain = gain.mean;
    candidate.gain_error = gain.error;
    if (candidate.held_out < tuned.candidates[tuned.best].held_out) tuned.best = c;
  }
  tuned.simple = tuned.best;
  for (std::size_t c = 0; c < tuned.candidates.size(); ++c) {
    const BlockMean worse = block_mean_difference(tuned.candidates[c].losses, tuned.candidates[tuned.best].losses);
    if (tuned.candidates[c].numbers < tuned.candidates[tuned.simple].numbers && worse.mean <= worse.error)
      tuned.simple = c;
  }
  return tuned;
}

}  // namespace sigmax::apps
