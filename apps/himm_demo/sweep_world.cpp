#include "himm_demo/sweep_world.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "himm_demo/trace.hpp"
#include "support/output.hpp"
#include "version.hpp"

namespace sigmax::apps {
namespace {

constexpr std::size_t most_sweep_batches = 25;
constexpr std::size_t components = 9;  // by phase and axis
constexpr std::size_t of_a_place = SweepLattice::axes + 1;
using Squares = std::array<double, components>;

Lift lift_of(const std::string& name) {
  return name == "zero" ? Lift::zero : name == "unbiased" ? Lift::unbiased : Lift::borrowed_variance;
}

/// Adds the mean squares by phase and axis.
void add_squares(const Scenario& scenario, const std::vector<Vector<3>>& error, Squares& sums) {
  for (std::size_t i = 0; i < components; ++i) {
    const auto axis = static_cast<Eigen::Index>(i % 3);
    sums[i] += phase_mean(scenario.phases[i / 3], [&](std::size_t k) { return std::pow(error[k](axis), 2); });
  }
}

void add_run(const Scenario& scenario, const FilterSettings& filter, const Recording& recording, Squares& sums) {
  std::vector<Vector<3>> error(recording.truth.size(), Vector<3>::Constant(std::numeric_limits<double>::quiet_NaN()));
  follow(filter, scenario.step_s, recording, [&](const TargetPoint& point) {
    error[point.tag] = Eigen::Map<const Vector<3>>(point.mean.data()) - recording.truth[point.tag].head<3>();
  });
  add_squares(scenario, error, sums);
}

/// The same where the settings may be bad ones: a filter that fails with them has no good score.
void try_run(const Scenario& scenario, const FilterSettings& filter, const Recording& recording, Squares& sums) {
  try {
    add_run(scenario, filter, recording, sums);
  } catch (const std::exception&) {
    sums.fill(std::numeric_limits<double>::infinity());
  }
}

void add_measurement(const Scenario& scenario, const Recording& recording, Squares& sums) {
  std::vector<Vector<3>> error;
  for (std::size_t k = 0; k < recording.truth.size(); ++k)
    error.push_back(to_cartesian(recording.measured[k]) - recording.truth[k].head<3>());
  add_squares(scenario, error, sums);
}

double score(const Squares& filter, const Squares& measurement) {
  double sum = 0.0;
  for (std::size_t i = 0; i < components; ++i) sum += std::sqrt(filter[i] / measurement[i]);
  return std::isfinite(sum) ? sum / components : std::numeric_limits<double>::infinity();
}

std::vector<SweepCondition> conditions_of(const SweepChoice& choice) {
  std::vector<SweepCondition> all;
  const auto add = [&](const SweepCondition& condition) {
    if (std::find(all.begin(), all.end(), condition) == all.end()) all.push_back(condition);
  };
  for (const int scenario : choice.scenarios) {
    if (choice.cross) {
      for (const double mismatch : choice.mismatch)
        for (const double period : choice.period)
          for (const double strength : choice.strength)
            for (const double length : choice.length) add({scenario, mismatch, period, strength, length});
      continue;
    }
    add({scenario});
    for (const double mismatch : choice.mismatch) add({.scenario = scenario, .mismatch = mismatch});
    for (const double period : choice.period) add({.scenario = scenario, .period = period});
    for (const double strength : choice.strength) add({.scenario = scenario, .strength = strength});
    for (const double length : choice.length) add({.scenario = scenario, .length = length});
  }
  return all;
}

std::string list(const std::vector<double>& numbers) {
  std::vector<std::string> texts;
  for (const double number : numbers) texts.push_back(shortest(number));
  return fmt::format("{}", fmt::join(texts, ","));
}

void put_in_order(std::vector<double>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// The command that does the same again.
std::string command_of(const SweepChoice& choice) {
  return fmt::format(
      "himm_demo {} sweep --scenario {} --mismatch {} --period {} --strength {} --length {}{} --filters {} "
      "--probability {} --possibility {} --sigma-w {} --lift {} --beyond {} --tuning-runs {} --runs {} --seed {}",
      version, fmt::join(choice.scenarios, ","), list(choice.mismatch), list(choice.period), list(choice.strength),
      list(choice.length), choice.cross ? " --cross" : "", fmt::join(choice.filters, ","), list(choice.probability),
      list(choice.possibility), list(choice.sigma_w), fmt::join(choice.lifts, ","), choice.beyond, choice.tuning_runs,
      choice.runs, choice.seed);
}

}  // namespace

Scenario scenario_of(const SweepCondition& condition) {
  Scenario result = scenario(condition.scenario, Preset::paper_text);
  const auto scaled = [&](int samples, double factor) {
    return std::max(1, static_cast<int>(std::lround(samples * factor / condition.period)));
  };
  const auto& own = result.phases;
  const int before = std::max(own[0].first + 1, scaled(own[0].last, 1.0));
  const int during = scaled(own[1].last - own[1].first + 1, condition.length);
  const int after = scaled(own[2].last - own[2].first + 1, 1.0);
  result.step_s *= condition.period;
  result.acceleration *= condition.strength;
  result.samples = before + during + after;
  result.first_accelerated = before + 1;
  result.last_accelerated = before + during;
  result.phases = {{{"before", own[0].first, before},
                    {"during", before + 1, before + during},
                    {"after", before + during + 1, before + during + after}}};
  return result;
}

SweepWorld::SweepWorld(const SweepChoice& choice) : choice_(choice), conditions_(conditions_of(choice)) {
  for (auto* const list : {&choice_.probability, &choice_.possibility, &choice_.sigma_w}) put_in_order(*list);
  const std::vector<std::string> sets = {fmt::format("filters=[{}]", fmt::join(choice.filters, ","))};
  filters_ = read_filters(Settings::read({}, sets), FilterDefaults::of(Preset::paper_text, group(1, 1)));
}

SweepLattice SweepWorld::lattice(std::size_t filter) const {
  const AxisRange off_diagonal =
      filters_[filter].fuzzy ? AxisRange{choice_.possibility, 1e-12, 1.0} : AxisRange{choice_.probability, 1e-12, 0.9};
  const AxisRange sigma_w{choice_.sigma_w, 1e-6, 1e6};
  return {{off_diagonal, off_diagonal, sigma_w, sigma_w}, choice_.lifts.size(), choice_.beyond};
}

FilterSettings SweepWorld::settings(std::size_t filter, std::size_t condition, const SweepLattice::Place& place) const {
  const SweepLattice lattice = this->lattice(filter);
  const double leaving = lattice.number(0, place), returning = lattice.number(1, place);
  const double mismatch = conditions_[condition].mismatch;
  const Polar sigma = group(1, conditions_[condition].scenario).data;
  FilterSettings own = filters_[filter];
  own.accuracy.radar = {mismatch * sigma.range, mismatch * sigma.azimuth, mismatch * sigma.elevation};
  own.transition = {{own.fuzzy ? 1.0 : 1.0 - leaving, leaving}, {returning, own.fuzzy ? 1.0 : 1.0 - returning}};
  for (const std::size_t model : {0U, 1U})
    own.motions[model][MotionParameter::sigma_w] = lattice.number(2 + model, place);
  own.lift = lift_of(choice_.lifts[place[SweepLattice::axes]]);
  return own;
}

Recording SweepWorld::recording(std::size_t condition, std::uint64_t number) const {
  RandomStream random(choice_.seed, number);
  return simulate(scenario_of(conditions_[condition]), group(1, conditions_[condition].scenario).data, random);
}

BestPlace SweepWorld::tune(std::size_t filter, std::size_t condition) const {
  const Scenario scenario = scenario_of(conditions_[condition]);
  return search(lattice(filter), [&](const std::vector<SweepLattice::Place>& places) {
    std::vector<FilterSettings> settings;
    for (const auto& place : places) settings.push_back(this->settings(filter, condition, place));
    Squares measured{};
    std::vector<Squares> squares(places.size(), Squares{});
    for (int run = 0; run < choice_.tuning_runs; ++run) {
      const Recording one = recording(condition, static_cast<std::uint64_t>(run));
      add_measurement(scenario, one, measured);
      for (std::size_t i = 0; i < places.size(); ++i) try_run(scenario, settings[i], one, squares[i]);
    }
    std::vector<double> scores;
    for (const auto& own : squares) scores.push_back(score(own, measured));
    return scores;
  });
}

std::vector<double> SweepWorld::work(std::size_t cell) const {
  const std::size_t condition = cell / filters_.size(), filter = cell % filters_.size();
  const Scenario scenario = scenario_of(conditions_[condition]);
  const BestPlace best = tune(filter, condition);
  const FilterSettings tuned = settings(filter, condition, best.place);

  std::vector<double> row(best.place.begin(), best.place.end());
  row.insert(row.end(), {best.score, static_cast<double>(best.tried)});
  const auto runs = static_cast<std::uint64_t>(choice_.runs);
  const std::uint64_t batches = std::min<std::uint64_t>(most_sweep_batches, runs);
  for (std::uint64_t batch = 0; batch < batches; ++batch) {
    Squares own{}, raw{};
    const std::uint64_t first = runs * batch / batches, last = runs * (batch + 1) / batches;
    for (std::uint64_t number = first; number < last; ++number) {
      const Recording one = recording(condition, static_cast<std::uint64_t>(choice_.tuning_runs) + number);
      add_measurement(scenario, one, raw);
      add_run(scenario, tuned, one, own);
    }
    row.push_back(static_cast<double>(last - first));
    row.insert(row.end(), raw.begin(), raw.end());
    row.insert(row.end(), own.begin(), own.end());
  }
  return row;
}

Campaign SweepWorld::campaign() const {
  return {"cells", command_of(choice_), conditions_.size() * filters_.size(),
          [this](std::size_t cell) { return work(cell); }};
}

Tuned SweepWorld::tuned(const CellRows& rows, std::size_t condition, std::size_t filter) const {
  const auto& row = rows.at(condition * filters_.size() + filter);
  BestPlace best{};
  std::transform(row.begin(), row.begin() + of_a_place, best.place.begin(),
                 [](double at) { return static_cast<std::size_t>(at); });
  best.score = row[of_a_place];
  best.tried = static_cast<std::size_t>(row[of_a_place + 1]);

  constexpr std::size_t of_a_batch = 1 + 2 * components;
  const auto column = [&](std::size_t place) {
    std::vector<double> values;
    for (std::size_t at = of_a_place + 2 + place; at < row.size(); at += of_a_batch) values.push_back(row[at]);
    return values;
  };
  const auto runs = column(0);
  const auto rmse = [&](std::size_t place) { return sqrt(Statistic::mean(column(place), runs)); };
  Statistic sum = rmse(1 + components) / rmse(1);
  for (std::size_t i = 1; i < components; ++i) sum = sum + rmse(1 + components + i) / rmse(1 + i);
  return {best, sum * (1.0 / components)};
}

}  // namespace sigmax::apps
