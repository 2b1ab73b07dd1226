#pragma once

#include <cstddef>
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

/// Divides values into `bins` bins with equal numbers of values, as far as ties allow. Cut j = 1 … bins−1 is the value
/// number ⌊jn/bins⌋, counted from 0, of n values in ascending order; it belongs to the bin above. If two cuts fall on a
/// value, or one falls on the least, this value has a bin of its own: the next greater value, if any, replaces the
/// second cut. So there may be fewer bins. If there are no more different values than bins, each has one. NaN are
/// skipped. Throws as `equal_width` does.
Discretization equal_frequency(std::span<const double> values, std::size_t bins);

}  // namespace sigmax
