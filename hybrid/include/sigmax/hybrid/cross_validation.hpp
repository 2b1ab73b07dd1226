#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace sigmax {

/// What a filter loses at each row of each recording: minus its log_score, a squared error, …; NaN for rows that are
/// not judged.
using RowLosses = std::vector<std::vector<double>>;

/// Something of each row: the fold that it is in.
using RowFolds = std::vector<std::vector<std::size_t>>;

/// Which rows count.
using RowCounts = std::function<bool(std::size_t recording, std::size_t row)>;

/// The folds of recordings with so many rows; each fold is held out once. With two recordings a fold or more, a fold
/// has whole recordings. Otherwise each recording's time is cut into as many pieces, as neighbouring rows are
/// correlated.
RowFolds folds_of(std::span<const std::size_t> rows, std::size_t folds);

/// Each row's loss by the settings that have not seen its fold. `without[f]` has the losses by settings that were
/// fitted to all folds but f.
RowLosses held_out(const RowFolds& folds, std::span<const RowLosses> without);

/// The mean loss of the rows that count and are judged; NaN if there are none.
double mean_loss(const RowLosses& losses, const RowCounts& counts = {});

/// The mean of a − b over the rows that both judge, with its standard error over at most 20 blocks of rows in a row:
/// neighbours are not independent. Both are 0 without such rows.
struct MeanDifference {
  double mean = 0.0;
  double error = 0.0;
};
MeanDifference mean_difference(const RowLosses& a, const RowLosses& b);

/// The best settings by their mean held-out loss, and the simplest settings within one standard error of it. The
/// simplest have the fewest fitted numbers. The first wins a tie.
struct Selected {
  std::size_t best = 0;
  std::size_t simple = 0;
};

/// Throws std::invalid_argument for no settings, and unless each has its number of fitted numbers.
Selected select_settings(std::span<const RowLosses> held_out, std::span<const std::size_t> numbers);

/// What the losses about some settings say of their best numbers. They are asked once, at single and double steps
/// from there, and tell the slopes and the curvature over any choice of rows after that.
class LossSurface {
 public:
  /// `losses(offsets)` gives the losses of the settings with these offsets to so many numbers.
  LossSurface(std::size_t numbers, double step,
              const std::function<RowLosses(const std::vector<double>& offsets)>& losses);

  struct Shape {
    /// Where the least loss of the rows that count is, by a parabola: the offsets, within four steps.
    std::vector<double> least;
    /// The standard errors of the best numbers, H⁻¹ J H⁻¹ with the curvature H and the sum J of squared slopes of the
    /// rows. They hold for a wrong model, too. A number without influence, or without a least loss, has an infinite
    /// error. With correlated errors the slopes of `together` consecutive rows are summed first.
    std::vector<double> error;
    /// For each number the best values of all numbers if it is off by one, by the parabola: a column of H⁻¹ over its
    /// diagonal element. Empty for a number whose error is infinite.
    std::vector<std::vector<double>> ridges;
  };
  Shape shape(const RowCounts& counts = {}, std::size_t together = 1) const;

  /// So often the losses are asked.
  static std::size_t asked(std::size_t numbers) { return 1 + numbers + numbers * numbers; }

 private:
  std::size_t numbers_;
  double step_;
  std::vector<RowLosses> losses_;  ///< in the middle, then for each number up and down, then each pair up and down
};

}  // namespace sigmax
