#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

#include <sigmax/core/entries.hpp>

namespace sigmax {

namespace detail {

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
