#include <sigmax/core/choices.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>
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

void check::choices(const Choices& choices, double excluded, std::string_view name) {
  const auto refuse = [&](std::size_t row, const std::string& column, double value) {
    if (std::isfinite(value) || value == excluded) return;
    std::ostringstream text;
    text << name << " of row " << row << " and " << column << " is " << value << "; expected a finite number or "
         << excluded;
    throw std::invalid_argument(text.str());
  };
  for (std::size_t row = 0; row < choices.rows(); ++row) {
    refuse(row, "no column", choices.none(row));
    const auto entries = choices.entries(row);
    for (std::size_t k = 0; k < entries.size(); ++k)
      refuse(row, "column " + std::to_string(entries.index(k)), entries.value(k));
  }
}

void check::no_column_left(std::size_t row) {
  throw std::domain_error("row " + std::to_string(row) +
                          " finds no column that earlier rows can leave to it, and may not be without one");
}

}  // namespace sigmax
