#include "himm_demo/paper_claims.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace sigmax::apps {
namespace {

/// IMM and HIMM, by scenario, in group 1.
constexpr std::array<std::array<double, 2>, 2> paper_cross_times = {{{85.92, 83.77}, {32.28, 31.88}}};

/// Whether the paper has such a filter.
bool in_the_paper(const FilterSettings& filter) {
  return filter.scheme == Scheme::interacting && !filter.smooth && filter.sojourn_s.empty() &&
         filter.radar_measurement == RadarForm::standard;
}

}  // namespace

std::string_view word(Claim claim) {
  return claim == Claim::better ? "better" : claim == Claim::worse ? "worse" : "competitive";
}

Claim claim_of(int scenario, int group, std::size_t phase) {
  for (const auto& sentence : sentences())
    for (const auto& statement : sentence.statements) {
      const auto& phases = statement.phases;
      if (statement.figure != FigureOf::rmse || statement.of != Actor::himm || statement.against != Actor::imm ||
          statement.scenario != scenario || statement.group != group ||
          std::find(phases.begin(), phases.end(), phase) == phases.end())
        continue;
      if (std::isfinite(statement.region.above) && std::isfinite(statement.region.below)) return Claim::competitive;
      return std::isfinite(statement.region.below) ? Claim::better : Claim::worse;
    }
  throw std::logic_error("the paper says nothing of this phase");
}

std::optional<double> paper_cross_time(int scenario, int group, const FilterSettings& filter) {
  if (group != 1 || !in_the_paper(filter)) return std::nullopt;
  return paper_cross_times[static_cast<std::size_t>(scenario - 1)][filter.fuzzy ? 1 : 0];
}

bool judged(const FilterSettings& filter, const FilterSettings& reference) {
  return filter.fuzzy && !reference.fuzzy && in_the_paper(filter) && in_the_paper(reference);
}

std::string verdict(Claim claim, const std::array<Interval, 3>& difference, const std::array<double, 3>& reference) {
  const auto count = [&](auto holds) { return std::count_if(difference.begin(), difference.end(), holds); };
  long axes_that_hold = 0;
  if (claim == Claim::better) axes_that_hold = count([](const Interval& d) { return d.below_zero(); });
  if (claim == Claim::worse) axes_that_hold = count([](const Interval& d) { return d.above_zero(); });
  if (claim == Claim::competitive)
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (std::abs(difference[axis].mean) <= competitive_fraction * reference[axis]) ++axes_that_hold;
  return axes_that_hold == 3   ? "holds"
         : axes_that_hold == 0 ? "does NOT hold"
                               : fmt::format("holds on {} of 3 axes", axes_that_hold);
}

}  // namespace sigmax::apps
