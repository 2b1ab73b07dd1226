#pragma once

#include <limits>
#include <string>
#include <string_view>

namespace sigmax::apps {

/// Finds a number of nines only, as -999, or the least or greatest that a machine has, as -32768 or 1e20 and beyond,
/// among the numbers of a column: that often stands for no value.
class Nines {
 public:
  /// A cell, and the number that it holds.
  void see(std::string_view cell, double number);

  /// What to ask of that column, if the number is farther from the others, which are twenty or more, than these are
  /// from each other, or ten times what any of them is on its side of zero; else nothing.
  std::string doubt(std::string_view column) const;

 private:
  std::string word_;
  double number_ = 0.0;
  std::size_t cells_ = 0, others_ = 0;
  double least_ = std::numeric_limits<double>::infinity(), greatest_ = -least_;  // of the others
};

}  // namespace sigmax::apps
