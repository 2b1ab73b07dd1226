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

/// The folds of recordings with so many rows, each of which is to be held out once: whole recordings where there are
/// two for each fold or more, else each recording's time cut into as many pieces, since neighbours know each other.
RowFolds folds_of(std::span<const std::size_t> rows, std::size_t folds);

/// Each row's loss by the settings that have not seen its fold: `without[f]` are those of settings fitted to all but
/// fold f.
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

/// Which settings are the best, by the mean of what they lose held out, and which are the simplest that lose no more
/// than one standard error more: those with the fewest fitted numbers. The first wins a tie.
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
  /// `losses(offsets)` are those of the settings with these offsets to so many numbers.
  LossSurface(std::size_t numbers, double step,
              const std::function<RowLosses(const std::vector<double>& offsets)>& losses);

  struct Shape {
    /// Where the least loss of the rows that count is, by a parabola: the offsets, within four steps.
    std::vector<double> least;
    /// The standard errors of the best numbers, H⁻¹ J H⁻¹ with the curvature H and the sum J of squared slopes of the
    /// rows, so that the losses need not be those of a right model; infinite of numbers on which the loss does not
    /// depend or has no least value. Slopes of rows that follow each other are added up first, so many, where losses
    /// are those of errors that last.
    std::vector<double> error;
    /// For each number where all of them are best if it is off by one, by the parabola: the columns of H⁻¹, over its
    /// own element; empty of numbers whose error is infinite.
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
