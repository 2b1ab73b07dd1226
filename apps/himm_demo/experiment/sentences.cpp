#include "himm_demo/experiment/sentences.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace sigmax::apps {
namespace {

using Phases = std::vector<std::size_t>;
using Statements = std::vector<Statement>;

const Phases earlier = {0}, meanwhile = {1}, afterwards = {2}, quiet = {0, 2}, always = {0, 1, 2};
constexpr Region below_zero{.below = 0.0}, above_zero{.above = 0.0};
constexpr Region competitive{-competitive_fraction, competitive_fraction}, close{-close_fraction, close_fraction};

Statement error(int scenario, int group, const Phases& phases, Region region, Actor of = Actor::himm,
                Actor against = Actor::imm) {
  return {FigureOf::rmse, of, against, scenario, group, phases, region};
}

Statement figure(FigureOf what, Actor of, int scenario, int group, const Phases& phases, Region region,
                 Actor against = Actor::nobody) {
  return {what, of, against, scenario, group, phases, region};
}

Statements joined(std::initializer_list<Statements> parts) {
  Statements all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// "Good filtering effects": both filters have less error than the measurement.
Statements both_filter(int scenario, int group) {
  return {error(scenario, group, always, below_zero, Actor::himm, Actor::measurement),
          error(scenario, group, always, below_zero, Actor::imm, Actor::measurement)};
}

/// Model switches are observed if the lead changes at least once a run, and have disappeared if it does not.
Statements both_switch(int scenario, int group, Region region = {.above = 1.0}) {
  return {figure(FigureOf::switches_of_the_run, Actor::himm, scenario, group, always, region),
          figure(FigureOf::switches_of_the_run, Actor::imm, scenario, group, always, region)};
}

/// "Always": in more than 19 samples out of 20.
Statements each_keeps_its_model(int scenario) {
  return {figure(FigureOf::lead, Actor::imm, scenario, 4, always, {.below = 0.05}),
          figure(FigureOf::lead, Actor::himm, scenario, 4, always, {.above = 0.95})};
}

std::vector<Sentence> of_group_1() {
  using enum FigureOf;
  using enum Actor;
  return {{"VI.D 1/1",
           "the HIMM has significantly better performance in all axes, whenever the target is maneuvering or not",
           {error(1, 1, always, below_zero)}},
          {"VI.D 1/1",
           "The estimation errors of the z axis arise at the 81st sample",
           {figure(onset_rmse, himm, 1, 1, {}, above_zero), figure(onset_rmse, imm, 1, 1, {}, above_zero)}},
          {"VI.D 1/1", "the HIMM has a larger model noise", {figure(lead, himm, 1, 1, quiet, above_zero, imm)}},
          {"VI.D 1/1",
           "but with a faster response to the mode switch",
           {figure(cross_time, himm, 1, 1, {}, below_zero, imm)}},
          {"VI.D 1/1",
           "The average cross-times … are the 83.77th scan and the 85.92th scan (here: of the averaged curves, within "
           "half a scan)",
           {figure(cross_time_curves, himm, 1, 1, {}, {83.27, 84.27}),
            figure(cross_time_curves, imm, 1, 1, {}, {85.42, 86.42})}},
          {"VI.D 2/1", "The HIMM is better before and by the end of the maneuvering", {error(2, 1, quiet, below_zero)}},
          {"VI.D 2/1", "During the maneuvering the IMM is slightly better", {error(2, 1, meanwhile, above_zero)}},
          {"VI.D 2/1",
           "the HIMM responds slightly faster to the mode switch",
           {figure(cross_time, himm, 2, 1, {}, below_zero, imm)}},
          {"VI.D 2/1",
           "(31.88: 32.28) (of the averaged curves again)",
           {figure(cross_time_curves, himm, 2, 1, {}, {31.38, 32.38}),
            figure(cross_time_curves, imm, 2, 1, {}, {31.78, 32.78})}},
          {"VI.D 2/1",
           "5 m/s² … would slightly decrease the accuracy of the HIMM for the non-maneuvering period",
           {error(2, 1, quiet, above_zero, himm_wide, himm)}},
          {"VI.D 2/1",
           "and we observed that the HIMM outperforms the IMM (here: during the maneuvering)",
           {error(2, 1, meanwhile, below_zero, himm_wide, imm)}}};
}

std::vector<Sentence> of_groups_2_and_3() {
  using enum FigureOf;
  using enum Actor;
  return {{"VI.D 1/2",
           "the HIMM is significantly better before and by the end of the maneuvering",
           {error(1, 2, quiet, below_zero)}},
          {"VI.D 1/2",
           "During the maneuvering, the HIMM and the IMM are competitive",
           {error(1, 2, meanwhile, competitive)}},
          {"VI.D 2/2", "before the maneuvering, the HIMM is better", {error(2, 2, earlier, below_zero)}},
          {"VI.D 2/2", "During the maneuvering, the IMM is better", {error(2, 2, meanwhile, above_zero)}},
          {"VI.D 2/2", "By the end of the maneuvering, they are competitive", {error(2, 2, afterwards, competitive)}},
          {"VI.D */2", "the two algorithms run stably with good filtering effects and model switches observed",
           joined({both_filter(1, 2), both_switch(1, 2), both_filter(2, 2), both_switch(2, 2)})},
          {"VI.D */3", "the two algorithms run stably with good filtering effects and model switches observed",
           joined({both_filter(1, 3), both_switch(1, 3), both_filter(2, 3), both_switch(2, 3)})},
          {"VI.D */3",
           "The HIMM is better before the maneuvering",
           {error(1, 3, earlier, below_zero), error(2, 3, earlier, below_zero)}},
          {"VI.D */3",
           "and significantly worse during the maneuvering",
           {error(1, 3, meanwhile, above_zero), error(2, 3, meanwhile, above_zero)}},
          {"VI.D 1/3",
           "By the end of the maneuvering, the HIMM is better than the IMM",
           {error(1, 3, afterwards, below_zero)}},
          {"VI.D 2/3", "or competitive with the IMM", {error(2, 3, afterwards, competitive)}},
          {"VI.D */3",
           "During the maneuvering, models of the HIMM switch frequently (here: more often than the IMM's)",
           {figure(switches, himm, 1, 3, meanwhile, above_zero, imm),
            figure(switches, himm, 2, 3, meanwhile, above_zero, imm)}}};
}

std::vector<Sentence> of_group_4() {
  using enum FigureOf;
  using enum Actor;
  return {
      {"VI.D 1/4", "Model switches disappeared and the IMM always identifies … DWNA … whereas the HIMM … DWPA",
       joined({each_keeps_its_model(1), both_switch(1, 4, {.below = 1.0})})},
      {"VI.D 1/4", "The overall performances of the two methods are competitive", {error(1, 4, always, competitive)}},
      {"VI.D 1/4",
       "Once the maneuvering starts, the estimation error of the IMM filter would approach the measurement error",
       {error(1, 4, meanwhile, competitive, imm, measurement)}},
      {"VI.D 2/4", "model switches disappeared as well. The IMM/HIMM always identifies the mode as DWNA/DWPA",
       joined({each_keeps_its_model(2), both_switch(2, 4, {.below = 1.0})})},
      {"VI.D 2/4", "Before the maneuvering, the IMM is better", {error(2, 4, earlier, above_zero)}},
      {"VI.D 2/4", "During the maneuvering, the HIMM is better", {error(2, 4, meanwhile, below_zero)}},
      {"VI.D 2/4", "By the end of maneuvering, they are competitive", {error(2, 4, afterwards, competitive)}}};
}

std::vector<Sentence> of_the_discussion() {
  Sentence good{"VI.E", "Groups 2~4: both methods exhibit robust performance and good filtering effects", {}};
  Sentence level{"VI.E", "Groups 2~4: The two methods are generally competitive", {}};
  Sentence output{"VI.E",
                  "a variation of the IMM, which outputs … the largest model probability …, has a very close "
                  "performance (here: within 5 %)",
                  {}};
  for (const int scenario : {1, 2})
    for (const int group : {1, 2, 3, 4}) {
      output.statements.push_back(error(scenario, group, always, close, Actor::imm_most_likely, Actor::imm));
      if (group == 1) continue;
      for (const auto& statement : both_filter(scenario, group)) good.statements.push_back(statement);
      level.statements.push_back(error(scenario, group, always, competitive));
    }
  return {{"VI.E",
           "Group 1: the HIMM filter has significantly better performance than the classic IMM filter",
           {error(1, 1, always, below_zero), error(2, 1, always, below_zero)}},
          std::move(good),
          std::move(level),
          std::move(output)};
}

/// Whether the paper has such a filter.
bool in_the_paper(const FilterSettings& filter) {
  return filter.scheme == Scheme::interacting && !filter.smooth && filter.sojourn_s.empty() &&
         filter.radar_measurement == RadarForm::standard;
}

/// Whether both ends are closed.
bool bounded(const Region& region) { return std::isfinite(region.above) && std::isfinite(region.below); }

}  // namespace

Finding finding_of(const Interval& interval, const Region& region) {
  if (interval.lower() > region.above && interval.upper() < region.below) return Finding::inside;
  if (interval.upper() < region.above || interval.lower() > region.below) return Finding::outside;
  return Finding::open;
}

const std::vector<Sentence>& sentences() {
  static const std::vector<Sentence> all = [] {
    std::vector<Sentence> result = of_group_1();
    for (const auto& part : {of_groups_2_and_3(), of_group_4(), of_the_discussion()})
      result.insert(result.end(), part.begin(), part.end());
    return result;
  }();
  return all;
}

Region claim_of(int scenario, int group, std::size_t phase) {
  for (const auto& sentence : sentences())
    for (const auto& statement : sentence.statements) {
      const auto& phases = statement.phases;
      if (statement.figure == FigureOf::rmse && statement.of == Actor::himm && statement.against == Actor::imm &&
          statement.scenario == scenario && statement.group == group &&
          std::ranges::find(phases, phase) != phases.end())
        return statement.region;
    }
  throw std::logic_error("the paper says nothing of this phase");
}

std::string_view word_of(const Region& claim) {
  return bounded(claim) ? "competitive" : std::isfinite(claim.below) ? "better" : "worse";
}

std::string verdict(const Region& claim, const std::array<Interval, 3>& difference,
                    const std::array<double, 3>& reference) {
  int axes_that_hold = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Region region{claim.above * reference[axis], claim.below * reference[axis]};
    const Interval found = bounded(claim) ? Interval{difference[axis].mean, 0.0} : difference[axis];
    if (finding_of(found, region) == Finding::inside) ++axes_that_hold;
  }
  return axes_that_hold == 3   ? "holds"
         : axes_that_hold == 0 ? "does NOT hold"
                               : fmt::format("holds on {} of 3 axes", axes_that_hold);
}

bool judged(const FilterSettings& filter, const FilterSettings& reference) {
  return filter.fuzzy && !reference.fuzzy && in_the_paper(filter) && in_the_paper(reference);
}

std::optional<double> paper_cross_time(int scenario, int group, const FilterSettings& filter) {
  constexpr double times[2][2] = {{85.92, 83.77}, {32.28, 31.88}};  // by scenario; IMM and HIMM, in group 1
  if (group != 1 || !in_the_paper(filter)) return std::nullopt;
  return times[scenario - 1][filter.fuzzy ? 1 : 0];
}

}  // namespace sigmax::apps
