#include "support/result_table.hpp"

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include <fmt/format.h>

#include "support/csv.hpp"
#include "support/json.hpp"
#include "support/output.hpp"

namespace sigmax::apps {
namespace {

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

/// Whether nothing is known of the spread: one number alone, or zeros only.
bool without_bounds(const Interval& interval) {
  return std::isinf(interval.half_width) || (interval.mean == 0.0 && interval.half_width == 0.0);
}

std::string text_of(const Cell& cell, const ResultColumn& column) {
  if (!cell.shown().empty()) return cell.shown();
  const auto shown = [&](double value, bool sign) {
    return column.sized ? sized_text(column.scale * value, column.digits, sign)
                        : number_text(column.scale * value, column.digits, sign);
  };
  return std::visit(
      Overloaded{[](std::monostate) { return std::string(); }, [](const std::string& words) { return words; },
                 [&](double value) { return shown(value, column.sign); },
                 [](std::int64_t count) { return fmt::format("{}", count); },
                 [&](const Interval& interval) {
                   if (column.sign && interval.mean == 0.0 && interval.half_width == 0.0)
                     return std::string("none differs");
                   return shown(interval.mean, column.sign) + " ± " + shown(interval.half_width, false);
                 }},
      cell.value());
}

std::string csv_number(double value) { return std::isfinite(value) ? shortest(value) : ""; }

std::string csv_of(const Cell& cell, const ResultColumn& column) {
  return std::visit(Overloaded{[](std::monostate) { return std::string(); },
                               [](const std::string& words) { return csv_field(words); },
                               [](double value) { return csv_number(value); },
                               [](std::int64_t count) { return fmt::format("{}", count); },
                               [&](const Interval& interval) {
                                 if (!column.interval) return csv_number(interval.mean);
                                 if (without_bounds(interval)) return csv_number(interval.mean) + ",,";
                                 return fmt::format("{},{},{}", shortest(interval.mean), shortest(interval.lower()),
                                                    shortest(interval.upper()));
                               }},
                    cell.value());
}

Json json_of(const Cell& cell) {
  return std::visit(Overloaded{[](std::monostate) { return Json(); }, [](const Interval& i) { return as_json(i); },
                               [](const auto& value) { return Json(value); }},
                    cell.value());
}

bool is_empty(const Cell& cell) { return std::holds_alternative<std::monostate>(cell.value()); }

}  // namespace

std::string number_text(double value, int digits, bool sign) {
  constexpr double greatest = 1e9;  // longer numbers are unreadable
  if (std::isnan(value)) return "–";
  if (std::isinf(value)) return value > 0.0 ? (sign ? "+∞" : "∞") : "−∞";
  if (std::abs(value) >= greatest) return sign ? fmt::format("{:+.3g}", value) : fmt::format("{:.3g}", value);
  return sign ? fmt::format("{:+.{}f}", value, digits) : fmt::format("{:.{}f}", value, digits);
}

std::string sized_text(double value, int digits, bool sign) {
  const bool vanishes = value != 0.0 && std::abs(value) < 0.5 * std::pow(10.0, -digits);
  if (!vanishes) return number_text(value, digits, sign);
  return sign ? fmt::format("{:+.2g}", value) : fmt::format("{:.2g}", value);
}

ResultTable::ResultTable(std::vector<ResultColumn> columns) : columns_(std::move(columns)) {
  if (columns_.empty()) throw std::invalid_argument("a table needs a column");
}

void ResultTable::check(const std::vector<Cell>& cells) const {
  if (cells.size() != columns_.size())
    throw std::invalid_argument(fmt::format("a row of {} cells in a table of {}", cells.size(), columns_.size()));
}

void ResultTable::row(std::vector<Cell> cells) {
  check(cells);
  rows_.push_back(std::move(cells));
}

void ResultTable::rule() { rows_.emplace_back(); }

std::string ResultTable::text(std::size_t width) const {
  std::vector<TextTable::Column> shown;
  for (const ResultColumn& column : columns_)
    if (!column.header.empty())
      shown.push_back(
          {column.unit.empty() ? column.header : column.header + ", " + column.unit, column.align, column.group});
  TextTable table(std::move(shown));
  for (const auto& row : rows_) {
    if (row.empty()) {
      table.rule();
      continue;
    }
    std::vector<std::string> cells;
    for (std::size_t i = 0; i < row.size(); ++i)
      if (!columns_[i].header.empty()) cells.push_back(text_of(row[i], columns_[i]));
    table.row(std::move(cells));
  }
  return table.text(width);
}

void ResultTable::print(std::size_t width) const {
  const std::string whole = text(width);
  std::fwrite(whole.data(), 1, whole.size(), stdout);
}

std::string ResultTable::csv() const {
  std::string text = csv_header();
  for (const auto& row : rows_)
    if (!row.empty()) text += csv_line(row);
  return text;
}

std::string ResultTable::csv_header() const {
  std::string text;
  for (const ResultColumn& column : columns_) {
    if (column.key.empty()) continue;
    text += text.empty() ? "" : ",";
    text += csv_field(column.key);
    if (column.interval) text += "," + csv_field(column.key + "_lower") + "," + csv_field(column.key + "_upper");
  }
  return text + "\n";
}

std::string ResultTable::csv_line(const std::vector<Cell>& cells) const {
  check(cells);
  std::string text;
  bool first = true;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i].key.empty()) continue;
    if (!std::exchange(first, false)) text += ",";
    text += csv_of(cells[i], columns_[i]);
    if (columns_[i].interval && !std::holds_alternative<Interval>(cells[i].value())) text += ",,";
  }
  return text + "\n";
}

nlohmann::ordered_json ResultTable::json() const {
  Json all = Json::object();
  for (const auto& row : rows_) {
    if (row.empty()) continue;
    Json& one = all[std::get<std::string>(row.front().value())] = Json::object();
    for (std::size_t i = 1; i < row.size(); ++i)
      if (!columns_[i].key.empty() && !is_empty(row[i])) one[columns_[i].key] = json_of(row[i]);
  }
  return all;
}

nlohmann::ordered_json ResultTable::page() const {
  Json columns = Json::array(), rows = Json::array();
  for (const ResultColumn& column : columns_)
    if (!column.header.empty())
      columns.push_back({{"header", column.unit.empty() ? column.header : column.header + ", " + column.unit},
                         {"group", column.group},
                         {"left", column.align == Align::left},
                         {"key", column.key}});
  for (const auto& row : rows_) {
    Json cells = Json::array();
    for (std::size_t i = 0; i < row.size(); ++i)
      if (!columns_[i].header.empty())
        cells.push_back({{"text", text_of(row[i], columns_[i])}, {"value", json_of(row[i])}});
    rows.push_back(std::move(cells));
  }
  return {{"columns", std::move(columns)}, {"rows", std::move(rows)}};
}

nlohmann::ordered_json as_json(const Interval& interval) {
  if (without_bounds(interval)) return {{"mean", interval.mean}, {"lower", nullptr}, {"upper", nullptr}};
  return {{"mean", interval.mean}, {"lower", interval.lower()}, {"upper", interval.upper()}};
}

}  // namespace sigmax::apps
