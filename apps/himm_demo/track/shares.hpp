#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <sigmax/hybrid/any_target.hpp>

#include "study/ranks.hpp"
#include "support/geodesy.hpp"

namespace sigmax::apps {

/// What one filter says of a row, in the frame that begins at a place if the recording is geodetic.
struct Said {
  std::size_t filter = 0;
  TargetPoint point;
  std::optional<Geodetic> frame;
};

/// How often a filter of a target turned measurements away and started, up to now.
struct Tally {
  std::size_t rejected = 0;
  std::size_t starts = 0;
};

/// What the filters of a target make of one row, or of all when they have been read.
struct News {
  std::vector<Said> said;
  std::vector<Tally> tallies;                    ///< of each filter, after a row
  std::vector<std::vector<ModeStay>> histories;  ///< of each filter, at the end
  std::optional<std::string> failure;            ///< why there are none, from another rank
};

/// Which rank of an MPI job follows which track. All ranks read the recording; the first one takes everything down, row
/// by row, as if it had followed all tracks itself, and so writes the bytes of a process alone.
class TrackShares {
 public:
  /// Joins the other ranks, if there are any.
  TrackShares();

  bool alone() const { return ranks_ == nullptr; }
  bool first() const { return rank_ == 0; }

  /// The rank that follows the track that is the n-th to appear.
  int rank_of(std::size_t n) const { return static_cast<int>(n % unheard_.size()); }

  /// Whether this rank follows the tracks of that one, and whether it has anything to do with them.
  bool follows(int rank) const { return rank == rank_; }
  bool concerns(int rank) const { return first() || follows(rank); }

  /// The news that the work of a rank gives, in the first rank; nothing elsewhere. The first rank must ask for all
  /// works of a rank in the order in which that does them. Throws what a work threw, as InputError.
  std::optional<News> by(int rank, const std::function<News()>& work);

  /// Does all the work of this rank. What the first rank throws ends all; what another one throws, the first learns
  /// where it asks for the work that failed, or at the end.
  void run(const std::function<void()>& all);

  /// Tells that this rank has done everything, and waits for all that the first rank is to learn.
  void finish();

 private:
  News heard(int rank);
  void tell(News news);
  void send();

  std::unique_ptr<Ranks> ranks_;
  int rank_ = 0;
  std::vector<News> untold_;
  std::vector<std::deque<News>> unheard_;  // of each rank
};

}  // namespace sigmax::apps
