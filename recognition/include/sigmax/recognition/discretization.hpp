#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <sigmax/core/variable.hpp>
#include <sigmax/recognition/report.hpp>

namespace sigmax {

/// Bins of the real line: bin 0 is (−∞, cut 0), bin i is [cut i−1, cut i), the last is [last cut, ∞). A value on a cut
/// belongs to the bin above it, and no value is outside.
///
/// Fit it on training data only: `equal_width`, `equal_frequency`, or give the cuts.
class Discretization {
 public:
  /// Throws std::invalid_argument, with the cut, unless the cuts are finite and strictly ascending.
  explicit Discretization(std::vector<double> cuts);

  std::size_t size() const { return cuts_.size() + 1; }
  /// A view that lives as long as the bins; of a temporary, a copy.
  std::span<const double> cuts() const& { return cuts_; }
  std::vector<double> cuts() && { return std::move(cuts_); }

  /// The bin of a value; `missing` for NaN.
  std::size_t bin(double value) const;

  /// Where a bin begins, and where the next one does; ∓∞ at the ends. Throws std::invalid_argument if there is no such
  /// bin.
  double lower(std::size_t bin) const;
  double upper(std::size_t bin) const;

  /// "below 2.5", "2.5 to 4", "4 and above"; "any" if there is a single bin.
  std::vector<std::string> labels() const;

  /// A variable whose outcomes are the bins.
  template <Uncertainty Kind>
  Variable<Kind> variable(std::string name) const {
    return {std::move(name), labels()};
  }

 private:
  std::vector<double> cuts_;
};

/// `bins` bins of equal width between the least and the greatest value; the outer two reach on to infinity. NaN are
/// skipped. Throws std::invalid_argument if `bins` is zero, a value is infinite, or the values, of which there must be
/// one, do not differ while several bins are wanted.
Discretization equal_width(std::span<const double> values, std::size_t bins);

/// `bins` bins with equal numbers of values, as far as ties allow: of n values in ascending order each cut is number
/// ⌊jn/bins⌋, counted from 0, for j = 1 … bins−1; that value belongs to the bin above. A value that fills a bin, since
/// two cuts fall on it, or one that is the least, has a bin of its own: in place of the second cut is the next greater
/// value, if there is one, so there may be fewer bins; and where there are no more different values than bins, each has
/// one. NaN are skipped. Throws as `equal_width` does. For more values
/// than memory should hold there is `EqualFrequencyFit`.
Discretization equal_frequency(std::span<const double> values, std::size_t bins);

/// `equal_frequency` of values that can be seen several times over, in memory that does not grow with their number:
/// that of 8192 values, and 2 KiB a bin.
///
///     EqualFrequencyFit fit(8);
///     do {
///       for (const double x : …) fit.see(x);   // the same values in every pass, in any order
///     } while (fit.wants_another_pass());
///     const Discretization bins = fit.discretization();
///
/// One pass is enough for 8192 values, and there are never more than nine: in each, the values near a cut are told
/// apart by eight further bits, until few are left; the last looks for what follows the values that fill a bin.
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
  void see_above(double value);
  void settle(Range& range, std::vector<Range>& next);

  std::size_t bins_;
  bool first_pass_ = true;
  std::size_t size_ = 0;
  double least_ = std::numeric_limits<double>::quiet_NaN();
  double greatest_ = std::numeric_limits<double>::quiet_NaN();
  std::set<double> different_;               // values, one more than there are bins at most
  std::vector<std::size_t> ranks_;           // of the values that are cuts, ascending, once the first pass has ended
  std::vector<double> at_ranks_;             // those values, as far as they are known
  std::vector<Range> ranges_;                // where to look for the others, ascending
  std::vector<double> full_, next_greater_;  // once all are: which of them fill a bin, and what follows each
};

}  // namespace sigmax
