#include "himm_demo/sweep_page.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace sigmax::apps {
namespace {

constexpr std::size_t most_rows = 300;  // of a table in the page

std::vector<ResultColumn> filter_columns() {
  return {{.key = "filter", .header = "filter", .align = Align::left},
          {.key = "leaving", .header = "leaving", .digits = 3, .sized = true},
          {.key = "returning", .header = "returning", .digits = 3, .sized = true},
          {.key = "sigma_w_dwna", .header = "dwna", .sized = true, .group = "σ_w, m/s²:"},
          {.key = "sigma_w_dwpa", .header = "dwpa", .sized = true, .group = "σ_w, m/s²:"},
          {.key = "lift", .header = "lift", .align = Align::left},
          {.key = "at_the_limit"},
          {.key = "settings_tried"},
          {.key = "tuning_score", .header = "tuning", .digits = 3, .group = "score:"},
          {.key = "score", .header = "judged", .digits = 3, .interval = true, .group = "score:"},
          {.key = "above_imm", .header = "% above imm", .digits = 1, .scale = 100.0, .interval = true},
          {.key = "is_himm"}};
}

void add_filters(const Findings& findings, std::size_t c, const std::vector<Cell>& first, ResultTable& table) {
  for (std::size_t f = 0; f < findings.filters(); ++f) {
    const Tuned& tuned = findings.tuned[c][f];
    const FilterSettings settings = findings.settings(c, f);
    const auto sigma_w = [&](std::size_t model) { return settings.motions[model][MotionParameter::sigma_w]; };
    std::vector<Cell> cells = first;
    for (const Cell& cell : std::initializer_list<Cell>{
             settings.name, settings.transition[0][1], settings.transition[1][0], sigma_w(0), sigma_w(1),
             name_of(settings.lift), findings.at_the_limit(c, f) ? 1 : 0, tuned.best.tried, tuned.best.score,
             tuned.score.interval(), findings.imm ? Cell(findings.against_imm(c, f)) : Cell(),
             findings.himm(c) == f ? 1 : 0})
      cells.push_back(cell);
    table.row(std::move(cells));
  }
}

/// What a cell of the map says beside its number.
std::string words_of(const Findings& findings, std::size_t c, std::size_t f) {
  const FilterSettings settings = findings.settings(c, f);
  const Interval above = findings.against_imm(c, f), score = findings.tuned[c][f].score.interval();
  return fmt::format("± {} %, score {} ± {}; {}: leaving {}, returning {}, sigma_w {} and {}, lift {}{}",
                     number_text(100.0 * above.half_width, 1), number_text(score.mean, 3),
                     number_text(score.half_width, 3), settings.name, settings.transition[0][1],
                     settings.transition[1][0], settings.motions[0][MotionParameter::sigma_w],
                     settings.motions[1][MotionParameter::sigma_w], name_of(settings.lift),
                     findings.at_the_limit(c, f) ? ", at the limit of the search" : "");
}

/// Makes the maps; a column or a view stands for a filter, or for HIMM, which is another one in each condition.
class Maps {
 public:
  explicit Maps(const Findings& findings) : findings_(findings) {
    if (findings.himm(0)) choices_.push_back({"HIMM", [&](std::size_t c) { return *findings.himm(c); }});
    for (std::size_t f = 0; f < findings.filters(); ++f)
      if (f != findings.imm) choices_.push_back({findings.world.filters()[f].name, [f](std::size_t) { return f; }});
    std::vector<double> sizes;
    for (std::size_t c = 0; c < findings.conditions(); ++c)
      sizes.push_back(std::abs(findings.against_imm(c, choices_.front().of(c)).mean));
    std::sort(sizes.begin(), sizes.end());
    most_ = sizes[sizes.size() * 19 / 20];
  }

  /// Conditions by filters, a map for each scenario.
  std::vector<Panel> of_all_filters() const {
    std::vector<Panel> panels;
    for (const int scenario : findings_.world.choice().scenarios) {
      HeatMap map = empty(fmt::format("Scenario {}", scenario), "condition", "filter");
      for (const auto& choice : choices_) map.columns.push_back(choice.name);
      for (std::size_t c = 0; c < findings_.conditions(); ++c) {
        const SweepCondition& condition = findings_.world.conditions()[c];
        if (condition.scenario != scenario) continue;
        const std::string words = apps::words_of(condition);
        add_row(map, words.size() > 3 ? words.substr(3) : "as in the paper");
        for (const auto& choice : choices_) add_cell(map, c, choice.of(c));
      }
      panels.emplace_back(std::move(map));
    }
    return panels;
  }

  /// All conditions of a scenario: strength and length by noise and period.
  std::vector<View> of_each_filter() const {
    std::vector<View> views;
    for (const auto& choice : choices_) {
      View& view = views.emplace_back(View{choice.name, {}});
      for (const int scenario : findings_.world.choice().scenarios) view.panels.emplace_back(crossed(choice, scenario));
    }
    return views;
  }

 private:
  struct Choice {
    std::string name;
    std::function<std::size_t(std::size_t condition)> of;
  };

  HeatMap empty(std::string title, std::string row_label, std::string column_label) const {
    HeatMap map{.title = std::move(title),
                .row_label = std::move(row_label),
                .column_label = std::move(column_label),
                .rows = {},
                .columns = {},
                .values = {},
                .value_label = "% above the score of the tuned IMM",
                .diverging = true,
                .digits = 1,
                .scale = 100.0,
                .sign = true,
                .most = most_};
    map.note =
        fmt::format("Negative is better. *: the interval is on one side of 0. Colours are strongest from ± {} % on.",
                    number_text(100.0 * most_, 1));
    return map;
  }

  static void add_row(HeatMap& map, std::string name) {
    map.rows.push_back(std::move(name));
    map.values.emplace_back();
    map.texts.emplace_back();
    map.marked.emplace_back();
  }

  void add_cell(HeatMap& map, std::size_t c, std::size_t f) const {
    const Interval above = findings_.against_imm(c, f);
    map.values.back().push_back(above.mean);
    map.marked.back().push_back(sure(above));
    map.texts.back().push_back(words_of(findings_, c, f));
  }

  HeatMap crossed(const Choice& choice, int scenario) const {
    const SweepChoice& factors = findings_.world.choice();
    HeatMap map = empty(fmt::format("{}, scenario {}", choice.name, scenario), "strength, length of the manoeuvre",
                        "noise, period");
    const auto name = [](double first, double second) { return fmt::format("×{:g}, ×{:g}", first, second); };
    for (const double mismatch : factors.mismatch)
      for (const double period : factors.period) map.columns.push_back(name(mismatch, period));
    for (const double strength : factors.strength)
      for (const double length : factors.length) {
        add_row(map, name(strength, length));
        for (const double mismatch : factors.mismatch)
          for (const double period : factors.period) {
            const auto& all = findings_.world.conditions();
            const auto at =
                std::find(all.begin(), all.end(), SweepCondition{scenario, mismatch, period, strength, length});
            const auto c = static_cast<std::size_t>(at - all.begin());
            add_cell(map, c, choice.of(c));
          }
      }
    return map;
  }

  const Findings& findings_;
  std::vector<Choice> choices_;
  double most_ = 0.0;
};

}  // namespace

ResultTable tuned_table(const Findings& findings) {
  std::vector<ResultColumn> columns = {
      {.key = "scenario"}, {.key = "noise"}, {.key = "period"}, {.key = "strength"}, {.key = "length"}};
  const auto own = filter_columns();
  columns.insert(columns.end(), own.begin(), own.end());
  ResultTable table(columns);
  for (std::size_t c = 0; c < findings.conditions(); ++c) {
    const SweepCondition& condition = findings.world.conditions()[c];
    add_filters(findings, c,
                {condition.scenario, condition.mismatch, condition.period, condition.strength, condition.length},
                table);
  }
  return table;
}

ResultTable tuned_table(const Findings& findings, std::size_t condition) {
  ResultTable table(filter_columns());
  add_filters(findings, condition, {}, table);
  return table;
}

namespace {

/// The same for people.
ReportTable best_settings(const Findings& findings) {
  std::vector<ResultColumn> columns = filter_columns();
  columns.insert(columns.begin(), {.key = "condition", .header = "scenario", .align = Align::left});
  ResultTable table(columns);
  for (std::size_t c = 0; c < findings.conditions(); ++c)
    add_filters(findings, c, {words_of(findings.world.conditions()[c])}, table);
  return {.title = "The best settings", .table = table, .filtered_by = {"condition", "filter"}};
}

}  // namespace

Report page_of(const SweepOptions& options, const Findings& findings) {
  Report page{.title = "Every filter at its best settings, against the tuned IMM", .command = options.output.command};
  if (findings.imm && findings.himm(0)) page.verdict.push_back(answer(findings));
  if (const std::string stopped = limits(findings); !stopped.empty()) page.verdict.push_back(stopped);
  page.verdict.push_back(searched(findings) +
                         ". The score is the mean over axes and phases of RMSE over that of the measurement.");
  if (findings.imm && findings.filters() > 1) {
    const Maps maps(findings);
    if (options.choice.cross) {
      page.chooser = "Filter";
      page.views = maps.of_each_filter();
    } else {
      page.panels = maps.of_all_filters();
    }
  }
  if (findings.conditions() * findings.filters() <= most_rows)
    page.last.emplace_back(best_settings(findings));
  else
    page.verdict.emplace_back("The best settings of every filter are in tuned.csv, and in each cell of the maps.");
  return page;
}

}  // namespace sigmax::apps
