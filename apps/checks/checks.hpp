#pragma once

#include "records/recording.hpp"

namespace sigmax::apps {

namespace checks {
struct Records;
}

/// Signs that the numbers of a recording mean something else than they were taken for. It keeps what the rows say.
class RecordingChecks {
 public:
  explicit RecordingChecks(const RecordingReader& recording);

  /// The row that the reader gave last, where its sensor stands. Places on the Earth are counted in this frame, else
  /// in one that begins at the first of their track.
  void see(const Row& row, const LocalFrame* frame = nullptr);

  /// From where azimuths count, where nobody said it, and the options that say it; else nothing.
  std::optional<std::string> assumed() const;

  /// Sentences: what is wrong, where, and what mends it; causes before what else there is. Throws InputError where the
  /// truth is what was measured.
  std::vector<std::string> findings() const;

 private:
  std::shared_ptr<checks::Records> records_;  // which need Eigen
};

}  // namespace sigmax::apps
