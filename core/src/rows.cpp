#include <sigmax/core/rows.hpp>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace sigmax {

Table::Table(std::size_t rows, std::size_t columns, double value) {
  reshape(rows, columns);
  std::fill_n(data(), size(), value);
}

Table::Table(std::span<const double> row) {
  reshape(1, row.size());
  std::copy(row.begin(), row.end(), data());
}

void Table::grow() { heap_.resize(size()); }

void Table::fill_rows(std::span<const std::size_t> rows, double value) {
  for (const std::size_t r : rows) std::fill_n(row(r).data(), columns_, value);
}

BandedRows::BandedRows(std::initializer_list<BandOfRow> rows) {
  for (const BandOfRow& row : rows) append(row.first, row.values);
}

void BandedRows::append(std::size_t first, std::span<const double> values) {
  columns_ = std::max(columns_, first + values.size());
  rows_.push_back({first, values_.size(), values.size()});
  values_.insert(values_.end(), values.begin(), values.end());
}

SparseRows::SparseRows(std::initializer_list<std::initializer_list<Entry>> rows) {
  for (const auto& row : rows) append(row);
}

SparseRows::SparseRows(std::size_t columns, std::span<const std::size_t> ends, Columns indices, Values values)
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

void SparseRows::append(std::span<const Entry> row) {
  for (const Entry& entry : row) append_entry(entry.column, entry.value);
  end_row();
}

void SparseRows::append_entry(std::size_t column, double value) {
  if (column > std::numeric_limits<std::uint32_t>::max())
    throw std::invalid_argument("sparse rows have columns below 2^32, not " + std::to_string(column));
  columns_ = std::max(columns_, column + 1);
  indices_.push_back(static_cast<std::uint32_t>(column));
  values_.push_back(value);
}

void SparseRows::end_row() {
  extents_.push_back({end_, values_.size() - end_});
  end_ = values_.size();
}

SparseRows::Room SparseRows::room(std::size_t most) {
  indices_.resize(end_ + most);
  values_.resize(end_ + most);
  return {indices_.data() + end_, values_.data() + end_};
}

void SparseRows::end_row(std::size_t size) {
  indices_.resize(end_ + size);
  values_.resize(end_ + size);
  end_row();
}

void SparseRows::clear(std::size_t columns) {
  columns_ = columns;
  extents_.clear();
  indices_.clear();
  values_.clear();
  end_ = 0;
}

void SparseRows::reserve(std::size_t rows, std::size_t numbers) {
  extents_.reserve(rows);
  indices_.reserve(numbers);
  values_.reserve(numbers);
}

void SparseRows::fill_rows(std::span<const std::size_t> rows, double value) {
  if (rows.empty()) return;
  for (std::size_t column = 0; column < columns_; ++column) append_entry(column, value);
  for (const std::size_t row : rows) extents_[row] = {end_, columns_};
  end_ = values_.size();
}

AnyRows::AnyRows(const AnyRows&) = default;
AnyRows::AnyRows(AnyRows&&) noexcept = default;
AnyRows& AnyRows::operator=(const AnyRows&) = default;
AnyRows& AnyRows::operator=(AnyRows&&) noexcept = default;
AnyRows::~AnyRows() = default;

Table& as_table(AnyRows& rows) {
  if (Table* const table = std::get_if<Table>(&rows)) return *table;
  return rows.emplace<Table>(std::size_t{0}, std::size_t{0});
}

Table dense_table(const AnyRows& rows) {
  return std::visit(
      [](const auto& stored) {
        Table result(stored.rows(), stored.columns());
        for (std::size_t r = 0; r < stored.rows(); ++r) {
          const auto entries = stored.entries(r);
          for (std::size_t k = 0; k < entries.size(); ++k) result(r, entries.index(k)) = entries.value(k);
        }
        return result;
      },
      rows);
}

namespace detail {
std::size_t AnyEntries::place_of(std::size_t column) const {
  if (columns == nullptr) return column >= first && column - first < size() ? column - first : size();
  const auto found = std::lower_bound(columns, columns + size(), column);
  return found != columns + size() && *found == column ? static_cast<std::size_t>(found - columns) : size();
}

double AnyEntries::at(std::size_t column) const {
  const std::size_t k = place_of(column);
  return k < size() ? value(k) : 0.0;
}

AnyEntries entries_of(const AnyRows& rows, std::size_t r) {
  return std::visit([r](const auto& stored) -> AnyEntries { return stored.entries(r); }, rows);
}

std::span<double> values_of(AnyRows& rows, std::size_t r) {
  return std::visit([r](auto& stored) { return stored.values(r); }, rows);
}

Table dense_row(const AnyRows& rows, std::size_t r) {
  Table row(1, std::visit([](const auto& stored) { return stored.columns(); }, rows));
  const AnyEntries entries = entries_of(rows, r);
  for (std::size_t k = 0; k < entries.size(); ++k) row(0, entries.index(k)) = entries.value(k);
  return row;
}

std::vector<double> column_of(const AnyRows& rows, std::size_t column) {
  return std::visit(
      [column](const auto& stored) {
        std::vector<double> result(stored.rows());
        for (std::size_t r = 0; r < result.size(); ++r) result[r] = stored.at(r, column);
        return result;
      },
      rows);
}

std::vector<std::size_t> stored_rows(const AnyRows& rows) {
  std::vector<std::size_t> result;
  std::visit(
      [&](const auto& stored) {
        std::vector<bool> done(stored.stored() + 1, false);  // by where a row begins
        for (std::size_t r = 0; r < stored.rows(); ++r) {
          if (done[stored.offset(r)]) continue;
          done[stored.offset(r)] = true;
          result.push_back(r);
        }
      },
      rows);
  return result;
}

bool same_numbers(const AnyRows& a, const AnyRows& b) {
  const std::size_t rows = std::visit([](const auto& stored) { return stored.rows(); }, a);
  for (std::size_t r = 0; r < rows; ++r)
    if (dense_row(a, r).values() != dense_row(b, r).values()) return false;
  return true;
}

}  // namespace detail

}  // namespace sigmax
