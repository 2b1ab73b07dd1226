#include <sigmax/estimation/trajectory_gospa.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include <boost/pending/disjoint_sets.hpp>

#include <sigmax/core/matching.hpp>

#include "points.hpp"

// Which sequences of assignments need a look? An optimal one can be changed, at no cost, until it obeys three rules:
//
//   - a pair is kept until another pair takes its target or its track: a kept pair never costs more than none;
//   - a pair begins only where its distance is below c: before, it gains nothing;
//   - if both sides never had a partner, the pair is as good as one from the first scan on, and costs no switch.
//
// So an assignment tells of each trajectory its partner, or that it never had one (fresh), or that it lost it (orphan).
// Groups of a scan that no distance below c connects do not contend for a trajectory, so they are decided one by one.

namespace sigmax {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

using Partners = std::vector<int>;  ///< of each target and track of a cluster
constexpr int orphan = -1, fresh = -2;

/// A distance below c at a scan, to the p-th power.
struct Close {
  std::size_t scan;
  int target, track;
  double cost;
};

/// Splits pairs into groups that share no trajectory; trajectories are numbers below `size`.
std::map<std::size_t, std::vector<Close>> connected(std::span<const Close> pairs, std::size_t size) {
  boost::disjoint_sets_with_storage<> sets(size);
  for (const Close& pair : pairs) sets.union_set(at(pair.target), at(pair.track));
  std::map<std::size_t, std::vector<Close>> groups;
  for (const Close& pair : pairs) groups[sets.find_set(at(pair.target))].push_back(pair);
  return groups;
}

/// A sequence of assignments: the last one, and what all cost, less what it costs to assign nothing.
struct State {
  Partners partners;
  double localisation = 0.0, cost = 0.0;
  std::size_t pairs = 0, half_switches = 0;
};

/// The best sequences of assignments so far, of trajectories that distances below c connect.
class Cluster {
 public:
  /// What a pair saves, cᵖ, and what half a switch costs, γᵖ/2.
  Cluster(std::size_t trajectories, double pair, double half_switch, std::size_t max_states)
      : pair_(pair), half_switch_(half_switch), max_states_(max_states) {
    states_.push_back({Partners(trajectories, fresh)});
  }

  /// One connected group of a scan.
  void decide(std::span<const Close> group) {
    options_.clear();
    for (const Close& pair : group) {
      if (options_.empty() || options_.back().front().target != pair.target) options_.emplace_back();
      options_.back().push_back(pair);
    }
    gains_.assign(options_.size() + 1, 0.0);
    for (std::size_t n = options_.size(); n-- > 0;)
      gains_[n] = gains_[n + 1] + pair_ - std::ranges::min(options_[n], {}, &Close::cost).cost;
    for (const State& state : states_) {
      limit_ = std::numeric_limits<double>::infinity();
      reach(likely(state));
      trials_ = 100 * max_states_ / states_.size();
      choose(0, state);
    }
    keep_what_may_win();
  }

  const State& best() const { return states_.front(); }
  bool exact() const { return exact_; }

 private:
  State with(State state, const Close& pair) const {
    auto& [partners, localisation, cost, pairs, half_switches] = state;
    localisation += pair.cost;
    ++pairs;
    if (partners[at(pair.target)] != pair.track) {
      if (partners[at(pair.target)] != fresh || partners[at(pair.track)] != fresh) ++half_switches;
      for (const int side : {pair.target, pair.track}) {
        if (partners[at(side)] < 0) continue;
        partners[at(partners[at(side)])] = orphan;
        ++half_switches;
      }
      partners[at(pair.target)] = pair.track;
      partners[at(pair.track)] = pair.target;
    }
    cost = localisation - pair_ * static_cast<double>(pairs) + half_switch_ * static_cast<double>(half_switches);
    return state;
  }

  /// What follows a state if each new pair were three half switches: often the best.
  State likely(State state) const {
    Choices savings;
    for (const auto& options : options_) {
      savings.add_row(0.0);
      for (const Close& pair : options)
        savings.add(at(pair.track),
                    pair_ - pair.cost - (state.partners[at(pair.target)] == pair.track ? 0.0 : 3.0 * half_switch_));
    }
    const auto columns = match<Fuzzy, Fuzzy>(savings, {.marginals = false}).best;
    for (std::size_t n = 0; n < columns.size(); ++n)
      for (const Close& pair : options_[n])
        if (at(pair.track) == columns[n]) state = with(std::move(state), pair);
    return state;
  }

  /// Tries all that the n-th target may do, after those before it, whose tracks are taken.
  void choose(std::size_t n, const State& state) {
    if (state.cost - gains_[n] >= limit_) return;
    if (trials_ == 0) exact_ = false;
    if (trials_ == 0) return;
    --trials_;
    if (n == options_.size()) return reach(state);
    for (const Close& pair : options_[n]) {
      if (std::ranges::count(taken_, pair.track) > 0) continue;
      taken_.push_back(pair.track);
      choose(n + 1, with(state, pair));
      taken_.pop_back();
    }
    choose(n + 1, state);
  }

  void reach(const State& state) {
    // Two assignments that follow one differ by at most six half switches a target; see `half_switches`.
    limit_ = std::min(limit_, state.cost + 6.0 * half_switch_ * static_cast<double>(options_.size()));
    const auto [place, is_new] = reached_.try_emplace(state.partners, state);
    if (!is_new && state.cost < place->second.cost) place->second = state;
  }

  /// Drops assignments that a cheaper one reaches by switches, and still is not dearer, whatever comes.
  void keep_what_may_win() {
    std::vector<const State*> by_cost;
    for (const auto& [partners, state] : reached_) by_cost.push_back(&state);
    std::ranges::stable_sort(by_cost, {}, &State::cost);
    states_.clear();
    for (const State* state : by_cost) {
      const auto beats = [&](const State& other) {
        return other.cost + half_switch_ * half_switches(other.partners, state->partners) <= state->cost;
      };
      if (std::ranges::any_of(states_, beats)) continue;
      if (states_.size() == max_states_) exact_ = false;
      if (states_.size() < max_states_) states_.push_back(*state);
    }
    reached_.clear();
  }

  /// Half switches from one assignment to another, and those that what is fresh there may save later.
  static double half_switches(const Partners& from, const Partners& to) {
    double result = 0.0;
    for (std::size_t i = 0; i < from.size(); ++i)
      if (from[i] != to[i]) result += (from[i] >= 0 ? 0.5 : 0.0) + (to[i] >= 0 ? 0.5 : to[i] == fresh ? 1.0 : 0.0);
    return result;
  }

  double pair_, half_switch_;
  std::size_t max_states_;
  bool exact_ = true;
  std::vector<State> states_;  ///< the cheapest first

  std::vector<std::vector<Close>> options_;  ///< of each target of the group
  std::vector<double> gains_;                ///< what the n-th target and those after it save at most
  double limit_ = 0.0;                       ///< what costs as much never pays
  std::size_t trials_ = 0;                   ///< that are left
  std::vector<int> taken_;
  std::map<Partners, State> reached_;
};

std::size_t count_positions(std::span<const Trajectory> trajectories, std::size_t& coordinates) {
  std::size_t count = 0;
  for (const Trajectory& trajectory : trajectories)
    for (const auto& point : trajectory.positions) {
      if (point.empty()) continue;
      if (coordinates == 0) coordinates = point.size();
      detail::check_point(point, coordinates);
      ++count;
    }
  return count;
}

/// In the order of scans; tracks are numbered after targets.
std::vector<Close> close_pairs(std::span<const Trajectory> truth, std::span<const Trajectory> tracks,
                               const GospaSettings& settings) {
  std::vector<Close> result;
  for (std::size_t i = 0; i < truth.size(); ++i)
    for (std::size_t j = 0; j < tracks.size(); ++j) {
      const auto& [first, positions] = truth[i];
      const std::size_t end = std::min(first + positions.size(), tracks[j].start + tracks[j].positions.size());
      for (std::size_t k = std::max(first, tracks[j].start); k < end; ++k) {
        const auto &x = positions[k - first], &y = tracks[j].positions[k - tracks[j].start];
        const double d = x.empty() || y.empty() ? settings.cutoff : detail::distance(x, y);
        if (d < settings.cutoff)
          result.push_back({k, static_cast<int>(i), static_cast<int>(truth.size() + j), std::pow(d, settings.order)});
      }
    }
  std::ranges::stable_sort(result, {}, &Close::scan);
  return result;
}

}  // namespace

TrajectoryGospa trajectory_gospa(std::span<const Trajectory> truth, std::span<const Trajectory> tracks,
                                 const TrajectoryGospaSettings& settings) {
  const GospaSettings of_a_scan{settings.cutoff, settings.order};
  detail::check(of_a_scan);
  const double switched = std::pow(settings.switch_penalty, settings.order);
  if (!(settings.switch_penalty > 0.0) || !std::isfinite(switched) || settings.max_states == 0)
    throw std::invalid_argument("trajectory GOSPA needs a finite switch penalty > 0 and max_states > 0; found " +
                                std::to_string(settings.switch_penalty) + " and " +
                                std::to_string(settings.max_states));
  std::size_t coordinates = 0;
  const std::size_t targets = count_positions(truth, coordinates), estimates = count_positions(tracks, coordinates);

  const double pair = std::pow(settings.cutoff, settings.order);
  TrajectoryGospa result;
  std::size_t pairs = 0, half_switches = 0;
  for (auto& [root, close] : connected(close_pairs(truth, tracks, of_a_scan), truth.size() + tracks.size())) {
    std::map<int, int> numbers;
    for (const Close& of : close) numbers[of.target] = numbers[of.track] = 0;
    for (int next = 0; auto& [trajectory, number] : numbers) number = next++;
    for (Close& of : close) of = {of.scan, numbers[of.target], numbers[of.track], of.cost};
    Cluster cluster(numbers.size(), pair, 0.5 * switched, settings.max_states);
    for (auto scan = close.begin(), end = scan; scan != close.end(); scan = end) {
      end = std::find_if(scan, close.end(), [&](const Close& of) { return of.scan != scan->scan; });
      for (const auto& [first, group] : connected({scan, end}, numbers.size())) cluster.decide(group);
    }
    result.localisation += cluster.best().localisation;
    pairs += cluster.best().pairs;
    half_switches += cluster.best().half_switches;
    result.exact = result.exact && cluster.exact();
  }
  result.missed = 0.5 * pair * static_cast<double>(targets - pairs);
  result.false_targets = 0.5 * pair * static_cast<double>(estimates - pairs);
  result.switches = 0.5 * static_cast<double>(half_switches);
  result.switching = result.switches * switched;
  const double total = result.localisation + result.missed + result.false_targets + result.switching;
  result.value = std::pow(total, 1.0 / settings.order);
  return result;
}

}  // namespace sigmax
