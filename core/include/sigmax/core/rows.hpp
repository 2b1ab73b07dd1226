#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <new>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include <sigmax/core/table.hpp>

namespace sigmax {

/// One row of a banded table: numbers from column `first` on.
struct BandOfRow {
  std::size_t first;
  std::vector<double> values;
};

/// A table that stores a run of columns in each row.
///
///     BandedRows{{0, {0.9, 0.1}}, {1, {0.4, 0.6}}}
class BandedRows {
 public:
  explicit BandedRows(std::size_t columns = 0) : columns_(columns) {}
  BandedRows(std::initializer_list<BandOfRow> rows);

  /// Appends a row.
  void append(std::size_t first, std::span<const double> values);

  /// Appends a row of `size` equal numbers.
  void append(std::size_t first, std::size_t size, double value) { append(first, std::vector<double>(size, value)); }

  std::size_t rows() const { return rows_.size(); }
  std::size_t columns() const { return columns_; }
  std::size_t stored() const { return values_.size(); }
  void widen(std::size_t columns) { columns_ = columns > columns_ ? columns : columns_; }

  std::size_t offset(std::size_t r) const { return rows_[r].offset; }
  RunOfEntries entries(std::size_t r) const&& = delete;
  RunOfEntries entries(std::size_t r) const& {
    return {rows_[r].first, {values_.data() + rows_[r].offset, rows_[r].size}};
  }
  double at(std::size_t r, std::size_t column) const { return detail::AnyEntries(entries(r)).at(column); }
  std::span<double> values(std::size_t r) & { return {values_.data() + rows_[r].offset, rows_[r].size}; }

 private:
  struct Row {
    std::size_t first, offset, size;
  };
  std::size_t columns_ = 0;
  std::vector<Row> rows_;
  std::vector<double> values_;
};

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

/// A table that stores only some of the columns in each row.
///
///     SparseRows{{{0, 0.3}, {7, 1.0}}, {{7, 1.0}}}   // a row per outcome of the condition: column, value
class SparseRows {
 public:
  using Columns = std::vector<std::uint32_t, detail::UnsetAllocator<std::uint32_t>>;
  using Values = std::vector<double, detail::UnsetAllocator<double>>;

  explicit SparseRows(std::size_t columns = 0) : columns_(columns) {}
  SparseRows(std::initializer_list<std::initializer_list<Entry>> rows);

  /// The arrays of compressed sparse rows as they are: row r has entries `ends[r − 1]` up to `ends[r]`.
  /// Throws std::invalid_argument if the arrays do not fit together.
  SparseRows(std::size_t columns, std::span<const std::size_t> ends, Columns indices, Values values);

  /// Appends a row; its columns ascend.
  void append(std::span<const Entry> row);
  void append(std::initializer_list<Entry> row) { append(std::span<const Entry>(row.begin(), row.size())); }

  /// Appends a row entry by entry: the entries, then `end_row`. Throws std::invalid_argument if the column does not fit
  /// into 32 bits.
  void append_entry(std::size_t column, double value);
  void end_row();

  /// Removes all rows and keeps their memory.
  void clear(std::size_t columns);
  void reserve(std::size_t rows, std::size_t numbers);

  /// Room for the next row, of at most so many entries: columns below `columns()`. `end_row` says how many were
  /// written.
  struct Room {
    std::uint32_t* columns;
    double* values;
  };
  Room room(std::size_t most);
  void end_row(std::size_t size);

  /// Makes rows share one further row of equal numbers in every column: what is stored grows by one row only.
  void fill_rows(std::span<const std::size_t> rows, double value);

  std::size_t rows() const { return extents_.size(); }
  std::size_t columns() const { return columns_; }
  std::size_t stored() const { return values_.size(); }
  void widen(std::size_t columns) { columns_ = columns > columns_ ? columns : columns_; }

  /// Where row r begins among the stored numbers.
  std::size_t offset(std::size_t r) const { return extents_[r].first; }
  ListOfEntries entries(std::size_t r) const&& = delete;
  ListOfEntries entries(std::size_t r) const& {
    const auto [first, size] = extents_[r];
    return {{indices_.data() + first, size}, {values_.data() + first, size}};
  }
  double at(std::size_t r, std::size_t column) const { return detail::AnyEntries(entries(r)).at(column); }
  std::span<double> values(std::size_t r) & { return {values_.data() + extents_[r].first, extents_[r].second}; }

 private:
  std::size_t columns_ = 0, end_ = 0;
  std::vector<std::pair<std::size_t, std::size_t>> extents_;  // of each row: first, size
  Columns indices_;
  Values values_;
};

/// How a relation stores its rows; chosen when it is constructed, and by a verb to fit its result. It is copied, moved
/// and destroyed by compiled functions.
struct AnyRows : std::variant<Table, SparseRows, BandedRows> {
  using variant::variant;
  using variant::operator=;
  AnyRows(const AnyRows& other);
  AnyRows(AnyRows&& other) noexcept;
  AnyRows& operator=(const AnyRows& other);
  AnyRows& operator=(AnyRows&& other) noexcept;
  ~AnyRows();
};

/// The dense table that a result is written to; allocates nothing if it is one already.
Table& as_table(AnyRows& rows);

/// The same numbers as a dense table.
Table dense_table(const AnyRows& rows);

namespace detail {

AnyEntries entries_of(const AnyRows& rows, std::size_t r);
std::span<double> values_of(AnyRows& rows, std::size_t r);
Table dense_row(const AnyRows& rows, std::size_t r);
std::vector<double> column_of(const AnyRows& rows, std::size_t column);
bool same_numbers(const AnyRows& a, const AnyRows& b);

/// The rows that are stored, each once: those without numbers of their own share one.
std::vector<std::size_t> stored_rows(const AnyRows& rows);

}  // namespace detail

}  // namespace sigmax
