#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace sigmax {

/// The stored numbers of one row: entry k is `value(k)` in column `index(k)`; columns ascend, absent numbers are zero.
/// This one stores a run of columns without a gap; a dense row is a run from column 0.
struct RunOfEntries {
  std::size_t first;
  std::span<const double> values;
  std::size_t size() const { return values.size(); }
  std::size_t index(std::size_t k) const { return first + k; }
  double value(std::size_t k) const { return values[k]; }
};

/// The same with the column of each number beside it; 32 bits, because there are many.
struct ListOfEntries {
  std::span<const std::uint32_t> columns;
  std::span<const double> values;
  std::size_t size() const { return values.size(); }
  std::size_t index(std::size_t k) const { return columns[k]; }
  double value(std::size_t k) const { return values[k]; }
};

namespace detail {

/// Either of them.
struct AnyEntries {
  AnyEntries(const RunOfEntries& run) : first(run.first), values(run.values) {}
  AnyEntries(const ListOfEntries& list) : columns(list.columns.data()), values(list.values) {}

  std::size_t size() const { return values.size(); }
  std::size_t index(std::size_t k) const { return columns == nullptr ? first + k : columns[k]; }
  double value(std::size_t k) const { return values[k]; }

  /// Which entry is that of a column; size() if none is.
  std::size_t place_of(std::size_t column) const;
  double at(std::size_t column) const;

  std::size_t first = 0;
  const std::uint32_t* columns = nullptr;
  std::span<const double> values;
};

}  // namespace detail

}  // namespace sigmax
