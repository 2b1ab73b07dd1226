#pragma once

#include <functional>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <string_view>

namespace sigmax::apps {

/// Finds numbers that often stand for no value among those of a column: one of nines, eights or sevens only, as -999,
/// the least or greatest that a machine has, as -32768 or 1e20 and beyond, or whatever the greatest or the least few
/// are, if they come again.
class Nines {
 public:
  /// Zero counts as the least or the greatest where nothing else asks for it.
  explicit Nines(bool asks_for_zero = false) : asks_for_zero_(asks_for_zero) {}

  /// A cell, and the number that it holds.
  void see(std::string_view cell, double number);

  /// What to ask of that column, if the numbers are farther from the others, which are twenty or more, than these are
  /// from each other, or if it is of nines ten times what any of them is on its side of zero; else nothing.
  std::string doubt(std::string_view column) const;

 private:
  struct Told {
    std::string word{};
    std::size_t cells = 0;
  };
  /// The different numbers that are farthest on one side, the farthest first.
  using End = std::map<double, Told, std::greater<>>;

  std::string doubt_of(std::string_view column, const End& end, double other_end) const;

  bool asks_for_zero_;
  std::string word_;
  double number_ = 0.0;
  std::size_t cells_ = 0, others_ = 0;
  double least_ = std::numeric_limits<double>::infinity(), greatest_ = -least_;  // of the others
  End low_, high_;                                                               // numbers of low_ have the other sign
  std::set<double> different_;                                                   // some of them
};

}  // namespace sigmax::apps
