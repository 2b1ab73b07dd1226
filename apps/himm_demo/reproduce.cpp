#include "himm_demo/subcommands.hpp"

#include "himm_demo/experiment/experiment.hpp"
#include "himm_demo/experiment/sentences.hpp"
#include "report/result.hpp"
#include "study/statistic.hpp"
#include "study/study.hpp"
#include "version.hpp"

namespace sigmax::apps {
namespace {

/// The options of `himm_demo reproduce`; runs and seed decide every figure.
struct ReproduceOptions {
  int runs = 1000;
  std::uint64_t seed = 1;
  Sharing sharing;
  OutputOptions output;
};

/// The readings of (57) by which there is a filter himm_…; `envelope` is without.
constexpr std::array<const char*, 5> himm_readings = {"selected", "own", "own_recentred", "released", "envelope"};

/// The reading that a preset takes for the paper's.
std::string_view reading_of(Preset preset) { return preset == Preset::released ? "released" : "own"; }

/// The figures of one filter in one batch of runs, as they follow each other in a row: sums over the runs. Those of the
/// measurement are the squares alone.
struct Column {
  static constexpr std::size_t square = 0;                  ///< by phase and axis: mean square error
  static constexpr std::size_t onset_z = square + squares;  ///< of z in ten samples before and ten from the onset on
  static constexpr std::size_t lead = onset_z + 2;          ///< by phase: share of samples with the manoeuvre's model
  static constexpr std::size_t switches = lead + 3;         ///< by phase: how often the lead changes
  static constexpr std::size_t crossing = switches + 3;     ///< cross-times …
  static constexpr std::size_t crossed = crossing + 1;      ///< … and of how many runs
  static constexpr std::size_t curve = crossed + 1;         ///< the model's lead in weight, from the onset on
  static constexpr std::size_t curve_samples = 16;
  static constexpr std::size_t count = curve + curve_samples;
};

constexpr std::size_t first_filter = 1 + squares;  // after the number of runs and the measurement's squares

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

/// What one run of a filter adds to its columns.
void add_figures(const Experiment& experiment, const Trace& trace, std::size_t model, double* sums) {
  const auto& phases = experiment.scenario.phases;
  const int onset = experiment.scenario.onset();
  add_squares(experiment.scenario, trace.error, sums + Column::square);
  const auto squared_z = [&](std::size_t k) { return trace.error[k].z() * trace.error[k].z(); };
  sums[Column::onset_z] += phase_mean({onset - 10, onset - 1}, squared_z);
  sums[Column::onset_z + 1] += phase_mean({onset, onset + 9}, squared_z);

  const auto leads = [&](std::size_t k) { return weight_difference(trace.weights[k], model); };
  for (std::size_t p = 0; p < phases.size(); ++p) {
    sums[Column::lead + p] += phase_mean(phases[p], [&](std::size_t k) { return leads(k) > 0.0 ? 1.0 : 0.0; });
    for (auto k = static_cast<std::size_t>(phases[p].first - 1); k < static_cast<std::size_t>(phases[p].last); ++k)
      sums[Column::switches + p] += (leads(k) > 0.0) != (leads(k - 1) > 0.0) ? 1.0 : 0.0;
  }
  if (const auto crosses = cross_time(experiment, leads)) {
    sums[Column::crossing] += *crosses;
    sums[Column::crossed] += 1.0;
  }
  for (std::size_t i = 0; i < Column::curve_samples; ++i)
    sums[Column::curve + i] += leads(static_cast<std::size_t>(onset - 2) + i);
}

/// One scenario and group under one preset, with all that was found there.
class Condition {
 public:
  Preset preset;
  int scenario, group;
  Experiment experiment;
  std::size_t columns = first_filter + Column::count * experiment.filters.size();
  Batches batches{columns};

  /// The runs first … last − 1 of all filters, as one row: how many they are, and the columns of the measurement and of
  /// each filter.
  Study::Row batch(std::uint64_t first, std::uint64_t last) const {
    Study::Row row(columns, 0.0);
    row[0] = static_cast<double>(last - first);
    for (std::uint64_t number = first; number < last; ++number) {
      const TracedRun run = experiment.traced(number);
      add_squares(experiment.scenario, run.measurement.error, &row[1]);
      for (std::size_t f = 0; f < run.filters.size(); ++f)
        add_figures(experiment, run.filters[f], manoeuvre_model(experiment.filters[f]).value(),
                    &row[first_filter + Column::count * f]);
    }
    return row;
  }

  /// Whether there is such a filter here, or the measurement.
  bool has(std::string_view filter) const { return place(filter).has_value(); }

  /// The mean of one column over the runs. `filter` may be "measurement" for mean square errors.
  Statistic mean(std::string_view filter, std::size_t column) const {
    return batches.mean(place(filter).value() + column);
  }

  /// RMSE of a phase and axis in m.
  Statistic rmse(std::string_view filter, std::size_t phase, std::size_t axis) const {
    return sqrt(mean(filter, Column::square + 3 * phase + axis));
  }

  /// The mean cross-time of the runs that crossed.
  Statistic cross_time_of_runs(std::string_view filter) const {
    return batches.mean(place(filter).value() + Column::crossing, place(filter).value() + Column::crossed);
  }

  /// Where the averaged curves cross; NaN if not soon after the onset.
  Statistic cross_time_of_curves(std::string_view filter) const {
    for (std::size_t i = 1; i < Column::curve_samples; ++i) {
      const Statistic before = mean(filter, Column::curve + i - 1), now = mean(filter, Column::curve + i);
      if (before.value() <= 0.0 && now.value() > 0.0)
        return before / (before - now) +
               (experiment.scenario.onset() - 2.0 + static_cast<double>(i) + experiment.mode_sample_shift);
    }
    return {};
  }

 private:
  /// Where its columns begin.
  std::optional<std::size_t> place(std::string_view filter) const {
    if (filter == measurement_name) return 1;
    for (std::size_t f = 0; f < experiment.filters.size(); ++f)
      if (experiment.filters[f].name == filter) return first_filter + Column::count * f;
    return std::nullopt;
  }
};

/// One figure of a sentence, measured. The intervals of all figures of one sentence hold together with 95 %.
struct Measured {
  const Statement* statement;
  std::optional<std::size_t> phase, axis;
  Interval interval;
  Finding finding;
};

/// Which filters a sentence is read of.
struct Cast {
  std::string_view reading;  ///< of (57), for HIMM
  bool released_imm;         ///< the authors' program's IMM rather than the correct one

  /// Their name, or nothing of nobody.
  std::string filter(Actor subject) const {
    const std::string himm = "himm_" + std::string(reading), imm = released_imm ? "imm_released" : "imm";
    const std::array<std::string, 6> names = {himm, himm + "_5", imm, imm + "_most_likely", measurement_name, ""};
    return names[static_cast<std::size_t>(subject)];
  }
};

const Condition& condition_of(const Statement& statement, const std::vector<Condition>& conditions, Preset preset) {
  for (const Condition& condition : conditions)
    if (condition.preset == preset && condition.scenario == statement.scenario && condition.group == statement.group)
      return condition;
  throw std::logic_error("a sentence speaks of what was not run");
}

/// The figure of one filter that is not by axis.
Statistic figure_of(FigureOf figure, const Condition& condition, const std::string& filter, std::size_t phase) {
  const auto mean = [&](std::size_t column) { return condition.mean(filter, column); };
  if (figure == FigureOf::onset_rmse) return sqrt(mean(Column::onset_z + 1) / mean(Column::onset_z)) - 1.0;
  if (figure == FigureOf::cross_time) return condition.cross_time_of_runs(filter);
  if (figure == FigureOf::cross_time_curves) return condition.cross_time_of_curves(filter);
  if (figure == FigureOf::lead) return mean(Column::lead + phase);
  if (figure == FigureOf::switches) return mean(Column::switches + phase);
  return mean(Column::switches) + mean(Column::switches + 1) + mean(Column::switches + 2);
}

/// All figures of a sentence under a preset.
std::vector<Measured> measure(const Sentence& sentence, const std::vector<Condition>& conditions, Preset preset,
                              const Cast& cast) {
  std::vector<Measured> all;
  std::vector<Statistic> values;  // their intervals depend on how many there are
  for (const auto& statement : sentence.statements) {
    const Condition& condition = condition_of(statement, conditions, preset);
    const std::string of = cast.filter(statement.of), against = cast.filter(statement.against);
    const auto add = [&](std::optional<std::size_t> phase, std::optional<std::size_t> axis, Statistic value) {
      all.push_back({&statement, phase, axis, {}, Finding::open});
      values.push_back(std::move(value));
    };
    const auto add_figure = [&](std::optional<std::size_t> phase) {
      const auto figure = [&](const std::string& filter) {
        return figure_of(statement.figure, condition, filter, phase.value_or(0));
      };
      add(phase, {}, against.empty() ? figure(of) : figure(of) - figure(against));
    };
    const bool by_phase = statement.figure == FigureOf::lead || statement.figure == FigureOf::switches;
    if (!by_phase && statement.figure != FigureOf::rmse) add_figure({});
    for (const std::size_t phase : statement.phases)
      if (by_phase)
        add_figure(phase);
      else
        for (std::size_t axis = 0; axis < 3 && statement.figure == FigureOf::rmse; ++axis)
          add(phase, axis, condition.rmse(of, phase, axis) / condition.rmse(against, phase, axis) - 1.0);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].interval = values[i].interval(values.size());
    all[i].finding = finding_of(all[i].interval, all[i].statement->region);
  }
  return all;
}

/// Both presets, both scenarios and all groups, in this order.
std::vector<Condition> conditions(const ReproduceOptions& options) {
  std::vector<Condition> all;
  for (const Preset preset : both_presets)
    for (const int scenario : {1, 2})
      for (const int group : {1, 2, 3, 4}) {
        const Settings settings = Settings::read({}, settings_of(scenario, group));
        all.push_back(
            {preset, scenario, group, experiment_of(preset, scenario, group, settings, options.runs, options.seed)});
      }
  return all;
}

/// All runs of the conditions, in batches whose number does not depend on the runs (but for few). Does them, and gives
/// each condition its own; false where there is nothing to report.
bool run(const ReproduceOptions& options, std::vector<Condition>& conditions) {
  constexpr std::size_t most_batches = 100;
  const auto runs = static_cast<std::size_t>(options.runs), batches = std::min(most_batches, runs);
  const auto bound = [=](std::size_t batch) { return std::uint64_t{runs} * batch / batches; };
  const Study study{"batches", conditions.size() * batches,
                    [&](std::size_t cell) {
                      const std::size_t batch = cell % batches;
                      return conditions[cell / batches].batch(bound(batch), bound(batch + 1));
                    },
                    fmt::format("himm_demo {} reproduce --runs {} --seed {}", version, options.runs, options.seed)};
  return run(study, options.sharing, options.output,
             [&](std::size_t cell, const Study::Row& row) { conditions[cell / batches].batches.add(row); });
}

Finding finding_of(const std::vector<Measured>& all) {
  const auto is = [](Finding finding) { return [=](const Measured& measured) { return measured.finding == finding; }; };
  if (std::ranges::all_of(all, is(Finding::inside))) return Finding::inside;
  return std::ranges::any_of(all, is(Finding::outside)) ? Finding::outside : Finding::open;
}

enum class Verdict { holds, only_against_released, does_not_hold, undecided };

/// One sentence under one preset and reading, against both IMMs.
struct Judged {
  std::vector<Measured> against_correct, against_released;

  /// A sentence holds if all its figures are inside their regions, and does not if one is outside. The correct IMM
  /// decides, unless it holds only against the released one.
  Verdict verdict() const {
    const Finding correct = finding_of(against_correct);
    if (correct == Finding::inside) return Verdict::holds;
    if (finding_of(against_released) == Finding::inside) return Verdict::only_against_released;
    return correct == Finding::outside ? Verdict::does_not_hold : Verdict::undecided;
  }
};

/// Everything that is judged, by preset, reading and sentence.
using Judgements = std::map<Preset, std::map<std::string_view, std::vector<Judged>>>;

/// Measures every sentence for every preset and reading.
Judgements judge(const std::vector<Condition>& conditions) {
  Judgements all;
  for (const Preset preset : both_presets)
    for (const char* reading : himm_readings)
      for (const auto& sentence : sentences())
        all[preset][reading].push_back({measure(sentence, conditions, preset, {reading, false}),
                                        measure(sentence, conditions, preset, {reading, true})});
  return all;
}

const char* words_of(Preset preset) { return preset == Preset::released ? "As released" : "As printed"; }

/// That of an enumerator, of words in the order of all.
template <class Enumerator, std::size_t size>
std::string_view word_of(Enumerator one, const std::array<const char*, size>& words) {
  return words[static_cast<std::size_t>(one)];
}
constexpr std::array verdict_words = {"holds", "only released", "does not hold", "undecided"};
constexpr std::array verdict_letters = {"yes", "(yes)", "no", "?"};
constexpr std::array finding_names = {"inside", "outside", "open"};
constexpr std::array figure_names = {"RMSE",          "RMSE of z after 81", "cross-time",       "crossing of curves",
                                     "share of DWPA", "switches",           "switches of a run"};
constexpr std::array actor_words = {"himm", "himm_5", "imm", "most likely", "measurement", ""};

/// "1/2": scenario and group.
std::string name_of(const Condition& condition) { return fmt::format("{}/{}", condition.scenario, condition.group); }

/// Whether a figure is shown in per cent: a share or a relative difference.
bool relative(const Measured& measured) {
  const FigureOf figure = measured.statement->figure;
  return figure == FigureOf::rmse || figure == FigureOf::onset_rmse || figure == FigureOf::lead;
}

double scale_of(const Measured& measured) { return relative(measured) ? 100.0 : 1.0; }

Interval shown(const Measured& measured) {
  return {scale_of(measured) * measured.interval.mean, scale_of(measured) * measured.interval.half_width};
}

std::string text_of(const Measured& measured) {
  const Interval interval = shown(measured);
  return fmt::format("{} ± {}{}", number_text(interval.mean, 1, measured.statement->against != Actor::nobody),
                     number_text(interval.half_width, 1), relative(measured) ? " %" : "");
}

/// Of whom a figure is, and when: "himm : imm, during z".
std::string subject_of(const Measured& measured) {
  const Statement& statement = *measured.statement;
  std::string text(word_of(statement.of, actor_words));
  if (statement.against != Actor::nobody) text.append(" : ").append(word_of(statement.against, actor_words));
  if (statement.figure != FigureOf::rmse) text.append(", ").append(word_of(statement.figure, figure_names));
  if (measured.phase) text.append(", ").append(phase_names[*measured.phase]);
  if (measured.axis) text.append(" ").append(axis_names[*measured.axis]);
  return text;
}

/// The same after scenario and group: "1/2 himm : imm, during z".
std::string place_and_subject_of(const Measured& measured) {
  return fmt::format("{}/{} {}", measured.statement->scenario, measured.statement->group, subject_of(measured));
}

/// The place of the figure that speaks most against the sentence, in half widths of its interval.
std::size_t least_favourable(const std::vector<Measured>& all) {
  const auto margin = [](const Measured& measured) {
    const Region& region = measured.statement->region;
    const double inside = std::min(measured.interval.mean - region.above, region.below - measured.interval.mean);
    return std::isnan(inside) ? 0.0 : inside / std::max(measured.interval.half_width, 1e-12);
  };
  return static_cast<std::size_t>(std::ranges::min_element(all, {}, margin) - all.begin());
}

/// Parts of the table of sentences: with a verdict for each preset, HIMM being what the preset takes for it; and with
/// one for each reading of (57).
struct SentencePart {
  enum : unsigned { claims = 1, readings = 2 };
};

ResultTable sentences_table(const Judgements& all) {
  ResultTable table;
  for (std::size_t s = 0; s < sentences().size(); ++s) {
    std::vector<Field> fields = {{{.key = "sentence", .header = "no."}, std::to_string(s + 1)},
                                 {of_words("place", "where", SentencePart::claims), sentences()[s].place},
                                 {of_words("words", "the paper says", SentencePart::claims), sentences()[s].words}};
    for (const Preset preset : both_presets)
      fields.push_back(
          {of_words(name_of(preset), preset == Preset::released ? "as released" : "as printed", SentencePart::claims),
           word_of(all.at(preset).at(reading_of(preset))[s].verdict(), verdict_words)});
    for (const Preset preset : both_presets)
      for (const std::string reading : himm_readings) {  // of whose name three letters fit into 80 columns
        const std::string word = reading.substr(reading.rfind('_') + 1);
        fields.push_back({of_words(fmt::format("{}_{}", name_of(preset), reading),
                                   word.size() <= 3 ? word : word.substr(0, 3) + ".", SentencePart::readings),
                          word_of(all.at(preset).at(reading)[s].verdict(), verdict_letters)});
      }
    table.row_of(fields);
  }
  return table;
}

/// How many figures of each sentence are where it wants them, and the one that speaks most against it.
ResultTable deciding_figures(const std::vector<Judged>& all) {
  ResultTable table;
  for (std::size_t s = 0; s < all.size(); ++s) {
    const auto& figures = all[s].against_correct;
    const auto inside = std::ranges::count(figures, Finding::inside, &Measured::finding);
    const std::size_t worst = least_favourable(figures);
    table.row_of({{{.header = "no."}, s + 1},
                  {{.header = "sure"}, fmt::format("{}/{}", inside, figures.size())},
                  {of_words("", "least favourable"), place_and_subject_of(figures[worst])},
                  {{.header = "correct IMM"}, text_of(figures[worst])},
                  {{.header = "released IMM"}, text_of(all[s].against_released[worst])}});
  }
  return table;
}

/// Every figure of every sentence.
ResultTable figures_table(const Judgements& all) {
  ResultTable table;
  for (const auto& [preset, by_reading] : all)
    for (const auto& [reading, judged] : by_reading)
      for (std::size_t s = 0; s < judged.size(); ++s)
        for (const bool released : {false, true})
          for (const Measured& measured : released ? judged[s].against_released : judged[s].against_correct) {
            const Statement& statement = *measured.statement;
            const Cast cast{reading, released};
            table.row_of({{{.key = "sentence"}, s + 1},
                          {{.key = "preset"}, name_of(preset)},
                          {{.key = "reading"}, reading},
                          {{.key = "imm"}, released ? "released" : "correct"},
                          {{.key = "scenario"}, statement.scenario},
                          {{.key = "group"}, statement.group},
                          {{.key = "phase"}, measured.phase ? Cell(phase_names[*measured.phase]) : Cell()},
                          {{.key = "axis"}, measured.axis ? Cell(axis_names[*measured.axis]) : Cell()},
                          {{.key = "figure"}, word_of(statement.figure, figure_names)},
                          {{.key = "of"}, cast.filter(statement.of)},
                          {{.key = "against"}, cast.filter(statement.against)},
                          {{.key = "value", .interval = true}, measured.interval},
                          {{.key = "wanted_above"}, statement.region.above},
                          {{.key = "wanted_below"}, statement.region.below},
                          {{.key = "finding"}, word_of(measured.finding, finding_names)}});
          }
  return table;
}

/// All filters; some come first.
std::vector<std::string> names_of(std::span<const Condition> conditions, std::vector<std::string> names = {}) {
  for (const auto& condition : conditions)
    for (const auto& filter : condition.experiment.filters)
      if (std::ranges::find(names, filter.name) == names.end()) names.push_back(filter.name);
  return names;
}

/// RMSE of the measurement and every filter, by phase and axis, in all conditions; a part has what is of one of them.
ResultTable rmse_table(const std::vector<Condition>& conditions) {
  ResultTable table;
  for (const Condition& condition : conditions)
    for (const auto& name : names_of({&condition, 1}, {measurement_name})) {
      std::vector<Field> fields = {{{.key = "preset", .parts = 0}, name_of(condition.preset)},
                                   {{.key = "scenario", .parts = 0}, condition.scenario},
                                   {{.key = "group", .parts = 0}, condition.group},
                                   {{.key = "filter"}, name}};
      for (std::size_t i = 0; i < squares; ++i)
        fields.push_back({{.key = fmt::format("rmse_{}_{}_m", phase_names[i / 3], axis_names[i % 3]), .interval = true},
                          condition.rmse(name, i / 3, i % 3).interval()});
      table.row_of(fields);
    }
  return table;
}

/// The mean over axes and phases of RMSE over that of the measurement; NaN where there is no such filter.
double over_measurement(const Condition& condition, std::string_view filter) {
  if (!condition.has(filter)) return nan;
  double sum = 0.0;
  for (std::size_t i = 0; i < squares; ++i)
    sum += condition.rmse(filter, i / 3, i % 3).value() / condition.rmse(measurement_name, i / 3, i % 3).value();
  return sum / static_cast<double>(squares);
}

/// That of every filter in every scenario and group.
ResultTable overview_table(const std::vector<Condition>& conditions, Preset preset) {
  ResultTable table;
  for (const auto& name : names_of(conditions)) {
    std::vector<Field> fields = {{of_words("filter", "filter"), name}};
    for (const auto& condition : conditions)
      if (condition.preset == preset)
        fields.push_back({{.key = name_of(condition), .header = name_of(condition), .digits = 3},
                          condition.has(name) ? Cell(over_measurement(condition, name)) : Cell()});
    table.row_of(fields);
  }
  return table;
}

HeatMap overview_map(const std::vector<Condition>& conditions, const std::vector<std::string>& names, Preset preset) {
  HeatMap map{.title = fmt::format("{}: RMSE over that of the measurement", words_of(preset)),
              .row_label = "filter",
              .column_label = "scenario/group",
              .rows = names,
              .value_label = "ratio, mean over axes and phases",
              .digits = 3};
  std::vector<const Condition*> own;
  for (const Condition& condition : conditions) {
    if (condition.preset != preset) continue;
    own.push_back(&condition);
    map.columns.push_back(name_of(condition));
  }
  map.fill([&](std::size_t r, std::size_t c) { return HeatMap::Cell{over_measurement(*own[c], names[r])}; });
  return map;
}

/// What a figure is shown together with: the RMSE of the same two filters, or other figures of its unit.
std::string chart_of(const Measured& measured) {
  const Statement& statement = *measured.statement;
  if (statement.figure == FigureOf::rmse)
    return fmt::format("RMSE of {} against {}", word_of(statement.of, actor_words),
                       word_of(statement.against, actor_words));
  if (relative(measured)) return "The z axis after the onset, and who leads";
  return statement.against == Actor::nobody ? "Cross-times and switches" : "Differences of cross-times and switches";
}

/// The figures of all sentences that are of this scenario and group, and where the sentences want them.
std::vector<Panel> figures_of(const std::vector<Judged>& sentences, const Condition& condition) {
  std::vector<IntervalChart> charts;
  for (std::size_t s = 0; s < sentences.size(); ++s)
    for (std::size_t i = 0; i < sentences[s].against_correct.size(); ++i) {
      const Measured& measured = sentences[s].against_correct[i];
      const Statement& statement = *measured.statement;
      if (statement.scenario != condition.scenario || statement.group != condition.group) continue;
      const std::string title = chart_of(measured);
      auto chart = std::ranges::find(charts, title, &IntervalChart::title);
      if (chart == charts.end()) {
        charts.push_back(
            {.title = title,
             .x_label = relative(measured) ? "relative difference or share, %" : "samples, or switches a run",
             .series = {{.name = "with the correct IMM"}, {.name = "with the released IMM"}},
             .reference = statement.against == Actor::nobody ? std::nullopt : std::optional(0.0),
             .wanted_label = "where the sentence wants it",
             .digits = relative(measured) ? 1 : 2,
             .note = "The number is the sentence's; the intervals hold together for all its figures."});
        chart = charts.end() - 1;
      }
      const bool rmse = statement.figure == FigureOf::rmse;
      chart->rows.push_back(
          fmt::format("{}. {}", s + 1,
                      rmse ? fmt::format("{} {}", phase_names[*measured.phase], axis_names[*measured.axis])
                           : subject_of(measured)));
      chart->series[0].values.push_back(shown(measured));
      chart->series[1].values.push_back(shown(sentences[s].against_released[i]));
      for (IntervalSeries& series : chart->series)
        series.wanted.push_back(
            {scale_of(measured) * statement.region.above, scale_of(measured) * statement.region.below});
    }
  return {charts.begin(), charts.end()};
}

/// What decides in a condition, and the RMSE of the measurement and the filters.
View view_of(const Judgements& all, const Condition& condition, const std::vector<std::string>& names) {
  View view{fmt::format("{}: scenario {}, group {}", words_of(condition.preset), condition.scenario, condition.group),
            figures_of(all.at(condition.preset).at(reading_of(condition.preset)), condition)};
  for (std::size_t axis = 0; axis < axis_names.size(); ++axis) {
    IntervalChart chart{.title = fmt::format("RMSE in {}", axis_names[axis]),
                        .x_label = "RMSE, m",
                        .rows = {phase_names.begin(), phase_names.end()}};
    for (const auto& name : names) {
      if (!condition.has(name)) continue;
      IntervalSeries& series = chart.series.emplace_back(IntervalSeries{.name = name, .group = name});
      for (std::size_t phase = 0; phase < phase_names.size(); ++phase)
        series.values.push_back(condition.rmse(name, phase, axis).interval());
    }
    view.panels.emplace_back(std::move(chart));
  }
  return view;
}

/// "As printed: 3 of 20 hold, …".
std::string counts_of(const std::vector<Judged>& sentences, Preset preset) {
  std::array<int, 4> count{};
  for (const auto& judged : sentences) ++count[static_cast<std::size_t>(judged.verdict())];
  return fmt::format("{}: {} of {} hold, {} only against the released IMM, {} do not, {} are undecided.",
                     words_of(preset), count[0], sentences.size(), count[1], count[2], count[3]);
}

void report(const ReproduceOptions& options, const std::vector<Condition>& conditions) {
  ResultFiles files(options.output);
  Result result(options.output);
  const Judgements all = judge(conditions);
  const auto of = [&](Preset preset) -> const std::vector<Judged>& { return all.at(preset).at(reading_of(preset)); };
  const ResultTable sentences = sentences_table(all), claims = sentences.part(SentencePart::claims, "no."),
                    readings = sentences.part(SentencePart::readings, "no.");
  const std::string each_reading = "Each reading of (57), as printed and then as released";
  result.facts("runs", options.runs, "seed", options.seed);
  result.text = fmt::format("Section VI, sentence by sentence: {} runs of each scenario, group and preset, seed {}\n",
                            options.runs, options.seed);
  result.add(claims, {.csv = "claims.csv", .summary = {"sentences"}});
  result.say(
      "(1/2 is scenario 1, group 2. \"only released\": holds only against the released IMM. HIMM has the reading of "
      "(57) that is printed, or released.)");
  for (const Preset preset : both_presets) result.say(counts_of(of(preset), preset));
  result.add(readings, {.heading = each_reading, .csv = "readings.csv", .summary = {"readings"}});
  result.say(
      "((yes): only against the released IMM. ?: undecided. sel., rec., rel., env.: selected, own_recentred, released, "
      "and envelope, which is (A-1) without (A-4).)");
  result.add(figures_table(all), {.printed = false, .csv = "figures.csv"});
  const ResultTable rmse = rmse_table(conditions);
  result.add(rmse, {.printed = false, .csv = "filters.csv"});

  Report& page = result.page;
  page.title = "Section VI of the paper, sentence by sentence";
  for (const Preset preset : both_presets) page.verdict.push_back(counts_of(of(preset), preset));
  page.verdict.push_back(
      fmt::format("{} runs of each scenario, group and preset, seed {}.", options.runs, options.seed));
  page.panels.emplace_back(ReportTable{.title = "The sentences",
                                       .table = claims,
                                       .note = "\"Only released\": it holds only against the released IMM. HIMM has "
                                               "the reading of (57) that is printed, or released."});
  // Those first that the sentences are about: their colours differ.
  auto names = names_of(conditions, {"imm", "himm_own", "himm_released", "himm_selected", "himm_own_recentred"});
  for (const Preset preset : both_presets) page.last.emplace_back(overview_map(conditions, names, preset));
  page.groups.push_back({measurement_name, true});
  for (const auto& name : names)
    page.groups.push_back({.name = name, .shown = name == "imm" || name == "himm_own" || name == "himm_released"});
  page.chooser = "Show";
  names.insert(names.begin(), measurement_name);
  for (const auto& condition : conditions) page.views.push_back(view_of(all, condition, names));

  for (const Preset preset : both_presets) {
    const std::string heading = fmt::format("{}: the figures that decide", words_of(preset));
    result.add(
        deciding_figures(of(preset)),
        {.heading = heading,
         .title = heading,
         .note = "The least favourable one, against both IMMs; \"sure\": how many are where the sentence wants them."});
  }
  result.say(
      "(Scenario/group, filter : its reference, phase and axis. The relative difference of RMSE unless something else "
      "is named, ± 95 % by paired runs, together for all figures of a sentence; \"sure\" is how many of them are where "
      "the sentence wants them, and the figure is the least favourable, against the correct IMM.)");
  for (const Preset preset : both_presets)
    result.add(
        overview_table(conditions, preset),
        {.heading = fmt::format("{}: RMSE over that of the measurement, mean over axes and phases", words_of(preset)),
         .summary = {"over_measurement", name_of(preset)}});
  result.say("(Filters whose names end with 5 have sigma_w = 5.)");
  result.add(readings, {.printed = false, .title = each_reading, .note = "(yes): only against the released IMM."});
  std::size_t row = 0;
  for (const auto& condition : conditions) {
    const std::size_t rows = condition.experiment.filters.size() + 1;
    result.add(rmse.part(1, "", row, rows),
               {.printed = false, .summary = {"rmse", name_of(condition.preset), name_of(condition)}});
    row += rows;
  }
  for (const Preset preset : both_presets)
    for (std::size_t s = 0; s < of(preset).size(); ++s)
      for (std::size_t i = 0; i < of(preset)[s].against_correct.size(); ++i) {
        const Measured& measured = of(preset)[s].against_correct[i];
        result.facts_at({"figures", name_of(preset), std::to_string(s + 1), place_and_subject_of(measured)}, "per_cent",
                        relative(measured), "against_correct_imm", shown(measured), "against_released_imm",
                        shown(of(preset)[s].against_released[i]));
      }
  result.publish(files);
}

}  // namespace

void add_reproduce(CLI::App& program, const std::string& command) {
  Subcommand app(program, "reproduce", "What section VI of the paper says, sentence by sentence.");
  const auto options = std::make_shared<ReproduceOptions>();
  app.option("--runs", options->runs, "Monte Carlo runs of each scenario, group and preset").in(2, 100000000);
  add_threads(app, options->sharing.threads);
  add_seed(app, options->seed);
  add_shard(app, options->sharing);
  add_results(app, options->output, command);
  app.run([options] {
    auto all = conditions(*options);
    if (run(*options, all)) report(*options, all);
  });
}

}  // namespace sigmax::apps
