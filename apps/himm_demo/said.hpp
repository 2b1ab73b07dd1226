#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <sigmax/hybrid/any_target.hpp>

namespace sigmax::apps {

/// What one filter says of the time of one row.
struct Said {
  /// Along each axis, in m and m².
  struct Position {
    std::array<double, 3> mean{}, variance{};
  };

  std::size_t filter = 0;
  std::size_t tag = 0;  ///< of the row
  double time = 0.0;
  Position own;   ///< in the frame of the filter
  Position told;  ///< as files and pages tell it
  std::vector<double> weights;
  std::optional<double> nis;
  std::string line;  ///< of estimates.csv, where that is wanted
};

/// How often a filter of a target turned measurements away and started, up to now.
struct Tally {
  std::size_t rejected = 0;
  std::size_t starts = 0;
};

/// What the filters of a target make of one row.
struct Step {
  std::vector<Said> said;
  std::vector<Tally> tallies;  ///< of each filter
};

/// What one filter of a target adds when all rows have been read.
struct LastWords {
  std::vector<Said> said;         ///< if it is to smooth
  std::vector<ModeStay> history;  ///< if it is to explain
};

template <class Pack>
void members(Pack& pack, Said& said) {
  pack(said.filter, said.tag, said.time, said.own, said.told, said.weights, said.nis, said.line);
}
template <class Pack>
void members(Pack& pack, Step& step) {
  pack(step.said, step.tallies);
}
template <class Pack>
void members(Pack& pack, LastWords& words) {
  pack(words.said, words.history);
}

}  // namespace sigmax::apps
