#include <sigmax/core/compose.hpp>

#include <cstddef>
#include <utility>
#include <variant>

#include "belief.hpp"
#include "kernels/transpose.hpp"
#include "kernels/unbounded_row.hpp"

namespace sigmax::detail {
namespace {

/// The columns of a table, each as the entries of a row, without a copy.
struct ColumnsOfTable {
  struct Column {
    const double* first;
    std::size_t step, rows;
    std::size_t size() const { return rows; }
    std::size_t index(std::size_t k) const { return k; }
    double value(std::size_t k) const { return first[k * step]; }
  };
  const Table& table;
  Column entries(std::size_t column) const { return {table.data() + column, table.columns(), table.rows()}; }
};

}  // namespace

void compose(const AnyAlgebra& middle, const AnyRows& left, const AnyRows& right, bool normalized, AnyRows& result) {
  if (&left == &result || &right == &result) {
    AnyRows copy = Table(0, 0);
    compose(middle, left, right, normalized, copy);
    result = std::move(copy);
    return;
  }
  kernels::compose(middle, left, right, result);
  if (!normalized || !middle.scales) return;
  with_scaling(middle, [&](auto a) {
    std::visit(
        [a](auto& rows) {
          for (std::size_t i = 0; i < rows.rows(); ++i) settle(a, rows.values(i));
        },
        result);
  });
}

Table composed(const AnyAlgebra& middle, const AnyRows& left, const Table& right, bool normalized) {
  Table result(0, 0);
  kernels::compose(middle, left, right, result);
  if (normalized) with(middle, [&](auto a) { settle(a, result.values()); });
  return result;
}

void compose_logs(const AnyAlgebra& middle, const AnyRows& left, std::span<const double> right, const Outcomes& to,
                  std::span<double> result) {
  const auto compose_columns = [&](const auto& columns) {
    with_scaling(middle, [&](auto a) {
      assign_logs(a, to, result, [&](std::size_t k) {
        const auto column = columns.entries(k);
        return log_combine(
            a, column.size(), [&](std::size_t j) { return right[column.index(j)]; },
            [&](std::size_t j) { return column.value(j); });
      });
    });
  };
  if (const auto* const table = std::get_if<Table>(&left)) {
    compose_columns(ColumnsOfTable{*table});
  } else {
    AnyRows columns = SparseRows{};
    kernels::transpose(left, columns);
    compose_columns(std::get<SparseRows>(columns));
  }
}

kernels::UnboundedRow carried_back(const AnyAlgebra& middle, const kernels::Evidence& left, const AnyRows& right) {
  std::vector<ScaledNumber> numbers(left.logs_or_plain.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
    numbers[i] = middle.scales ? number_of(left, i) : ScaledNumber{left.logs_or_plain[i]};
  kernels::UnboundedRow result;
  result.assign_carried_back(right, kernels::UnboundedRow(std::move(numbers)), middle);
  return result;
}

}  // namespace sigmax::detail
