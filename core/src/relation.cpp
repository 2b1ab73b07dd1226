#include <sigmax/core/relation.hpp>

#include <algorithm>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

namespace sigmax::detail {
void prove_entries(const Outcomes& variable, check::Row row, const AnyEntries& entries, const AnyAlgebra& algebra,
                   std::string_view name_of_total) {
  for (std::size_t k = 0; k < entries.size(); ++k) {
    check::ascending(variable, row, k == 0 ? 0 : entries.index(k - 1) + 1, entries.index(k));
    check::value(variable, row, entries.index(k), entries.value(k), 1.0 + normalization_tolerance);
  }
  check::total(variable, row, total(algebra, entries.values), name_of_total);
}

bool are_right(const Outcomes& to, const Outcomes& from, const AnyRows& rows, const AnyAlgebra& algebra) {
  bool right = std::visit(
      [&](const auto& stored) { return stored.rows() == from.size() && stored.columns() == to.size(); }, rows);
  for (const std::size_t r : stored_rows(rows)) right = right && is_normalized(entries_of(rows, r).values, algebra);
  return right;
}

const Table& table_of(const Outcomes& to, const Outcomes& from, const AnyRows& rows) {
  if (const Table* const table = std::get_if<Table>(&rows)) return *table;
  throw std::invalid_argument("'" + to.name() + "' given '" + from.name() +
                              "' is stored sparsely, not as a table; call dense() first");
}

void write(std::ostream& out, const Outcomes& to, const Outcomes& from, const AnyRows& rows) {
  for (std::size_t i = 0; i < from.size(); ++i) {
    out << to.name() << " given " << from.name() << " = " << from.label(i) << ':';
    const AnyEntries row = entries_of(rows, i);
    for (std::size_t k = 0; k < row.size(); ++k)
      out << (k > 0 ? ", " : " ") << to.label(row.index(k)) << ' ' << row.value(k);
    out << '\n';
  }
}

}  // namespace sigmax::detail
