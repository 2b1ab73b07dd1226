#include "himm_demo/track_shares.hpp"

#include <string>

#include "support/error.hpp"

namespace sigmax::apps {

TrackShares::TrackShares() : ranks_(Ranks::join("run it without mpirun")), unheard_(1) {
  if (!ranks_) return;
  rank_ = ranks_->rank();
  unheard_.resize(static_cast<std::size_t>(ranks_->size()));
}

void TrackShares::run(const std::function<void()>& all) {
  try {
    all();
  } catch (const std::exception& error) {
    if (alone()) throw;
    if (first()) ranks_->abort(error);
    bool failed = true;
    std::string what = error.what();
    untold_(failed, what);
    send();
  }
}

void TrackShares::finish() {
  if (first()) {
    for (int rank = 1; rank < static_cast<int>(unheard_.size()); ++rank) next_of(rank);
  } else {
    tell();
    send();
  }
}

/// What comes next of a rank, if that is no failure.
Unpacker& TrackShares::next_of(int rank) {
  Unpacker& unheard = unheard_[static_cast<std::size_t>(rank)];
  if (unheard.empty()) unheard = Unpacker(ranks_->hear(rank));
  bool failed = false;
  unheard(failed);
  if (!failed) return unheard;
  std::string what;
  unheard(what);
  throw InputError(what);
}

void TrackShares::send() { ranks_->tell(std::exchange(untold_.bytes, {})); }

}  // namespace sigmax::apps
