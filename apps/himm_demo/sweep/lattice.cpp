#include "himm_demo/sweep/lattice.hpp"

#include <algorithm>
#include <limits>
#include <set>
#include <string>

#include <fmt/format.h>

namespace sigmax::apps {
namespace {

using Place = SweepLattice::Place;

/// So that what a table says can be given again.
double in_six_digits(double value) { return std::stod(fmt::format("{:.6g}", value)); }

}  // namespace

Axis continued(const AxisRange& range, int steps) {
  const auto& list = range.list;
  Axis axis{.numbers = list, .last = list.size() - 1};
  if (list.size() == 1) return axis;
  auto& numbers = axis.numbers;
  const double down = list[0] / list[1], up = list.back() / list[list.size() - 2];
  for (int i = 0; i < steps && numbers.back() < range.greatest; ++i)
    numbers.push_back(std::min(in_six_digits(numbers.back() * up), range.greatest));
  for (int i = 0; i < steps && numbers.front() > range.least; ++i, ++axis.first, ++axis.last)
    numbers.insert(numbers.begin(), std::max(in_six_digits(numbers.front() * down), range.least));
  axis.more_below = numbers.front() > range.least;
  axis.more_above = numbers.back() < range.greatest;
  return axis;
}

SweepLattice::SweepLattice(const std::array<AxisRange, axes>& ranges, std::size_t lifts, int beyond) : lifts_(lifts) {
  std::transform(ranges.begin(), ranges.end(), axes_.begin(),
                 [&](const AxisRange& range) { return continued(range, beyond); });
}

std::vector<Place> SweepLattice::grid() const {
  std::vector<Place> all = {Place{}};
  const auto combine = [&](std::size_t axis, std::size_t first, std::size_t last) {
    std::vector<Place> more;
    for (Place place : all)
      for (place[axis] = first; place[axis] <= last; ++place[axis]) more.push_back(place);
    all = std::move(more);
  };
  for (std::size_t axis = 0; axis < axes; ++axis) combine(axis, axes_[axis].first, axes_[axis].last);
  combine(axes, 0, lifts_ - 1);
  return all;
}

std::vector<Place> SweepLattice::neighbours(const Place& place) const {
  std::vector<Place> all;
  const auto add = [&](std::size_t axis, std::size_t at) {
    all.push_back(place);
    all.back()[axis] = at;
  };
  for (std::size_t axis = 0; axis < axes; ++axis) {
    if (place[axis] > 0) add(axis, place[axis] - 1);
    if (place[axis] + 1 < axes_[axis].numbers.size()) add(axis, place[axis] + 1);
  }
  for (std::size_t lift = 0; lift < lifts_; ++lift)
    if (lift != place[axes]) add(axes, lift);
  return all;
}

bool SweepLattice::at_the_limit(const Place& place) const {
  for (std::size_t i = 0; i < axes; ++i)  // a lift has no order
    if ((place[i] == 0 && axes_[i].more_below) || (place[i] + 1 == axes_[i].numbers.size() && axes_[i].more_above))
      return true;
  return false;
}

BestPlace search(const SweepLattice& lattice, const ScoresOf& scores_of) {
  std::set<Place> tried;
  BestPlace best{.place = {}, .score = std::numeric_limits<double>::infinity(), .tried = 0};
  for (auto places = lattice.grid(); !places.empty();) {
    const auto scores = scores_of(places);
    tried.insert(places.begin(), places.end());
    const auto least = std::min_element(scores.begin(), scores.end());
    const auto place = places[static_cast<std::size_t>(least - scores.begin())];
    if (best.tried > 0 && *least >= best.score) break;
    best = {place, *least, tried.size()};
    places = lattice.neighbours(place);
    std::erase_if(places, [&](const Place& one) { return tried.contains(one); });
  }
  best.tried = tried.size();
  return best;
}

}  // namespace sigmax::apps
