#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <sigmax/core/entries.hpp>

namespace sigmax {

namespace detail {

/// Leaves new numbers unset where nothing is said of them: a vector that is resized to be written does not write twice.
template <class T>
struct UnsetAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = UnsetAllocator<U>;
  };
  template <class U, class... Arguments>
  void construct(U* number, Arguments&&... arguments) {
    if constexpr (sizeof...(Arguments) == 0)
      ::new (static_cast<void*>(number)) U;
    else
      ::new (static_cast<void*>(number)) U(std::forward<Arguments>(arguments)...);
  }
};

}  // namespace detail

/// One number of a sparse row.
struct Entry {
  std::size_t column;
  double value;
};

/// A table of which each row stores only some of its columns.
///
///     SparseRows{{{0, 0.3}, {7, 1.0}}, {{7, 1.0}}}   // a row per outcome of the condition: column, value
class SparseRows {
 public:
  using Columns = std::vector<std::uint32_t, detail::UnsetAllocator<std::uint32_t>>;
  using Values = std::vector<double, detail::UnsetAllocator<double>>;

  explicit SparseRows(std::size_t columns = 0) : columns_(columns) {}
  SparseRows(std::initializer_list<std::initializer_list<Entry>> rows) {
    for (const auto& row : rows) append(row);
  }

  /// The arrays of compressed sparse rows as they are: row r has entries `ends[r − 1]` up to `ends[r]`.
  /// Throws std::invalid_argument if the arrays do not fit together.
  SparseRows(std::size_t columns, std::span<const std::size_t> ends, Columns indices, Values values)
      : columns_(columns), indices_(std::move(indices)), values_(std::move(values)) {
    for (const std::size_t end : ends) {
      if (end < end_) throw std::invalid_argument("the ends of sparse rows do not ascend");
      extents_.push_back({end_, end - end_});
      end_ = end;
    }
    if (indices_.size() != values_.size() || end_ != values_.size())
      throw std::invalid_argument("sparse rows need as many columns as values, and their last end to be that number");
    for (const std::size_t index : indices_) columns_ = std::max(columns_, index + 1);
  }

  /// Appends a row; its columns ascend.
  void append(std::span<const Entry> row) {
    for (const Entry& entry : row) append_entry(entry.column, entry.value);
    end_row();
  }
  void append(std::initializer_list<Entry> row) { append(std::span(row.begin(), row.size())); }

  /// Appends a row entry by entry: the entries, then `end_row`. Throws std::invalid_argument if the column does not fit
  /// into 32 bits.
  void append_entry(std::size_t column, double value) {
    if (column > std::numeric_limits<std::uint32_t>::max())
      throw std::invalid_argument("sparse rows have columns below 2^32, not " + std::to_string(column));
    columns_ = std::max(columns_, column + 1);
    indices_.push_back(static_cast<std::uint32_t>(column));
    values_.push_back(value);
  }
  void end_row() {
    extents_.push_back({end_, values_.size() - end_});
    end_ = values_.size();
  }

  /// Removes all rows and keeps their memory.
  void clear(std::size_t columns) {
    columns_ = columns;
    extents_.clear();
    indices_.clear();
    values_.clear();
    end_ = 0;
  }
  void reserve(std::size_t rows, std::size_t numbers) {
    extents_.reserve(rows);
    indices_.reserve(numbers);
    values_.reserve(numbers);
  }

  /// Appends a row of at most so many entries: write(columns, values) writes them to where these point, columns below
  /// `columns()`, and returns how many they are.
  template <class Write>
  void append_written(std::size_t most, const Write& write) {
    indices_.resize(end_ + most);
    values_.resize(end_ + most);
    const std::size_t size = write(indices_.data() + end_, values_.data() + end_);
    indices_.resize(end_ + size);
    values_.resize(end_ + size);
    end_row();
  }

  /// Makes rows share one further row of equal numbers in every column: what is stored grows by one row only.
  void fill_rows(std::span<const std::size_t> rows, double value) {
    if (rows.empty()) return;
    for (std::size_t column = 0; column < columns_; ++column) append_entry(column, value);
    for (const std::size_t row : rows) extents_[row] = {end_, columns_};
    end_ = values_.size();
  }

  std::size_t rows() const { return extents_.size(); }
  std::size_t columns() const { return columns_; }
  std::size_t stored() const { return values_.size(); }
  void widen(std::size_t columns) { columns_ = std::max(columns_, columns); }

  /// Where row r begins among the stored numbers.
  std::size_t offset(std::size_t r) const { return extents_[r].first; }
  ListOfEntries entries(std::size_t r) const&& = delete;
  ListOfEntries entries(std::size_t r) const& {
    const auto [first, size] = extents_[r];
    return {std::span(indices_).subspan(first, size), std::span(values_).subspan(first, size)};
  }
  double at(std::size_t r, std::size_t column) const {
    const ListOfEntries row = entries(r);
    const auto found = std::lower_bound(row.columns.begin(), row.columns.end(), column);
    if (found == row.columns.end() || *found != column) return 0.0;
    return row.value(static_cast<std::size_t>(found - row.columns.begin()));
  }
  std::span<double> values(std::size_t r) & {
    return std::span(values_).subspan(extents_[r].first, extents_[r].second);
  }

 private:
  std::size_t columns_ = 0, end_ = 0;
  std::vector<std::pair<std::size_t, std::size_t>> extents_;  // of each row: first, size
  Columns indices_;
  Values values_;
};

}  // namespace sigmax
