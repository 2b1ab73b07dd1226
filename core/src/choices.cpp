#include <sigmax/core/choices.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace sigmax {

void Choices::add_row(double none, const std::vector<Entry>& entries) {
  first_.push_back(values_.size());
  none_.push_back(none);
  for (const auto& [column, value] : entries) add(column, value);
}

void Choices::add(std::size_t column, double value) {
  if (none_.empty()) throw std::invalid_argument("a column was added, but there is no row");
  if (column >= std::numeric_limits<std::uint32_t>::max())
    throw std::invalid_argument("column " + std::to_string(column) + " is beyond 32 bits");
  if (first_.back() < columns_.size() && columns_.back() >= column)
    throw std::invalid_argument("the columns of row " + std::to_string(rows() - 1) + " do not ascend: " +
                                std::to_string(column) + " follows " + std::to_string(columns_.back()));
  columns_.push_back(static_cast<std::uint32_t>(column));
  values_.push_back(value);
  width_ = std::max(width_, column + 1);
}

void Choices::clear() {
  first_.clear();
  columns_.clear();
  values_.clear();
  none_.clear();
  width_ = 0;
}

}  // namespace sigmax
