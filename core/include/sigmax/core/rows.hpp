#pragma once

#include <cstddef>
#include <span>
#include <variant>
#include <vector>

#include <sigmax/core/banded_rows.hpp>
#include <sigmax/core/entries.hpp>
#include <sigmax/core/sparse_rows.hpp>
#include <sigmax/core/table.hpp>

namespace sigmax {

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
std::size_t offset_of(const AnyRows& rows, std::size_t r);
Table dense_row(const AnyRows& rows, std::size_t r);
std::vector<double> column_of(const AnyRows& rows, std::size_t column);
bool same_numbers(const AnyRows& a, const AnyRows& b);

/// The rows that are stored, each once: those without numbers of their own share one.
std::vector<std::size_t> stored_rows(const AnyRows& rows);

}  // namespace detail

}  // namespace sigmax
