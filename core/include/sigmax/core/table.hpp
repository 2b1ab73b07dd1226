#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

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

/// Says that a law, not a check, makes numbers what their type promises: for the library's own verbs. Debug builds
/// check.
struct ByLaw {
  explicit ByLaw() = default;
};

}  // namespace detail

/// A dense rows × columns table of numbers, row by row; up to 16 of them are stored without allocation.
class Table {
 public:
  Table(std::size_t rows, std::size_t columns, double value = 0.0);

  /// A single row.
  explicit Table(std::span<const double> row);

  /// Changes the shape and leaves the values unspecified; allocates nothing if they fit into what is there.
  void reshape(std::size_t rows, std::size_t columns) {
    rows_ = rows;
    columns_ = columns;
    if (size() > inline_capacity && size() != heap_.size()) grow();
  }

  std::size_t rows() const { return rows_; }
  std::size_t columns() const { return columns_; }
  std::size_t size() const { return rows_ * columns_; }

  double* data() { return size() > inline_capacity ? heap_.data() : inline_.data(); }
  const double* data() const { return size() > inline_capacity ? heap_.data() : inline_.data(); }

  /// Views that live as long as the table and its shape; of a temporary, copies.
  std::span<double> values() & { return {data(), size()}; }
  std::span<const double> values() const& { return {data(), size()}; }
  std::vector<double> values() const&& { return {data(), data() + size()}; }
  std::span<double> row(std::size_t r) & { return {data() + r * columns_, columns_}; }
  std::span<const double> row(std::size_t r) const& { return {data() + r * columns_, columns_}; }
  std::vector<double> row(std::size_t r) const&& { return {data() + r * columns_, data() + (r + 1) * columns_}; }

  /// The same as every way to store rows has it; see rows.hpp.
  std::size_t stored() const { return size(); }
  std::size_t offset(std::size_t r) const { return r * columns_; }
  std::span<double> values(std::size_t r) & { return row(r); }
  void fill_rows(std::span<const std::size_t> rows, double value);
  double at(std::size_t r, std::size_t column) const { return (*this)(r, column); }
  RunOfEntries entries(std::size_t r) const& { return {0, row(r)}; }
  RunOfEntries entries(std::size_t r) const&& = delete;

  double& operator()(std::size_t r, std::size_t c) {
    assert(r < rows_ && c < columns_);
    return data()[r * columns_ + c];
  }
  double operator()(std::size_t r, std::size_t c) const {
    assert(r < rows_ && c < columns_);
    return data()[r * columns_ + c];
  }

 private:
  void grow();

  static constexpr std::size_t inline_capacity = 16;
  std::size_t rows_ = 0;
  std::size_t columns_ = 0;
  std::array<double, inline_capacity> inline_{};
  std::vector<double> heap_;
};

}  // namespace sigmax
