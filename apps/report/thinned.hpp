#pragma once

#include <cstddef>
#include <vector>

namespace sigmax::apps {

/// Rows of numbers over time of which a bounded number is kept, whatever comes: all, until they are too many; then of
/// every stretch of rows the first one, and those with the least and the greatest number of each watched column, so
/// that no peak is lost.
///
///     Thinned rows(2, 1000, {0, 1});      // both columns are watched
///     for (…) rows.add(time, {error, sigma});
///     rows.times(); rows.column(0);   // at most 1000 of each
class Thinned {
 public:
  /// Throws std::invalid_argument unless there is a column, and room for the extremes of one stretch.
  Thinned(std::size_t columns, std::size_t most, std::vector<std::size_t> watched);

  /// Takes a row; NaN is a number that is not known. Throws std::invalid_argument for another number of columns.
  void add(double time, const std::vector<double>& values);

  /// Keeps no more than so many rows from now on; but at least the extremes of one stretch.
  void limit(std::size_t most);

  std::size_t taken() const { return taken_; }
  std::size_t kept() const { return kept_; }

  std::vector<double> times() const;
  std::vector<double> column(std::size_t i) const;

 private:
  struct Row {
    double time;
    std::vector<double> values;
  };
  using Stretch = std::vector<Row>;

  void halve();
  void keep_extremes(Stretch& rows) const;

  std::size_t columns_, most_;
  std::vector<std::size_t> watched_;
  std::size_t length_ = 1;  // of a stretch, in rows as they came
  std::size_t in_last_ = 0, taken_ = 0, kept_ = 0;
  std::vector<Stretch> stretches_;
};

}  // namespace sigmax::apps
