#include "himm_demo/tune_report.hpp"

#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "himm_demo/filter_keys.hpp"
#include "result/table.hpp"
#include "support/error.hpp"

namespace sigmax::apps {
namespace {

void add_part(TextTable& table, const Diagnosis::Part& part, const std::string& last, bool weight) {
  const auto& tally = part.innovations;
  std::vector<std::string> cells = {part.name, fmt::format("{}", tally.rows())};
  if (tally.rows() == 0) {
    cells.insert(cells.end(), {"–", "–"});
  } else {
    const Band band = tally.band();
    cells.push_back(fmt::format("{:.3g}", tally.mean_square()));
    cells.push_back(fmt::format("{:.2f}–{:.2f}", band.lower, band.upper));
  }
  if (weight) {
    cells.push_back(fmt::format("{:.3f}", part.weight));
  } else {
    cells.push_back(fmt::format("{:+.2f}", tally.autocorrelation()));
    cells.push_back(fmt::format("±{:.2f}", tally.autocorrelation_band()));
    cells.push_back(last);
  }
  table.row(std::move(cells));
}

/// A key's value, or that there is none.
std::string shown(const std::string& value) { return value.empty() ? "–" : value; }

}  // namespace

std::string text_of(const Diagnosis& diagnosis, std::size_t width) {
  TextTable sensors(
      {{"sensor", Align::left}, {"rows"}, {"NIS"}, {"right"}, {"neighbours"}, {"right"}, {"verdict", Align::left}});
  for (const auto& sensor : diagnosis.sensors) add_part(sensors, sensor, Diagnosis::verdict(sensor.innovations), false);
  TextTable modes({{"mode", Align::left}, {"rows"}, {"NIS"}, {"right"}, {"mean weight"}});
  for (const auto& mode : diagnosis.modes) add_part(modes, mode, "", true);
  std::string text = sensors.text(width) + "\n" + modes.text(width);
  for (const auto& sentence : diagnosis.advice())
    for (std::size_t line = 0;
         const auto& each : lines_of(printable(sentence), width == any_width ? any_width : width - 2))
      text += (line++ == 0 ? "- " : "  ") + each + "\n";
  return text;
}

std::string text_of(const TunedFilter& tuned, Objective objective, std::size_t width) {
  const auto of = objective == Objective::rmse ? "RMSE, m" : "nats a row";
  TextTable table({{"models", Align::left},
                   {"fitted numbers"},
                   {fmt::format("fitted, {}", of)},
                   {fmt::format("held out, {}", of)},
                   {objective == Objective::rmse ? "gain, m²" : "gain held out"},
                   {"", Align::left}});
  for (std::size_t c = 0; c < tuned.candidates.size(); ++c) {
    const Candidate& candidate = tuned.candidates[c];
    table.row({candidate.name, fmt::format("{}", candidate.numbers),
               fmt::format("{:.4g}", figure_of(candidate.fitted, objective)),
               fmt::format("{:.4g}", figure_of(candidate.held_out, objective)),
               c == 0 ? "" : fmt::format("{:+.3g} ± {:.2g}", candidate.gain, candidate.gain_error),
               remark_of(tuned, c)});
  }
  return table.text(width);
}

std::string remark_of(const TunedFilter& tuned, std::size_t candidate) {
  std::string remark = candidate == tuned.best ? "best" : "";
  if (candidate == tuned.simple) remark += remark.empty() ? "simple" : ", simple";
  return remark;
}

std::vector<Change> changes(const TunedFilter& tuned) {
  const FilterSettings& before = tuned.candidates[0].settings;
  const FilterSettings& best = tuned.candidates[tuned.best].settings;
  const FilterSettings& simple = tuned.candidates[tuned.simple].settings;
  std::vector<Change> all;
  const auto add = [&](const std::string& name, const std::string& a, const std::string& b, const std::string& c) {
    if (a != b || a != c) all.push_back({name, shown(a), shown(b), shown(c)});
  };
  for (const auto& key : filter_keys()) {
    const auto value = [&](const FilterSettings& settings) { return key.applies(settings) ? key.write(settings) : ""; };
    add(key.name, value(before), value(best), value(simple));
  }
  std::set<std::string, std::less<>> sensors;
  for (const auto* settings : {&before, &best, &simple})
    for (const auto& [name, accuracy] : settings->sensors) sensors.insert(name);
  for (const auto& key : accuracy_keys()) {
    add(key.name, key.write(before.accuracy), key.write(best.accuracy), key.write(simple.accuracy));
    for (const auto& sensor : sensors)
      add(fmt::format("sensor.{}.{}", sensor, key.name), key.write(before.accuracy_of(sensor)),
          key.write(best.accuracy_of(sensor)), key.write(simple.accuracy_of(sensor)));
  }
  return all;
}

std::string changes_of(const TunedFilter& tuned, std::size_t width) {
  const bool two = tuned.simple != tuned.best;
  std::vector<TextTable::Column> columns = {{"key", Align::left}, {"before", Align::left}, {"best", Align::left}};
  if (two) columns.push_back({"simple", Align::left});
  TextTable table(columns);
  const auto all = changes(tuned);
  for (const Change& change : all) {
    std::vector<std::string> cells = {change.key, change.before, change.best};
    if (two) cells.push_back(change.simple);
    table.row(std::move(cells));
  }
  return all.empty() ? "No setting changes.\n" : table.text(width);
}

}  // namespace sigmax::apps
