#pragma once

#include "recording/recording.hpp"

namespace sigmax::apps {

/// Signs that the numbers of a recording mean something else than they were taken for.
class RecordingChecks {
 public:
  explicit RecordingChecks(const RecordingReader&) {}

  /// The row that the reader gave last, where its sensor stands; positions of the Earth are counted in this frame, else
  /// from the first one of their track.
  void see(const Row& row, const LocalFrame* frame = nullptr);

  /// Sentences: what is wrong, where, and what mends it.
  std::vector<std::string> findings() const;
};

}  // namespace sigmax::apps
