#include "himm_demo/experiment/sentences.hpp"

#include <sstream>

namespace sigmax::apps {
namespace {

/// Of each sentence a line with its place, one with its words, and one for each figure: what, of whom, against whom, in
/// which scenario/group and phases, and above and below what it must lie.
constexpr std::string_view table =
#include "himm_demo/experiment/sentences.txt"
    ;

using Of = std::size_t;
constexpr std::array<FigureOf, 7> figures = {{
    {"rmse", "RMSE", true, true, true,  // relative difference
     [](const Tally& tally, Of of, std::size_t place) { return tally.rmse(of, place / 3, place % 3); }},
    {"onset_rmse", "RMSE of z after 81", true, false,
     false,  // the ten samples from the onset on relative to ten before
     [](const Tally& tally, Of of, std::size_t) {
       return sqrt(tally.mean(of, Tally::onset_z + 1) / tally.mean(of, Tally::onset_z)) - 1.0;
     }},
    {"cross_time", "cross-time", false, false, false,  // mean of the runs, in samples
     [](const Tally& tally, Of of, std::size_t) { return tally.cross_time(of); }},
    {"cross_time_curves", "crossing of curves", false, false, false,  // of the averaged curves, in samples
     [](const Tally& tally, Of of, std::size_t) { return tally.cross_time_of_batches(of); }},
    {"lead", "share of DWPA", true, false, true,  // of the samples, in which its weight is the greatest
     [](const Tally& tally, Of of, std::size_t place) { return tally.mean(of, Tally::lead + place); }},
    {"switches", "switches", false, false, true,  // of the leading model, per run and phase
     [](const Tally& tally, Of of, std::size_t place) { return tally.mean(of, Tally::switches + place); }},
    {"switches_of_the_run", "switches of a run", false, false, false,
     [](const Tally& tally, Of of, std::size_t) {
       const auto phase = [&](std::size_t p) { return tally.mean(of, Tally::switches + p); };
       return phase(0) + phase(1) + phase(2);
     }},
}};

Statement statement(const std::string& line) {
  std::istringstream words(line);
  std::string figure, of, against, in, above, below;
  int scenario = 0, group = 0;
  char slash = '/';
  words >> figure >> of >> against >> scenario >> slash >> group >> in >> above >> below;
  const auto known = std::ranges::find(figures, figure, &FigureOf::name);
  if (known == figures.end()) throw std::logic_error(fmt::format("a sentence speaks of {}", figure));
  if (of == "most_likely") of = "most likely";
  if (against == "nobody") against = "";
  Statement result{known, of, against, scenario, group, {}, {std::stod(above), std::stod(below)}};
  for (std::size_t phase = 0; phase < phase_names.size(); ++phase)
    if (in.find(phase_names[phase]) != std::string::npos) result.phases.push_back(phase);
  return result;
}

Finding finding_of(const Interval& interval, const Region& region) {
  if (interval.lower() > region.above && interval.upper() < region.below) return Finding::inside;
  if (interval.upper() < region.above || interval.lower() > region.below) return Finding::outside;
  return Finding::open;
}

/// All figures of a sentence under a preset.
Judged measured(const Sentence& sentence, const std::vector<Condition>& conditions, Preset preset,
                std::string_view reading) {
  Judged judged;
  std::array<std::vector<Statistic>, 2> values;  // their intervals depend on how many there are
  for (const auto& statement : sentence.statements) {
    const auto found = std::ranges::find_if(conditions, [&](const Condition& one) {
      return one.preset == preset && one.scenario == statement.scenario && one.group == statement.group;
    });
    if (found == conditions.end()) throw std::logic_error("a sentence speaks of what was not run");
    const Tally& tally = found->tally;
    const FigureOf& kind = *statement.figure;
    const auto add = [&](std::optional<std::size_t> phase, std::optional<std::size_t> axis) {
      judged.figures.push_back({&statement, phase, axis});
      for (const bool released_imm : {false, true}) {
        const auto figure = [&](const std::string& actor) {
          const std::size_t of = tally.place(filter_of(actor, reading, released_imm)).value();
          return kind.of(tally, of, axis ? 3 * *phase + *axis : phase.value_or(0));
        };
        Statistic value = figure(statement.of);
        if (kind.by_axis)
          value = value / figure(statement.against) - 1.0;
        else if (!statement.against.empty())
          value = value - figure(statement.against);
        values[released_imm ? 1 : 0].push_back(std::move(value));
      }
    };
    if (!kind.by_phase) add({}, {});
    for (const std::size_t phase : statement.phases)
      for (std::size_t axis = 0; kind.by_phase && axis < (kind.by_axis ? 3 : 1); ++axis)
        add(phase, kind.by_axis ? std::optional(axis) : std::nullopt);
  }
  for (const std::size_t imm : {0U, 1U})
    for (std::size_t i = 0; i < judged.figures.size(); ++i) {
      Measured& one = judged.figures[i];
      one.interval[imm] = values[imm][i].interval(values[imm].size());
      one.finding[imm] = finding_of(one.interval[imm], one.statement->region);
    }
  return judged;
}

/// In words that --set takes: the filters of the paper and those that it is to be compared with.
std::vector<std::string> settings_of(int scenario_number, int group_number) {
  std::string names = "imm, imm_released, imm_most_likely, imm_released_most_likely, gpb2, viterbi";
  std::vector<std::string> sets = {"filter.imm.imm_mixing=correct", "filter.imm_most_likely.imm_mixing=correct",
                                   "filter.imm_released_most_likely.imm_mixing=released",
                                   "filter.imm_released_most_likely.output=most_likely"};
  for (const std::string reading : himm_readings) {
    names += ", himm_" + reading;
    if (scenario_number != 2 || group_number != 1) continue;
    names += ", himm_" + reading + "_5";  // with σ_w = 5, section VI.D
    sets.push_back(fmt::format("filter.himm_{0}_5.mixed_covariance={0}", reading));
    sets.push_back(fmt::format("filter.himm_{}_5.sigma_w=5", reading));
  }
  sets.push_back("filters=[" + names + "]");
  return sets;
}

}  // namespace

std::string filter_of(const std::string& actor, std::string_view reading, bool released_imm) {
  const std::string imm = released_imm ? "imm_released" : "imm";
  if (actor.starts_with("himm")) return fmt::format("himm_{}{}", reading, actor.substr(4));
  return actor == "imm" ? imm : actor == "most likely" ? imm + "_most_likely" : actor;
}

std::vector<Condition> conditions(int runs, std::uint64_t seed) {
  std::vector<Condition> all;
  for (const Preset preset : both_presets)
    for (const int scenario : {1, 2})
      for (const int group : {1, 2, 3, 4}) {
        const Settings settings = Settings::read({}, settings_of(scenario, group));
        all.push_back({preset, scenario, group, Tally(experiment_of(preset, scenario, group, settings, runs, seed))});
      }
  return all;
}

std::string Measured::subject() const {
  std::string text = statement->of;
  if (!statement->against.empty()) text.append(" : ").append(statement->against);
  if (!statement->figure->by_axis) text.append(", ").append(statement->figure->words);
  if (phase) text.append(", ").append(phase_names[*phase]);
  if (axis) text.append(" ").append(axis_names[*axis]);
  return text;
}

Interval Measured::shown(std::size_t imm) const {
  const double scale = statement->figure->relative ? 100.0 : 1.0;
  return {scale * interval[imm].mean, scale * interval[imm].half_width};
}

Verdict Judged::verdict() const {
  const auto all_inside = [&](std::size_t imm) {
    return std::ranges::all_of(figures, [=](const Measured& one) { return one.finding[imm] == Finding::inside; });
  };
  if (all_inside(0)) return Verdict::holds;
  if (all_inside(1)) return Verdict::only_against_released;
  const auto is_outside = [](const Measured& one) { return one.finding[0] == Finding::outside; };
  return std::ranges::any_of(figures, is_outside) ? Verdict::does_not_hold : Verdict::undecided;
}

const Measured& Judged::least_favourable() const {
  return *std::ranges::min_element(figures, {}, [](const Measured& one) {
    const auto& [above, below] = one.statement->region;
    const double inside = std::min(one.interval[0].mean - above, below - one.interval[0].mean);
    return std::isnan(inside) ? 0.0 : inside / std::max(one.interval[0].half_width, 1e-12);
  });
}

std::vector<Judged> judge(const std::vector<Condition>& conditions, Preset preset, std::string_view reading) {
  return each(sentences(), [&](const Sentence& one) { return measured(one, conditions, preset, reading); });
}

const std::vector<Sentence>& sentences() {
  static const std::vector<Sentence> all = [] {
    std::vector<Sentence> result;
    std::istringstream lines{std::string(table)};
    std::string line;
    for (std::getline(lines, line); std::getline(lines, line);) {  // the first is empty
      if (line.starts_with("  ")) {
        result.back().statements.push_back(statement(line));
        continue;
      }
      result.push_back({.place = line});
      std::getline(lines, result.back().words);
    }
    return result;
  }();
  return all;
}

std::optional<double> paper_cross_time(int scenario, int group, const FilterSettings& filter) {
  constexpr double times[2][2] = {{85.92, 83.77}, {32.28, 31.88}};  // by scenario; IMM and HIMM, in group 1
  if (group != 1 || filter.scheme != Scheme::interacting || filter.smooth || !filter.sojourn_s.empty() ||
      filter.radar_measurement != RadarForm::standard)
    return std::nullopt;  // the paper has no such filter
  return times[scenario - 1][filter.fuzzy ? 1 : 0];
}

}  // namespace sigmax::apps
