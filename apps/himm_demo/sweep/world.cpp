#include "himm_demo/sweep/world.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "support/missing.hpp"
#include "support/output.hpp"
#include "version.hpp"

namespace sigmax::apps {

/// What may be tried of one setting: a list of numbers in ascending order, continued at both ends, or things without an
/// order.
struct Axis {
  std::vector<double> numbers;
  std::size_t first = 0, last = numbers.size() - 1;  ///< of the list itself
  bool more_below = false, more_above = false;       ///< whether such numbers were left out
  bool ordered = true;
};

namespace {

/// The list, beyond each end by the ratio of the last two numbers, as many steps, in six digits, so that what a table
/// says can be given again. One number is fixed and has no continuation.
Axis continued(const std::vector<double>& list, double least, double greatest, int steps) {
  Axis axis{.numbers = list};
  if (list.size() == 1) return axis;
  auto& numbers = axis.numbers;
  const auto in_six_digits = [](double value) { return std::stod(fmt::format("{:.6g}", value)); };
  const double down = list[0] / list[1], up = list.back() / list[list.size() - 2];
  for (int i = 0; i < steps && numbers.back() < greatest; ++i)
    numbers.push_back(std::min(in_six_digits(numbers.back() * up), greatest));
  for (int i = 0; i < steps && numbers.front() > least; ++i, ++axis.first, ++axis.last)
    numbers.insert(numbers.begin(), std::max(in_six_digits(numbers.front() * down), least));
  axis.more_below = numbers.front() > least;
  axis.more_above = numbers.back() < greatest;
  return axis;
}

/// Every combination of the lists. The last axis changes fastest.
std::vector<Place> grid(const std::vector<Axis>& lattice) {
  std::vector<Place> all = {Place{}};
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    std::vector<Place> more;
    for (Place place : all)
      for (place[i] = lattice[i].first; place[i] <= lattice[i].last; ++place[i]) more.push_back(place);
    all = std::move(more);
  }
  return all;
}

/// The places one step along one axis.
std::vector<Place> neighbours(const std::vector<Axis>& lattice, const Place& place) {
  std::vector<Place> all;
  for (std::size_t i = 0; i < lattice.size(); ++i)
    for (std::size_t at = 0; at < lattice[i].numbers.size(); ++at)
      if (lattice[i].ordered ? at + 1 == place[i] || at == place[i] + 1 : at != place[i]) {
        all.push_back(place);
        all.back()[i] = at;
      }
  return all;
}

/// Whether a number is the last one before those left out, so that better ones may be beyond.
bool at_the_limit(const std::vector<Axis>& lattice, const Place& place) {
  for (std::size_t i = 0; i < lattice.size(); ++i)
    if ((place[i] == 0 && lattice[i].more_below) ||
        (place[i] + 1 == lattice[i].numbers.size() && lattice[i].more_above))
      return true;
  return false;
}

constexpr std::size_t of_a_place = std::tuple_size_v<Place>;
constexpr double infinity = std::numeric_limits<double>::infinity();
using Squares = std::array<double, squares>;

constexpr std::array swept_lifts = {Lift::zero, Lift::unbiased, Lift::borrowed_variance};

void add_run(const Scenario& scenario, const FilterSettings& filter, const Recording& recording, Squares& sums) {
  std::vector<std::array<double, 3>> error(recording.truth.size(), {nan, nan, nan});
  follow(filter, scenario.step_s, recording, [&](const TargetPoint& point) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      error[point.tag][axis] = point.mean[axis] - recording.truth[point.tag](static_cast<Eigen::Index>(axis));
  });
  add_squares(scenario, error, sums.data());
}

void add_measurement(const Scenario& scenario, const Recording& recording, Squares& sums) {
  std::vector<std::array<double, 3>> error;
  for (std::size_t k = 0; k < recording.truth.size(); ++k) {
    const Vector<3> seen = to_cartesian(recording.measured[k]) - recording.truth[k].head<3>();
    error.push_back({seen.x(), seen.y(), seen.z()});
  }
  add_squares(scenario, error, sums.data());
}

double score(const Squares& filter, const Squares& measurement) {
  double sum = 0.0;
  for (std::size_t i = 0; i < squares; ++i) sum += std::sqrt(filter[i] / measurement[i]);
  return std::isfinite(sum) ? sum / squares : infinity;
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

/// The scenario of the paper with another sampling period, and a manoeuvre of another strength and length.
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

}  // namespace

const char* name_of(Lift lift) {
  return lift == Lift::zero ? "zero" : lift == Lift::unbiased ? "unbiased" : "borrowed_variance";
}

SweepWorld::SweepWorld(const SweepChoice& choice) : choice_(choice), conditions_(conditions_of(choice)) {
  for (auto* const list : {&choice_.probability, &choice_.possibility, &choice_.sigma_w}) {
    std::sort(list->begin(), list->end());
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
  const std::vector<std::string> sets = {fmt::format("filters=[{}]", fmt::join(choice.filters, ","))};
  filters_ = read_filters(Settings::read({}, sets), FilterDefaults::of(Preset::paper_text, group(1, 1)));
}

std::vector<Axis> SweepWorld::lattice(std::size_t f) const {
  const bool fuzzy = filters_[f].fuzzy;
  const Axis off_diagonal =
      continued(fuzzy ? choice_.possibility : choice_.probability, 1e-12, fuzzy ? 1.0 : 0.9, choice_.beyond);
  const Axis sigma_w = continued(choice_.sigma_w, 1e-6, 1e6, choice_.beyond);
  Axis lift{.numbers = std::vector<double>(choice_.lifts.size())};
  lift.ordered = false;
  return {off_diagonal, off_diagonal, sigma_w, sigma_w, lift};
}

std::size_t SweepWorld::listed_settings(std::size_t f) const { return grid(lattice(f)).size(); }

FilterSettings SweepWorld::settings(std::size_t condition, std::size_t f, const Place& place) const {
  const std::vector<Axis> lattice = this->lattice(f);
  const auto number = [&](std::size_t axis) { return lattice[axis].numbers[place[axis]]; };
  const double leaving = number(0), returning = number(1);
  const double mismatch = conditions_[condition].mismatch;
  const Polar sigma = group(1, conditions_[condition].scenario).data;
  FilterSettings own = filters_[f];
  own.accuracy.radar = {mismatch * sigma.range, mismatch * sigma.azimuth, mismatch * sigma.elevation};
  own.transition = {{own.fuzzy ? 1.0 : 1.0 - leaving, leaving}, {returning, own.fuzzy ? 1.0 : 1.0 - returning}};
  for (const std::size_t model : {0U, 1U}) own.motions[model][MotionParameter::sigma_w] = number(2 + model);
  own.lift = *std::find_if(swept_lifts.begin(), swept_lifts.end(),
                           [&](Lift lift) { return name_of(lift) == choice_.lifts[place.back()]; });
  return own;
}

Recording SweepWorld::recording(std::size_t condition, int number) const {
  RandomStream random(choice_.seed, static_cast<std::uint64_t>(number));
  return simulate(scenario_of(conditions_[condition]), group(1, conditions_[condition].scenario).data, random);
}

std::vector<double> SweepWorld::scores_of(std::size_t condition, std::size_t f,
                                          const std::vector<Place>& places) const {
  const Scenario scenario = scenario_of(conditions_[condition]);
  std::vector<FilterSettings> tried;
  for (const Place& place : places) tried.push_back(settings(condition, f, place));
  Squares measured{};
  std::vector<Squares> sums(places.size(), Squares{});
  for (int run = 0; run < choice_.tuning_runs; ++run) {
    const Recording one = recording(condition, run);
    add_measurement(scenario, one, measured);
    for (std::size_t i = 0; i < places.size(); ++i) try {
        add_run(scenario, tried[i], one, sums[i]);
      } catch (const std::exception&) {
        sums[i].fill(infinity);  // a filter that fails with bad settings has no good score
      }
  }
  std::vector<double> scores;
  for (const Squares& own : sums) scores.push_back(score(own, measured));
  return scores;
}

/// The best place with its score and how many were tried; then of each batch of runs their number, and the squares of
/// the measurement and of the filter.
Study::Row SweepWorld::work(std::size_t condition, std::size_t f) const {
  constexpr int most_batches = 25;
  const Scenario scenario = scenario_of(conditions_[condition]);
  // The best of the grid, then from neighbour to better neighbour until none is better; the first of equals is taken.
  Place best{};
  double best_score = infinity;
  std::set<Place> tried;
  for (auto places = grid(lattice(f)); !places.empty();) {
    const auto scores = scores_of(condition, f, places);
    const auto least = std::min_element(scores.begin(), scores.end());
    const bool first = tried.empty();
    tried.insert(places.begin(), places.end());
    if (!first && *least >= best_score) break;
    best = places[static_cast<std::size_t>(least - scores.begin())];
    best_score = *least;
    places = neighbours(lattice(f), best);
    std::erase_if(places, [&](const Place& one) { return tried.contains(one); });
  }
  const FilterSettings tuned = settings(condition, f, best);
  Study::Row row(best.begin(), best.end());
  row.insert(row.end(), {best_score, static_cast<double>(tried.size())});
  const int batches = std::min(most_batches, choice_.runs);
  for (int batch = 0; batch < batches; ++batch) {
    Squares own{}, raw{};
    const auto bound = [&](int at) { return static_cast<int>(static_cast<long>(choice_.runs) * at / batches); };
    for (int number = bound(batch); number < bound(batch + 1); ++number) {
      const Recording one = recording(condition, choice_.tuning_runs + number);
      add_measurement(scenario, one, raw);
      add_run(scenario, tuned, one, own);
    }
    row.push_back(bound(batch + 1) - bound(batch));
    row.insert(row.end(), raw.begin(), raw.end());
    row.insert(row.end(), own.begin(), own.end());
  }
  return row;
}

Study SweepWorld::study() const {
  return {"cells", conditions_.size() * filters_.size(),
          [this](std::size_t cell) { return work(cell / filters_.size(), cell % filters_.size()); },
          command_of(choice_)};
}

void SweepWorld::add(const Study::Row& row) {
  Place place{};
  for (std::size_t i = 0; i < of_a_place; ++i) place[i] = static_cast<std::size_t>(row[i]);
  constexpr std::size_t of_a_batch = 1 + 2 * squares;
  Batches batches(of_a_batch);
  for (auto rest = std::span(row).subspan(of_a_place + 2); !rest.empty(); rest = rest.subspan(of_a_batch))
    batches.add(rest.first(of_a_batch));
  const auto ratio = [&](std::size_t i) { return sqrt(batches.mean(1 + squares + i)) / sqrt(batches.mean(1 + i)); };
  Statistic sum = ratio(0);
  for (std::size_t i = 1; i < squares; ++i) sum = sum + ratio(i);
  tuned_.push_back({place, at_the_limit(lattice(tuned_.size() % filters_.size()), place), row[of_a_place],
                    static_cast<std::size_t>(row[of_a_place + 1]), sum * (1.0 / squares)});
}

std::optional<std::size_t> SweepWorld::imm() const {
  for (std::size_t f = filters_.size(); f-- > 0;)
    if (filters_[f].name == "imm") return f;
  return std::nullopt;
}

std::optional<std::size_t> SweepWorld::himm(std::size_t condition) const {
  std::optional<std::size_t> best;
  for (std::size_t f = 0; f < filters_.size(); ++f)
    if (filters_[f].fuzzy && filters_[f].scheme == Scheme::interacting &&
        (!best || tuned(condition, f).tuning_score < tuned(condition, *best).tuning_score))
      best = f;
  return best;
}

Interval SweepWorld::against_imm(std::size_t condition, std::size_t f) const {
  return (tuned(condition, f).score / tuned(condition, *imm()).score - 1.0).interval(conditions_.size());
}

}  // namespace sigmax::apps
