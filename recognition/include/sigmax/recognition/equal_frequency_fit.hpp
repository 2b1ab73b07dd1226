#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <sigmax/recognition/discretization.hpp>

namespace sigmax {

/// `equal_frequency` of values that can be seen several times over, in memory that does not grow with their number:
/// that of 8192 values, and 2 KiB a bin.
///
///     EqualFrequencyFit fit(8);
///     do {
///       for (const double x : …) fit.see(x);   // the same values in every pass, in any order
///     } while (fit.wants_another_pass());
///     const Discretization bins = fit.discretization();
///
/// One pass is enough for 8192 values, and there are never more than eight: in each, the values near a cut are told
/// apart by eight further bits, until few are left.
class EqualFrequencyFit {
 public:
  /// Throws std::invalid_argument if `bins` is zero.
  explicit EqualFrequencyFit(std::size_t bins);

  /// NaN is skipped. Throws std::invalid_argument if a value is infinite.
  void see(double value);

  /// Ends a pass. Throws std::logic_error if the pass before had other values.
  bool wants_another_pass();

  /// How many values there are, the least and the greatest, which are NaN if there is none.
  std::size_t size() const { return size_; }
  double least() const { return least_; }
  double greatest() const { return greatest_; }

  /// As `equal_frequency` of all values has it; one bin where that throws, if there is no value or no two differ.
  Discretization discretization() const;

 private:
  using Key = std::uint64_t;  // in the order of the values

  /// Keys that agree in all but their last bits: those that were seen or, once these are many, how many there are of
  /// each of the next bits.
  struct Range {
    Key first;
    int free_bits;
    std::size_t below;                            // values below the range
    Key least = std::numeric_limits<Key>::max();  // that was seen
    Key greatest = 0;
    std::vector<Key> keys{};
    std::vector<std::size_t> counts{};
  };

  static void count(Range& range, Key key);
  void settle(Range& range, std::vector<Range>& next);

  std::size_t bins_;
  std::size_t size_ = 0;
  double least_ = std::numeric_limits<double>::quiet_NaN();
  double greatest_ = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::size_t> ranks_;  // of the values that are cuts, ascending, once the first pass has ended
  std::vector<double> cuts_;        // those values, as far as they are known
  std::vector<Range> ranges_;       // where to look for the others, ascending
};

}  // namespace sigmax
