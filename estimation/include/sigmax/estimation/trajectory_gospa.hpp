#pragma once

#include <cstddef>
#include <span>

#include <sigmax/estimation/gospa.hpp>

namespace sigmax {

/// Positions of one target, or one track, at consecutive scans. An empty position is a gap: the trajectory does not
/// exist at that scan.
struct Trajectory {
  std::size_t start = 0;  ///< scan of the first position
  PointSet positions;
};

/// What errors cost, and how far the search goes.
struct TrajectoryGospaSettings {
  double cutoff = 10.0;           ///< c in m, as in GospaSettings
  double order = 2.0;             ///< p ≥ 1
  double switch_penalty = 1.0;    ///< γ > 0 in m
  std::size_t max_states = 1000;  ///< sequences of assignments that are kept for each cluster, at most
};

/// Trajectory GOSPA and its parts, which are p-th powers summed over scans: value^p is their sum.
struct TrajectoryGospa {
  double value = 0.0;
  double localisation = 0.0;   ///< Σ dᵖ over targets with a track
  double missed = 0.0;         ///< cᵖ/2 for each scan of a target without a track
  double false_targets = 0.0;  ///< cᵖ/2 for each scan of a track without a target
  double switching = 0.0;      ///< γᵖ for each switch
  double switches = 0.0;       ///< a target that goes from one track to another is 1, to or from no track 1/2
  bool exact = true;           ///< false if a bound of the search was reached: the value is an upper bound
};

/// The metric on sets of trajectories of García-Fernández, Rahmathullah and Svensson (IEEE TSP 68:3917, 2020), with
/// assignments, not their relaxation to a linear program. It is a minimum over sequences of assignments: GOSPAᵖ
/// (α = 2), summed over scans, and γᵖ for each switch.
///
/// Trajectories connected by distances below c are a cluster, solved by dynamic programming over assignments. An
/// assignment is dropped if it never pays compared with switches from a better one, so few remain. The search of a scan
/// is bounded, too: 100 max_states steps for each group of trajectories connected at that scan.
///
/// The value grows with the number of scans; divide value^p by that number to compare recordings. Throws
/// std::invalid_argument for settings out of range and for positions that differ in size or are not finite.
TrajectoryGospa trajectory_gospa(std::span<const Trajectory> truth, std::span<const Trajectory> tracks,
                                 const TrajectoryGospaSettings& settings = {});

}  // namespace sigmax
