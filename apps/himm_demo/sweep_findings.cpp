#include "himm_demo/sweep_findings.hpp"

#include <fmt/format.h>

#include "support/result_table.hpp"

namespace sigmax::apps {

std::optional<std::size_t> Findings::himm(std::size_t condition) const {
  std::optional<std::size_t> best;
  for (std::size_t f = 0; f < filters(); ++f)
    if (is_himm(f) && (!best || tuned[condition][f].best.score < tuned[condition][*best].best.score)) best = f;
  return best;
}

bool Findings::is_himm(std::size_t f) const {
  return world.filters()[f].fuzzy && world.filters()[f].scheme == Scheme::interacting;
}

Interval Findings::against_imm(std::size_t condition, std::size_t f) const {
  return (tuned[condition][f].score / tuned[condition][*imm].score - 1.0).interval(conditions());
}

FilterSettings Findings::settings(std::size_t condition, std::size_t f) const {
  return world.settings(f, condition, tuned[condition][f].best.place);
}

bool Findings::at_the_limit(std::size_t condition, std::size_t f) const {
  return world.lattice(f).at_the_limit(tuned[condition][f].best.place);
}

Findings findings_of(const SweepWorld& world, const CellRows& rows) {
  Findings findings{world, {}, {}};
  for (std::size_t c = 0; c < world.conditions().size(); ++c) {
    auto& tuned = findings.tuned.emplace_back();
    for (std::size_t f = 0; f < world.filters().size(); ++f) tuned.push_back(world.tuned(rows, c, f));
  }
  for (std::size_t f = 0; f < world.filters().size(); ++f)
    if (world.filters()[f].name == "imm") findings.imm = f;
  return findings;
}

std::string words_of(const SweepCondition& condition) {
  std::string text = fmt::format("{}", condition.scenario);
  const auto add = [&](const char* name, double factor) {
    if (factor != 1.0) text += fmt::format(", {} ×{:g}", name, factor);
  };
  add("noise", condition.mismatch);
  add("period", condition.period);
  add("strength", condition.strength);
  add("length", condition.length);
  return text;
}

const char* name_of(Lift lift) {
  return lift == Lift::zero ? "zero" : lift == Lift::unbiased ? "unbiased" : "borrowed_variance";
}

std::string answer(const Findings& findings) {
  std::size_t better = 0, worse = 0, open = 0;
  std::size_t best = 0;
  for (std::size_t c = 0; c < findings.conditions(); ++c) {
    const Interval difference = findings.against_imm(c, *findings.himm(c));
    ++(difference.below_zero() ? better : difference.above_zero() ? worse : open);
    if (difference.mean < findings.against_imm(best, *findings.himm(best)).mean) best = c;
  }
  const Interval most = findings.against_imm(best, *findings.himm(best));
  return fmt::format(
      "HIMM is better than the tuned IMM in {} of {} conditions, worse in {}, and {} are open. At best its score "
      "differs "
      "by {} ± {} %: scenario {}. HIMM is what did best on the tuning runs under any reading of (57).",
      better, findings.conditions(), worse, open, number_text(100.0 * most.mean, 1, true),
      number_text(100.0 * most.half_width, 1), words_of(findings.world.conditions()[best]));
}

std::string searched(const Findings& findings) {
  const SweepChoice& choice = findings.world.choice();
  std::string text =
      fmt::format("{} filters, {} settings each", findings.filters(), findings.world.lattice(0).grid().size());
  if (choice.beyond > 0) {
    std::size_t tried = 0;
    for (const auto& tuned : findings.tuned)
      for (const Tuned& one : tuned) tried += one.best.tried;
    text += fmt::format(
        " and about {} with those on the way from the best to better neighbours, up to {} steps beyond a list",
        tried / (findings.conditions() * findings.filters()), choice.beyond);
  }
  return text + fmt::format("; chosen by {} runs and judged by {} others, seed {}", choice.tuning_runs, choice.runs,
                            choice.seed);
}

std::string limits(const Findings& findings) {
  std::size_t stopped = 0;
  for (std::size_t c = 0; c < findings.conditions(); ++c)
    for (std::size_t f = 0; f < findings.filters(); ++f)
      if (findings.at_the_limit(c, f)) ++stopped;
  if (stopped == 0) return "";
  return fmt::format("{} of {} tuned filters {}: there may be better ones beyond.", stopped,
                     findings.conditions() * findings.filters(),
                     findings.world.choice().beyond == 0 ? "have a number at an end of its list"
                                                         : "stopped at the limit beyond a list");
}

}  // namespace sigmax::apps
