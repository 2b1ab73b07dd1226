#pragma once

#include <limits>
#include <set>
#include <string>
#include <string_view>

namespace sigmax::apps {

/// Finds a number that often stands for no value among those of a column: one of nines only, as -999, the least or
/// greatest that a machine has, as -32768 or 1e20 and beyond, or whatever the greatest or the least is, if it comes
/// again.
class Nines {
 public:
  /// A cell, and the number that it holds.
  void see(std::string_view cell, double number);

  /// What to ask of that column, if the number is farther from the others, which are twenty or more, than these are
  /// from each other, or if it is of nines ten times what any of them is on its side of zero; else nothing.
  std::string doubt(std::string_view column) const;

 private:
  /// The number that is farthest on one side, and the next one.
  struct End {
    std::string word{};
    double number = -std::numeric_limits<double>::infinity(), next = number;
    std::size_t cells = 0;

    void see(std::string_view cell, double other);
  };

  std::string word_;
  double number_ = 0.0;
  std::size_t cells_ = 0, others_ = 0;
  double least_ = std::numeric_limits<double>::infinity(), greatest_ = -least_;  // of the others
  End low_, high_;                                                               // numbers of low_ have the other sign
  std::set<double> different_;                                                   // some of them
};

}  // namespace sigmax::apps
