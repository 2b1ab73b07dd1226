#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "himm_demo/sweep.hpp"
#include "himm_demo/sweep_page.hpp"
#include "support/result_files.hpp"
#include "support/table.hpp"

namespace sigmax::apps {
namespace {

/// The figure with a mark that the interval is on one side of zero.
std::string marked(const Interval& interval) {
  return number_text(100.0 * interval.mean, 1, true) + (sure(interval) ? "*" : " ");
}

/// The score of the tuned IMM, and by how much the others are above it.
ResultTable map_for_people(const Findings& findings) {
  std::vector<ResultColumn> columns = {{.header = "scenario", .align = Align::left}, {.header = "imm", .digits = 3}};
  for (const auto& filter : findings.world.filters())
    if (filter.name != "imm") columns.push_back({.header = filter.name, .group = "% above imm:"});
  columns.push_back({.header = "himm", .group = "% above imm:"});
  ResultTable table(columns);
  for (std::size_t c = 0; c < findings.conditions(); ++c) {
    std::vector<Cell> cells = {words_of(findings.world.conditions()[c]),
                               findings.tuned[c][*findings.imm].score.value()};
    for (std::size_t f = 0; f < findings.filters(); ++f)
      if (f != *findings.imm) cells.emplace_back(marked(findings.against_imm(c, f)));
    cells.emplace_back();
    if (const auto himm = findings.himm(c)) cells.back() = marked(findings.against_imm(c, *himm));
    table.row(std::move(cells));
  }
  return table;
}

}  // namespace

void report(const SweepOptions& options, const SweepWorld& world, const CellRows& rows) {
  ResultFiles files(options.output);
  const Findings findings = findings_of(world, rows);
  const std::size_t width = options.output.width();
  const auto note = [&](const std::string& text) { fmt::print("{}", wrapped(text, width)); };
  note(searched(findings));
  if (findings.imm) {
    fmt::print("\n");
    map_for_people(findings).print(width);
    note(
        "(imm: mean over axes and phases of RMSE over that of the measurement. *: the 95 % interval, by paired runs "
        "and together for all conditions, is on one side of 0. Negative is better.)");
    fmt::print("\n");
    if (findings.himm(0)) note(answer(findings));
  }
  if (const std::string stopped = limits(findings); !stopped.empty()) note(stopped);
  if (files.wanted()) {
    files.write("tuned.csv", tuned_table(findings).csv());
    auto summary = summary_of(options.output);
    summary["campaign"] = world.campaign().description;
    summary["searched"] = searched(findings);
    if (findings.imm && findings.himm(0)) summary["answer"] = answer(findings);
    for (std::size_t c = 0; c < findings.conditions(); ++c)
      summary["conditions"][words_of(world.conditions()[c])] = tuned_table(findings, c).json();
    if (files.report_wanted()) summary["report_data"] = report_data_name;
    files.write_json("summary.json", summary);
  }
  if (files.report_wanted()) files.write_report(page_of(options, findings));
  files.commit();
}

}  // namespace sigmax::apps
