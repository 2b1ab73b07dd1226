#include "himm_demo/subcommands.hpp"

#include "himm_demo/experiment/experiment.hpp"
#include "report/result.hpp"
#include "study/statistic.hpp"
#include "study/study.hpp"
#include "version.hpp"

namespace sigmax::apps {
namespace {

/// What decides every figure of `himm_demo sweep`.
struct SweepChoice {
  std::vector<int> scenarios = {1, 2};
  std::vector<double> mismatch = {0.5, 1.0, 2.0};  ///< of the radar's noise: believed over true
  std::vector<double> period = {0.5, 1.0, 2.0};    ///< of sampling, times the paper's
  std::vector<double> strength = {0.25, 0.5, 1.0, 2.0};
  std::vector<double> length = {0.5, 1.0, 2.0};
  bool cross = false;  ///< every combination of these rather than each alone, the others being 1
  std::vector<std::string> filters = {"imm",           "himm_selected", "himm_own", "himm_own_recentred",
                                      "himm_released", "gpb2",          "viterbi"};
  std::vector<double> probability = {0.02, 0.05, 0.15};  ///< the off-diagonals of P, each row apart
  std::vector<double> possibility = {0.05, 0.2, 0.5};    ///< the same of Π
  std::vector<double> sigma_w = {1.0, 3.0, 9.0};         ///< of each model apart
  std::vector<std::string> lifts = {"zero", "borrowed_variance", "unbiased"};
  int beyond = 6;  ///< steps by which the search may leave a list of numbers, at each end
  int tuning_runs = 20;
  int runs = 100;
  std::uint64_t seed = 1;
};

/// One situation in which filters are compared, as multiples of the paper's.
struct SweepCondition {
  int scenario;
  double mismatch = 1.0, period = 1.0, strength = 1.0, length = 1.0;

  bool operator==(const SweepCondition&) const = default;
};

/// Where settings of a filter are on its lattice: of four numbers, and of the lift.
using Place = std::array<std::size_t, 5>;

/// What may be tried of one setting: a list of numbers in ascending order, continued at both ends, or things without an
/// order.
struct Axis {
  std::vector<double> numbers;
  std::size_t first = 0, last = numbers.size() - 1;  ///< of the list itself
  bool more_below = false, more_above = false;       ///< whether such numbers were left out
  bool ordered = true;
};

/// The settings of a filter that did best on the tuning runs, and what they did on others.
struct Tuned {
  Place place;
  bool at_the_limit;    ///< whether the search for them ended where it was not allowed to go on
  double tuning_score;  ///< the mean over axes and phases of RMSE over that of the measurement
  std::size_t tried;    ///< how many settings were
  Statistic score;      ///< the same as the tuning score, of other runs
};

/// The names in settings of the first lifts, in their order.
constexpr std::array lift_names = {"zero", "borrowed_variance", "unbiased"};
const char* name_of(Lift lift) { return lift_names.at(static_cast<std::size_t>(lift)); }

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
using Squares = std::array<double, squares>;

void add_run(const Scenario& scenario, const FilterSettings& filter, const Recording& recording, Squares& sums) {
  Errors error(recording.truth.size(), Vector<3>::Constant(nan));
  follow(filter, scenario.step_s, recording, [&](const TargetPoint& point) {
    error[point.tag] = Vector<3>(point.mean.data()) - recording.truth[point.tag].head<3>();
  });
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
    if (std::ranges::find(all, condition) == all.end()) all.push_back(condition);
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
  return fmt::format("{}", fmt::join(each(numbers, shortest), ","));
}

/// The command that does the same again.
std::string command_of(const SweepChoice& choice) {
  return fmt::format(
      "himm_demo {} sweep --scenario {} --mismatch {} --period {} --strength {} --length {} --filters {} --probability "
      "{} --possibility {} --sigma-w {} --lift {} --beyond {} --tuning-runs {} --runs {} --seed {}{}",
      version, fmt::join(choice.scenarios, ","), list(choice.mismatch), list(choice.period), list(choice.strength),
      list(choice.length), fmt::join(choice.filters, ","), list(choice.probability), list(choice.possibility),
      list(choice.sigma_w), fmt::join(choice.lifts, ","), choice.beyond, choice.tuning_runs, choice.runs, choice.seed,
      choice.cross ? " --cross" : "");
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
  result.last_accelerated = before + during;
  result.phases = {
      {{own[0].first, before}, {before + 1, before + during}, {before + during + 1, before + during + after}}};
  return result;
}

/// All conditions and filters, and what was found of them.
class SweepWorld {
 public:
  SweepChoice choice;
  std::vector<SweepCondition> conditions = conditions_of(choice);
  std::vector<FilterSettings> filters;
  std::vector<Tuned> all_tuned;  ///< by condition and filter

  /// Throws InputError for a filter that there is not.
  explicit SweepWorld(SweepChoice what) : choice(std::move(what)) {
    for (auto* const list : {&choice.probability, &choice.possibility, &choice.sigma_w}) {
      std::sort(list->begin(), list->end());
      list->erase(std::unique(list->begin(), list->end()), list->end());
    }
    const std::vector<std::string> sets = {fmt::format("filters=[{}]", fmt::join(choice.filters, ","))};
    filters = read_filters(Settings::read({}, sets), FilterDefaults::of(Preset::paper_text, group(1, 1)));
  }

  /// Tunes each filter in each condition and judges it on other runs. A cell is condition · filters + filter.
  Study study() const {
    return {"cells", conditions.size() * filters.size(),
            [this](std::size_t cell) { return work(cell / filters.size(), cell % filters.size()); },
            command_of(choice)};
  }
  /// Of the next cell.
  void add(const Study::Row& row) {
    Place place{};
    for (std::size_t i = 0; i < of_a_place; ++i) place[i] = static_cast<std::size_t>(row[i]);
    constexpr std::size_t of_a_batch = 1 + 2 * squares;
    Batches batches(of_a_batch);
    for (auto rest = std::span(row).subspan(of_a_place + 2); !rest.empty(); rest = rest.subspan(of_a_batch))
      batches.add(rest.first(of_a_batch));
    const auto ratio = [&](std::size_t i) { return sqrt(batches.mean(1 + squares + i)) / sqrt(batches.mean(1 + i)); };
    Statistic sum = ratio(0);
    for (std::size_t i = 1; i < squares; ++i) sum = sum + ratio(i);
    all_tuned.push_back({place, at_the_limit(lattice(all_tuned.size() % filters.size()), place), row[of_a_place],
                         static_cast<std::size_t>(row[of_a_place + 1]), sum * (1.0 / squares)});
  }

  const Tuned& tuned(std::size_t condition, std::size_t f) const { return all_tuned[condition * filters.size() + f]; }

  /// How many settings are on the lists of a filter.
  std::size_t listed_settings(std::size_t f) const { return grid(lattice(f)).size(); }

  /// The settings that were chosen.
  FilterSettings settings(std::size_t condition, std::size_t f) const {
    return settings(condition, f, tuned(condition, f).place);
  }

  /// The place of the IMM among the filters, and of the fuzzy interacting filter whose score on the tuning runs is the
  /// least: what is called HIMM.
  std::optional<std::size_t> imm() const {
    const auto found = std::ranges::find(filters, "imm", &FilterSettings::name);
    return found == filters.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - filters.begin()));
  }
  std::optional<std::size_t> himm(std::size_t condition) const {
    std::optional<std::size_t> best;
    for (std::size_t f = 0; f < filters.size(); ++f)
      if (filters[f].fuzzy && filters[f].scheme == Scheme::interacting &&
          (!best || tuned(condition, f).tuning_score < tuned(condition, *best).tuning_score))
        best = f;
    return best;
  }

  /// By how much the score is above that of the tuned IMM, relatively; one of as many intervals as there are
  /// conditions.
  Interval against_imm(std::size_t condition, std::size_t f) const {
    return (tuned(condition, f).score / tuned(condition, *imm()).score - 1.0).interval(conditions.size());
  }

 private:
  std::vector<Axis> lattice(std::size_t f) const {
    const bool fuzzy = filters[f].fuzzy;
    const Axis off_diagonal =
        continued(fuzzy ? choice.possibility : choice.probability, 1e-12, fuzzy ? 1.0 : 0.9, choice.beyond);
    const Axis sigma_w = continued(choice.sigma_w, 1e-6, 1e6, choice.beyond);
    const Axis lift{.numbers = std::vector<double>(choice.lifts.size()), .ordered = false};
    return {off_diagonal, off_diagonal, sigma_w, sigma_w, lift};
  }
  FilterSettings settings(std::size_t condition, std::size_t f, const Place& place) const {
    const std::vector<Axis> lattice = this->lattice(f);
    const auto number = [&](std::size_t axis) { return lattice[axis].numbers[place[axis]]; };
    const double leaving = number(0), returning = number(1);
    const double mismatch = conditions[condition].mismatch;
    const Polar sigma = group(1, conditions[condition].scenario).data;
    FilterSettings own = filters[f];
    own.accuracy.radar = {mismatch * sigma.range, mismatch * sigma.azimuth, mismatch * sigma.elevation};
    own.transition = {{own.fuzzy ? 1.0 : 1.0 - leaving, leaving}, {returning, own.fuzzy ? 1.0 : 1.0 - returning}};
    for (const std::size_t model : {0U, 1U}) own.motions[model][MotionParameter::sigma_w] = number(2 + model);
    own.lift = static_cast<Lift>(std::ranges::find(lift_names, choice.lifts[place.back()]) - lift_names.begin());
    return own;
  }
  Recording recording(std::size_t condition, int number) const {
    RandomStream random(choice.seed, static_cast<std::uint64_t>(number));
    return simulate(scenario_of(conditions[condition]), group(1, conditions[condition].scenario).data, random);
  }
  std::vector<double> scores_of(std::size_t condition, std::size_t f, const std::vector<Place>& places) const {
    const Scenario scenario = scenario_of(conditions[condition]);
    const auto tried = each(places, [&](const Place& place) { return settings(condition, f, place); });
    Squares measured{};
    std::vector<Squares> sums(places.size(), Squares{});
    for (int run = 0; run < choice.tuning_runs; ++run) {
      const Recording one = recording(condition, run);
      add_squares(scenario, errors_of(one), measured.data());
      for (std::size_t i = 0; i < places.size(); ++i) try {
          add_run(scenario, tried[i], one, sums[i]);
        } catch (const std::exception&) {
          sums[i].fill(infinity);  // a filter that fails with bad settings has no good score
        }
    }
    return each(sums, [&](const Squares& own) { return score(own, measured); });
  }
  // The best place with its score and how many were tried; then of each batch of runs their number, and the squares of
  // the measurement and of the filter.
  Study::Row work(std::size_t condition, std::size_t f) const {
    constexpr int most_batches = 25;
    const Scenario scenario = scenario_of(conditions[condition]);
    // The best of the grid, then from neighbour to better neighbour until none is better; the first of equals is taken.
    Place best{};
    double best_score = infinity;
    std::set<Place> tried;
    for (auto places = grid(lattice(f)); !places.empty();) {
      const auto scores = scores_of(condition, f, places);
      const auto least = std::ranges::min_element(scores);
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
    const int batches = std::min(most_batches, choice.runs);
    for (int batch = 0; batch < batches; ++batch) {
      Squares own{}, raw{};
      const auto bound = [&](int at) { return static_cast<int>(static_cast<long>(choice.runs) * at / batches); };
      for (int number = bound(batch); number < bound(batch + 1); ++number) {
        const Recording one = recording(condition, choice.tuning_runs + number);
        add_squares(scenario, errors_of(one), raw.data());
        add_run(scenario, tuned, one, own);
      }
      row.push_back(bound(batch + 1) - bound(batch));
      row.insert(row.end(), raw.begin(), raw.end());
      row.insert(row.end(), own.begin(), own.end());
    }
    return row;
  }
};

struct SweepOptions {
  SweepChoice choice;
  Sharing sharing;
  OutputOptions output;
};

/// "1, strength ×0.5".
std::string words_of(const SweepCondition& condition) {
  std::string text = fmt::format("{}", condition.scenario);
  for (const auto& [name, factor] : {std::pair{"noise", condition.mismatch},
                                     {"period", condition.period},
                                     {"strength", condition.strength},
                                     {"length", condition.length}})
    if (factor != 1.0) text += fmt::format(", {} ×{:g}", name, factor);
  return text;
}

/// Whether zero is outside of it.
bool sure(const Interval& interval) { return interval.above_zero() || interval.below_zero(); }

/// HIMM against the tuned IMM in words; nothing where one of them is missing.
std::string answer(const SweepWorld& world) {
  if (!world.imm() || !world.himm(0)) return "";
  std::size_t better = 0, worse = 0, open = 0, best = 0;
  const auto difference = [&](std::size_t c) { return world.against_imm(c, *world.himm(c)); };
  for (std::size_t c = 0; c < world.conditions.size(); ++c) {
    ++(difference(c).below_zero() ? better : difference(c).above_zero() ? worse : open);
    if (difference(c).mean < difference(best).mean) best = c;
  }
  return fmt::format(
      "HIMM is better than the tuned IMM in {} of {} conditions, worse in {}, and {} are open. At best its score "
      "differs by {} ± {} %: scenario {}. HIMM is what did best on the tuning runs under any reading of (57).",
      better, world.conditions.size(), worse, open, number_text(100.0 * difference(best).mean, 1, true),
      number_text(100.0 * difference(best).half_width, 1), words_of(world.conditions[best]));
}

/// How many settings were tried, and by how many runs.
std::string searched(const SweepWorld& world) {
  const SweepChoice& choice = world.choice;
  std::string text = fmt::format("{} filters, {} settings each", world.filters.size(), world.listed_settings(0));
  if (choice.beyond > 0) {
    std::size_t tried = 0;
    for (const Tuned& tuned : world.all_tuned) tried += tuned.tried;
    text += fmt::format(
        " and about {} with those on the way from the best to better neighbours, up to {} steps beyond a list",
        tried / world.all_tuned.size(), choice.beyond);
  }
  return text + fmt::format("; chosen by {} runs and judged by {} others, seed {}", choice.tuning_runs, choice.runs,
                            choice.seed);
}

/// How many of the tuned filters are at the limit of the search; empty if none is.
std::string limits(const SweepWorld& world) {
  const auto stopped = std::ranges::count(world.all_tuned, true, &Tuned::at_the_limit);
  if (stopped == 0) return "";
  return fmt::format(
      "{} of {} tuned filters {}: there may be better ones beyond.", stopped, world.all_tuned.size(),
      world.choice.beyond == 0 ? "have a number at an end of its list" : "stopped at the limit beyond a list");
}

/// Parts of the table of all filters in all conditions: with the numbers or the name of the condition, or for one.
struct ConditionPart {
  enum : unsigned { numbers = 1, name = 2 };
};

ResultTable filters_table(const SweepWorld& world) {
  ResultTable table;
  for (std::size_t c = 0; c < world.conditions.size(); ++c)
    for (std::size_t f = 0; f < world.filters.size(); ++f) {
      const SweepCondition& condition = world.conditions[c];
      const Tuned& tuned = world.tuned(c, f);
      const FilterSettings settings = world.settings(c, f);
      const auto sigma_w = [&](std::size_t model) { return settings.motions[model][MotionParameter::sigma_w]; };
      const Cell above_imm = world.imm() ? Cell(world.against_imm(c, f)) : Cell();
      table.row_of(
          {{{.key = "scenario", .parts = ConditionPart::numbers}, condition.scenario},
           {{.key = "noise", .parts = ConditionPart::numbers}, condition.mismatch},
           {{.key = "period", .parts = ConditionPart::numbers}, condition.period},
           {{.key = "strength", .parts = ConditionPart::numbers}, condition.strength},
           {{.key = "length", .parts = ConditionPart::numbers}, condition.length},
           {of_words("condition", "scenario", ConditionPart::name), words_of(condition)},
           {of_words("filter", "filter"), settings.name},
           {{.key = "leaving", .header = "leaving", .digits = 3, .sized = true}, settings.transition[0][1]},
           {{.key = "returning", .header = "returning", .digits = 3, .sized = true}, settings.transition[1][0]},
           {{.key = "sigma_w_dwna", .header = "dwna", .sized = true, .group = "σ_w, m/s²:"}, sigma_w(0)},
           {{.key = "sigma_w_dwpa", .header = "dwpa", .sized = true, .group = "σ_w, m/s²:"}, sigma_w(1)},
           {of_words("lift", "lift"), name_of(settings.lift)},
           {{.key = "at_the_limit"}, tuned.at_the_limit ? 1 : 0},
           {{.key = "settings_tried"}, tuned.tried},
           {{.key = "tuning_score", .header = "tuning", .digits = 3, .group = "score:"}, tuned.tuning_score},
           {{.key = "score", .header = "judged", .digits = 3, .interval = true, .group = "score:"},
            tuned.score.interval()},
           {{.key = "above_imm", .header = "% above imm", .digits = 1, .scale = 100.0, .interval = true}, above_imm},
           {{.key = "is_himm"}, world.himm(c) == f ? 1 : 0}});
    }
  return table;
}

/// The score of the tuned IMM, and by how much the others are above it, with a mark where the interval is on one side
/// of zero.
ResultTable above_imm_table(const SweepWorld& world) {
  ResultTable table;
  for (std::size_t c = 0; c < world.conditions.size(); ++c) {
    std::vector<Field> fields = {{of_words("", "scenario"), words_of(world.conditions[c])},
                                 {{.header = "imm", .digits = 3}, world.tuned(c, *world.imm()).score.value()}};
    const auto add = [&](const std::string& name, std::optional<std::size_t> f) {
      const Interval above = f ? world.against_imm(c, *f) : Interval{};
      fields.push_back({{.header = name, .group = "% above imm:"},
                        f ? Cell(number_text(100.0 * above.mean, 1, true) + (sure(above) ? "*" : " ")) : Cell()});
    };
    for (std::size_t f = 0; f < world.filters.size(); ++f)
      if (f != *world.imm()) add(world.filters[f].name, f);
    add("himm", world.himm(c));
    table.row_of(fields);
  }
  return table;
}

/// Whom a column or a view of maps is of: a filter, or HIMM, which is another one in each condition.
struct Choice {
  std::string name;
  std::optional<std::size_t> filter;

  std::size_t in(const SweepWorld& world, std::size_t condition) const {
    return filter ? *filter : *world.himm(condition);
  }
};

/// Makes maps of by how much filters are above the tuned IMM.
class Maps {
 public:
  explicit Maps(const SweepWorld& world) : world_(world) {
    if (world.himm(0)) choices_.push_back({"HIMM", {}});
    for (std::size_t f = 0; f < world.filters.size(); ++f)
      if (f != world.imm()) choices_.push_back({world.filters[f].name, f});
    std::vector<double> sizes;
    for (std::size_t c = 0; c < world.conditions.size(); ++c)
      sizes.push_back(std::abs(world.against_imm(c, choices_.front().in(world, c)).mean));
    std::ranges::sort(sizes);
    most_ = sizes[sizes.size() * 19 / 20];
  }

  /// Conditions by filters, a map for each scenario.
  std::vector<Panel> of_all_filters() const {
    std::vector<Panel> panels;
    for (const int scenario : world_.choice.scenarios) {
      HeatMap map = empty(fmt::format("Scenario {}", scenario), "condition", "filter");
      map.columns = each(choices_, &Choice::name);
      std::vector<std::size_t> own;
      for (std::size_t c = 0; c < world_.conditions.size(); ++c) {
        if (world_.conditions[c].scenario != scenario) continue;
        const std::string words = words_of(world_.conditions[c]);
        map.rows.push_back(words.size() > 3 ? words.substr(3) : "as in the paper");
        own.push_back(c);
      }
      map.fill([&](std::size_t r, std::size_t column) { return cell(own[r], choices_[column]); });
      panels.emplace_back(std::move(map));
    }
    return panels;
  }

  /// All conditions of a scenario, a view for each filter: strength and length by noise and period.
  std::vector<View> of_each_filter() const {
    const SweepChoice& all = world_.choice;
    const std::size_t lengths = all.length.size(), periods = all.period.size();
    const auto names = [](const std::vector<double>& first, const std::vector<double>& second) {
      std::vector<std::string> crossed;
      for (const double a : first)
        for (const double b : second) crossed.push_back(fmt::format("×{:g}, ×{:g}", a, b));
      return crossed;
    };
    std::vector<View> views;
    for (const Choice& choice : choices_) {
      View& view = views.emplace_back(View{choice.name, {}});
      for (const int scenario : all.scenarios) {
        HeatMap map = empty(fmt::format("{}, scenario {}", choice.name, scenario), "strength, length of the manoeuvre",
                            "noise, period");
        map.rows = names(all.strength, all.length);
        map.columns = names(all.mismatch, all.period);
        map.fill([&](std::size_t r, std::size_t c) {
          const auto& conditions = world_.conditions;
          const SweepCondition here{scenario, all.mismatch[c / periods], all.period[c % periods],
                                    all.strength[r / lengths], all.length[r % lengths]};
          return cell(static_cast<std::size_t>(std::ranges::find(conditions, here) - conditions.begin()), choice);
        });
        view.panels.emplace_back(std::move(map));
      }
    }
    return views;
  }

 private:
  HeatMap empty(std::string title, std::string row_label, std::string column_label) const {
    return {.title = std::move(title),
            .row_label = std::move(row_label),
            .column_label = std::move(column_label),
            .value_label = "% above the score of the tuned IMM",
            .diverging = true,
            .digits = 1,
            .scale = 100.0,
            .sign = true,
            .most = most_,
            .note = fmt::format(
                "Negative is better. *: the interval is on one side of 0. Colours are strongest from ± {} % on.",
                number_text(100.0 * most_, 1))};
  }

  HeatMap::Cell cell(std::size_t c, const Choice& choice) const {
    const std::size_t f = choice.in(world_, c);
    const FilterSettings settings = world_.settings(c, f);
    const Interval above = world_.against_imm(c, f), score = world_.tuned(c, f).score.interval();
    return {above.mean,
            fmt::format("± {} %, score {} ± {}; {}: leaving {}, returning {}, sigma_w {} and {}, lift {}{}",
                        number_text(100.0 * above.half_width, 1), number_text(score.mean, 3),
                        number_text(score.half_width, 3), settings.name, settings.transition[0][1],
                        settings.transition[1][0], settings.motions[0][MotionParameter::sigma_w],
                        settings.motions[1][MotionParameter::sigma_w], name_of(settings.lift),
                        world_.tuned(c, f).at_the_limit ? ", at the limit of the search" : ""),
            sure(above)};
  }

  const SweepWorld& world_;
  std::vector<Choice> choices_;
  double most_ = 0.0;
};

void report(const SweepOptions& options, const SweepWorld& world) {
  constexpr std::size_t most_rows = 300;  // of a table in the page
  ResultFiles files(options.output);
  Result result(options.output);
  const ResultTable filters = filters_table(world);
  const std::string answered = answer(world), stopped = limits(world);
  const bool all_shown = world.all_tuned.size() <= most_rows;
  result.facts("campaign", world.study().description, "searched", searched(world));
  result.say(searched(world));
  if (world.imm()) {
    result.add(above_imm_table(world), {});
    result.say(
        "(imm: mean over axes and phases of RMSE over that of the measurement. *: the 95 % interval, by paired runs "
        "and together for all conditions, is on one side of 0. Negative is better.)");
    result.say("");
  }
  if (!answered.empty()) result.fact({"answer"}, answered);
  result.say({{!answered.empty(), answered}, {!stopped.empty(), stopped}});
  result.add(filters.part(ConditionPart::numbers, ""), {.printed = false, .csv = "tuned.csv"});
  for (std::size_t c = 0; c < world.conditions.size(); ++c)
    result.add(filters.part(ResultColumn::all_parts ^ (ConditionPart::numbers | ConditionPart::name), "",
                            c * world.filters.size(), world.filters.size()),
               {.printed = false, .summary = {"conditions", words_of(world.conditions[c])}});
  result.add(filters.part(ConditionPart::name, "scenario"),
             {.printed = false, .title = all_shown ? "The best settings" : ""});
  Report& page = result.page;
  page.title = "Every filter at its best settings, against the tuned IMM";
  if (!answered.empty()) page.verdict.push_back(answered);
  if (!stopped.empty()) page.verdict.push_back(stopped);
  page.verdict.push_back(searched(world) +
                         ". The score is the mean over axes and phases of RMSE over that of the measurement.");
  if (!all_shown)
    page.verdict.emplace_back("The best settings of every filter are in tuned.csv, and in each cell of the maps.");
  if (world.imm() && world.filters.size() > 1) {
    const Maps maps(world);
    if (options.choice.cross) {
      page.chooser = "Filter";
      page.views = maps.of_each_filter();
    } else {
      page.panels = maps.of_all_filters();
    }
  }
  result.publish(files);
}

template <class Value>
Option add_list(Subcommand& app, const std::string& name, std::vector<Value>& values, const std::string& meaning) {
  return app.option(name, values, fmt::format("{} [{}]", meaning, fmt::join(values, ", "))).list().text("A,B,…");
}

}  // namespace

void add_sweep(CLI::App& program, const std::string& command) {
  Subcommand app(program, "sweep", "Every filter at its best settings, in many conditions.");
  const auto options = std::make_shared<SweepOptions>();
  SweepChoice& choice = options->choice;
  const auto add_factors = [&](const char* name, std::vector<double>& values, const char* meaning) {
    add_list(app, name, values, meaning).number_in(0.05, 20.0);
  };
  add_list(app, "--scenario", choice.scenarios, "1: fire control radar, 2: surveillance radar").in({1, 2});
  add_factors("--mismatch", choice.mismatch, "Noise of the radar, believed over true");
  add_factors("--period", choice.period, "Sampling period, times the paper's");
  add_factors("--strength", choice.strength, "Acceleration, times the paper's");
  add_factors("--length", choice.length, "Length of the manoeuvre, times the paper's");
  app.flag("--cross", choice.cross, "Every combination of these four, rather than each alone with the others 1");
  add_list(app, "--filters", choice.filters, "Names as of the setting filters; the others are compared with imm");
  add_list(app, "--probability", choice.probability, "Off-diagonals of P, the two rows apart").number_in(1e-12, 1.0);
  add_list(app, "--possibility", choice.possibility, "Off-diagonals of the matrix of possibilities, the two rows apart")
      .number_in(1e-12, 1.0);
  add_list(app, "--sigma-w", choice.sigma_w, "sigma_w in m/s², the two models apart").number_in(1e-6, 1e6);
  add_list(app, "--lift", choice.lifts, "What stands for a component that a model lacks")
      .one_of({"zero", "borrowed_variance", "unbiased"});
  app.option("--beyond", choice.beyond,
             "Steps that the search may go beyond an end of a list of numbers, each by the ratio of the last two; 0: "
             "only what is listed")
      .in(0, 100);
  app.option("--tuning-runs", choice.tuning_runs, "Runs by which the best settings are chosen").in(1, 1000000);
  app.option("--runs", choice.runs, "Other runs by which they are judged").in(2, 1000000);
  add_seed(app, choice.seed);
  add_threads(app, options->sharing.threads);
  add_shard(app, options->sharing);
  add_results(app, options->output, command);
  app.run([options] {
    SweepWorld world(options->choice);
    const auto add = [&](std::size_t, const Study::Row& row) { world.add(row); };
    if (run(world.study(), options->sharing, options->output, add)) report(*options, world);
  });
}

}  // namespace sigmax::apps
