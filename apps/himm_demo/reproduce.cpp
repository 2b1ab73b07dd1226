#include "himm_demo/experiment/sentences.hpp"
#include "report/result.hpp"
#include "shell/command_line.hpp"
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

/// All runs of the conditions, in batches whose number does not depend on the runs (but for few). Does them, and gives
/// each condition its own; false where there is nothing to report.
bool run(const ReproduceOptions& options, std::vector<Condition>& conditions) {
  constexpr std::size_t most_batches = 100;
  const auto runs = static_cast<std::size_t>(options.runs), batches = std::min(most_batches, runs);
  const auto bound = [=](std::size_t batch) { return std::uint64_t{runs} * batch / batches; };
  const Study study{"batches", conditions.size() * batches,
                    [&](std::size_t cell) {
                      const std::size_t batch = cell % batches;
                      return conditions[cell / batches].tally.row(bound(batch), bound(batch + 1));
                    },
                    fmt::format("himm_demo {} reproduce --runs {} --seed {}", version, options.runs, options.seed)};
  return run(study, options.sharing, options.output,
             [&](std::size_t cell, const Study::Row& row) { conditions[cell / batches].tally.add(row); });
}

/// Everything that is judged, by preset, reading and sentence.
using Judgements = std::map<Preset, std::map<std::string_view, std::vector<Judged>>>;

/// That of an enumerator, of words in the order of all.
template <class Enumerator, std::size_t size>
std::string_view word_of(Enumerator one, const std::array<const char*, size>& words) {
  return words[static_cast<std::size_t>(one)];
}
constexpr std::array verdict_words = {"holds", "only released", "does not hold", "undecided"};
constexpr std::array verdict_letters = {"yes", "(yes)", "no", "?"};
constexpr std::array finding_names = {"inside", "outside", "open"};
std::string text_of(const Measured& measured, std::size_t imm) {
  const auto [mean, half_width] = measured.shown(imm);
  return fmt::format("{} ± {}{}", number_text(mean, 1, !measured.statement->against.empty()),
                     number_text(half_width, 1), measured.statement->figure->relative ? " %" : "");
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
    const auto& figures = all[s].figures;
    const Measured& worst = all[s].least_favourable();
    const auto inside = [](const Measured& one) { return one.finding[0] == Finding::inside; };
    table.row_of({{{.header = "no."}, s + 1},
                  {{.header = "sure"}, fmt::format("{}/{}", std::ranges::count_if(figures, inside), figures.size())},
                  {of_words("", "least favourable"), place_of(*worst.statement) + " " + worst.subject()},
                  {{.header = "correct IMM"}, text_of(worst, 0)},
                  {{.header = "released IMM"}, text_of(worst, 1)}});
  }
  return table;
}

/// Every figure of every sentence.
ResultTable figures_table(const Judgements& all) {
  ResultTable table;
  for (const auto& [preset, by_reading] : all)
    for (const auto& [reading, judged] : by_reading)
      for (std::size_t s = 0; s < judged.size(); ++s)
        for (const std::size_t imm : {0U, 1U})
          for (const Measured& measured : judged[s].figures) {
            const Statement& statement = *measured.statement;
            table.row_of({{{.key = "sentence"}, s + 1},
                          {{.key = "preset"}, name_of(preset)},
                          {{.key = "reading"}, reading},
                          {{.key = "imm"}, imm == 1 ? "released" : "correct"},
                          {{.key = "scenario"}, statement.scenario},
                          {{.key = "group"}, statement.group},
                          {{.key = "phase"}, measured.phase ? Cell(phase_names[*measured.phase]) : Cell()},
                          {{.key = "axis"}, measured.axis ? Cell(axis_names[*measured.axis]) : Cell()},
                          {{.key = "figure"}, statement.figure->words},
                          {{.key = "of"}, filter_of(statement.of, reading, imm == 1)},
                          {{.key = "against"}, filter_of(statement.against, reading, imm == 1)},
                          {{.key = "value", .interval = true}, measured.interval[imm]},
                          {{.key = "wanted_above"}, statement.region.above},
                          {{.key = "wanted_below"}, statement.region.below},
                          {{.key = "finding"}, word_of(measured.finding[imm], finding_names)}});
          }
  return table;
}

/// RMSE of the measurement and every filter, by phase and axis, in all conditions.
ResultTable rmse_table(const std::vector<Condition>& conditions) {
  ResultTable table;
  for (const auto& [preset, scenario, group, tally] : conditions)
    for (std::size_t of = 0; of < tally.size(); ++of) {
      std::vector<Field> fields = {{{.key = "preset"}, name_of(preset)},
                                   {{.key = "scenario"}, scenario},
                                   {{.key = "group"}, group},
                                   {{.key = "filter"}, tally.name(of)}};
      for (std::size_t i = 0; i < 9; ++i)
        fields.push_back({{.key = fmt::format("rmse_{}_{}_m", phase_names[i / 3], axis_names[i % 3]), .interval = true},
                          tally.rmse(of, i / 3, i % 3).interval()});
      table.row_of(fields);
    }
  return table;
}

/// All filters; some come first.
std::vector<std::string> names_of(const std::vector<Condition>& conditions, std::vector<std::string> names = {}) {
  for (const auto& condition : conditions)
    for (std::size_t of = 1; of < condition.tally.size(); ++of)
      if (std::ranges::find(names, condition.tally.name(of)) == names.end()) names.push_back(condition.tally.name(of));
  return names;
}

/// RMSE over that of the measurement, of filters in every scenario and group of a preset; NaN where there is no such
/// filter.
HeatMap overview_of(const std::vector<Condition>& conditions, std::vector<std::string> names, Preset preset) {
  HeatMap map{.title = fmt::format("{}: RMSE over that of the measurement", words_of(preset)),
              .row_label = "filter",
              .column_label = "scenario/group",
              .rows = std::move(names),
              .value_label = "ratio, mean over axes and phases",
              .digits = 3};
  std::vector<const Condition*> own;
  for (const Condition& condition : conditions) {
    if (condition.preset != preset) continue;
    own.push_back(&condition);
    map.columns.push_back(place_of(condition));
  }
  map.fill([&](std::size_t r, std::size_t c) {
    const auto of = own[c]->tally.place(map.rows[r]);
    return HeatMap::Cell{of ? own[c]->tally.over_measurement(*of).value() : nan};
  });
  return map;
}

ResultTable table_of(const HeatMap& map) {
  ResultTable table;
  for (std::size_t r = 0; r < map.rows.size(); ++r) {
    std::vector<Field> fields = {{of_words("filter", "filter"), map.rows[r]}};
    for (std::size_t c = 0; c < map.columns.size(); ++c)
      fields.push_back({{.key = map.columns[c], .header = map.columns[c], .digits = map.digits},
                        std::isnan(map.values[r][c]) ? Cell() : Cell(map.values[r][c])});
    table.row_of(fields);
  }
  return table;
}

/// "As printed: 3 of 20 hold, …".
std::string counts_of(const std::vector<Judged>& sentences, Preset preset) {
  std::array<int, 4> count{};
  for (const auto& judged : sentences) ++count[static_cast<std::size_t>(judged.verdict())];
  return fmt::format("{}: {} of {} hold, {} only against the released IMM, {} do not, {} are undecided.",
                     words_of(preset), count[0], sentences.size(), count[1], count[2], count[3]);
}

void report(const ReproduceOptions& options, const std::vector<Condition>& conditions) {
  constexpr const char* each_reading = "Each reading of (57), as printed and then as released";
  ResultFiles files(options.output);
  Result result(options.output);
  Judgements all;
  for (const Preset preset : both_presets)
    for (const char* reading : himm_readings) all[preset][reading] = judge(conditions, preset, reading);
  const auto of = [&](Preset preset) -> const std::vector<Judged>& { return all.at(preset).at(reading_of(preset)); };
  const ResultTable sentences = sentences_table(all), claims = sentences.part(SentencePart::claims, "no."),
                    readings = sentences.part(SentencePart::readings, "no.");
  const std::string runs =
      fmt::format("{} runs of each scenario, group and preset, seed {}", options.runs, options.seed);
  result.facts("runs", options.runs, "seed", options.seed);
  result.text = fmt::format("Section VI, sentence by sentence: {}\n", runs);
  result.add(claims, {.csv = "claims.csv", .summary = {"sentences"}});
  result.say(
      "(1/2 is scenario 1, group 2. \"only released\": holds only against the released IMM. HIMM has the reading of "
      "(57) that is printed, or released.)");
  Report& page = result.page;
  page.title = "Section VI of the paper, sentence by sentence";
  for (const Preset preset : both_presets) {
    result.say(counts_of(of(preset), preset));
    page.verdict.push_back(counts_of(of(preset), preset));
  }
  page.verdict.push_back(runs + ".");
  result.add(readings, {.heading = each_reading, .csv = "readings.csv", .summary = {"readings"}});
  result.say(
      "((yes): only against the released IMM. ?: undecided. sel., rec., rel., env.: selected, own_recentred, released, "
      "and envelope, which is (A-1) without (A-4).)");
  result.add(figures_table(all), {.printed = false, .csv = "figures.csv"});
  result.add(rmse_table(conditions), {.printed = false, .csv = "filters.csv"});

  page.panels.emplace_back(ReportTable{.title = "The sentences",
                                       .table = claims,
                                       .note = "\"Only released\": it holds only against the released IMM. HIMM has "
                                               "the reading of (57) that is printed, or released."});
  // Those first that the sentences are about: their colours differ.
  auto names = names_of(conditions, {"imm", "himm_own", "himm_released", "himm_selected", "himm_own_recentred"});
  for (const Preset preset : both_presets) page.last.emplace_back(overview_of(conditions, names, preset));
  page.groups.push_back({measurement_name, true});
  for (const auto& name : names)
    page.groups.push_back({.name = name, .shown = name == "imm" || name == "himm_own" || name == "himm_released"});
  page.chooser = "Show";
  names.insert(names.begin(), measurement_name);
  for (const auto& condition : conditions) page.views.push_back(view_of(of(condition.preset), condition, names));

  for (const Preset preset : both_presets) {
    const std::string heading = fmt::format("{}: the figures that decide", words_of(preset));
    result.add(deciding_figures(of(preset)), {.heading = heading,
                                              .title = heading,
                                              .note = "The least favourable figure, against both IMMs; \"sure\" counts "
                                                      "the figures whose interval is where the sentence wants it."});
  }
  result.say(
      "(Scenario/group, filter : its reference, phase and axis. A figure is a relative difference of RMSE, unless "
      "another quantity is named, ± 95 % by paired runs, together for all figures of a sentence. It is the least "
      "favourable one, against the correct IMM; \"sure\" counts the figures that are where the sentence wants them.)");
  for (const Preset preset : both_presets) {
    const HeatMap map = overview_of(conditions, names_of(conditions), preset);
    result.add(table_of(map), {.heading = map.title + ", mean over axes and phases",
                               .summary = {"over_measurement", name_of(preset)}});
  }
  result.say("(Filters whose names end with 5 have sigma_w = 5.)");
  result.add(readings, {.printed = false, .title = each_reading, .note = "(yes): only against the released IMM."});
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
    auto all = conditions(options->runs, options->seed);
    if (run(*options, all)) report(*options, all);
  });
}

}  // namespace sigmax::apps
