#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "study/ranks.hpp"
#include "support/packed.hpp"

namespace sigmax::apps {

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

  /// What the work of a rank gives, in the first rank; nothing elsewhere. The first rank must ask for all works of a
  /// rank in the order in which that does them. Throws what a work threw, as InputError.
  template <class Result, class Work>
  std::optional<Result> by(int rank, const Work& work) {
    Result result;
    if (follows(rank))
      result = work();
    else if (first())
      next_of(rank)(result);
    if (first()) return result;
    if (follows(rank)) tell(result);
    return std::nullopt;
  }

  /// Does all the work of this rank. What the first rank throws ends all; what another one throws, the first learns
  /// where it asks for the work that failed, or at the end.
  void run(const std::function<void()>& all);

  /// Tells that this rank has done everything, and waits for all that the first rank is to learn.
  void finish();

 private:
  Unpacker& next_of(int rank);
  template <class... Values>
  void tell(Values&... values) {
    bool failed = false;
    untold_(failed, values...);
    if (untold_.bytes.size() >= enough_to_send) send();
  }
  void send();

  static constexpr std::size_t enough_to_send = std::size_t{1} << 16U;

  std::unique_ptr<Ranks> ranks_;
  int rank_ = 0;
  Packer untold_;
  std::vector<Unpacker> unheard_;  // of each rank
};

}  // namespace sigmax::apps
