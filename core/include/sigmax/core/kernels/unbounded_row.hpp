#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <sigmax/core/rows.hpp>
#include <sigmax/core/scaled_number.hpp>
#include <sigmax/core/uncertainty.hpp>

namespace sigmax::kernels {

using sigmax::detail::AnyAlgebra;

/// What a likelihood knows: where ⊗ scales its logarithms and its numbers, unless these are not known; else the numbers
/// as they are.
struct Evidence {
  std::span<const ScaledNumber> numbers;
  std::span<const double> logs_or_plain;
};

/// The winners of one relation of a chain, for every number of a row. Where ⊗ scales, the first index that attains the
/// number, 0 if none does. Else all indices that attained more than those before them, and what they attained: a later
/// minimum may make any of them a tie.
struct Winners {
  using Index = std::uint32_t;  // because routes through long chains store many
  struct Attempt {
    Index index;
    double value;
  };
  std::vector<Index> first;
  std::vector<std::vector<Attempt>> attempts;
};

/// A row of numbers that never underflow, however many tables it passes through.
class UnboundedRow {
 public:
  UnboundedRow() = default;
  UnboundedRow(std::size_t size, double value);
  explicit UnboundedRow(std::span<const double> values);
  explicit UnboundedRow(std::vector<ScaledNumber> numbers) : numbers_(std::move(numbers)) {}

  std::size_t size() const { return numbers_.size(); }
  std::size_t capacity() const { return numbers_.capacity(); }
  void clear() { numbers_.clear(); }
  const std::vector<ScaledNumber>& numbers() const& { return numbers_; }
  ScaledNumber operator[](std::size_t i) const { return numbers_[i]; }
  ScaledNumber& operator[](std::size_t i) { return numbers_[i]; }

  /// Index of the greatest, the lowest on a tie; 0 of none.
  std::size_t greatest() const;
  bool is_zero() const;
  ScaledNumber total(const AnyAlgebra& algebra) const;

  double log(std::size_t i, const AnyAlgebra& algebra) const;
  double log_total(const AnyAlgebra& algebra) const;

  /// The logarithms, or, where ⊗ does not scale, the numbers as they are.
  Table logs_or_plain(const AnyAlgebra& algebra) const;

  /// The numbers conditioned; some is not zero.
  Table conditioned(const AnyAlgebra& algebra) const;

  /// Multiplies by evidence. Returns false, and is unchanged, if that leaves nothing.
  bool take(const Evidence& evidence, const AnyAlgebra& algebra);

  /// number(k) = ⊕_j before(j) ⊗ left(j, k), where `before` is another row; `winners` may be null.
  void assign_composition(const AnyRows& left, const UnboundedRow& before, const AnyAlgebra& algebra, Winners* winners);

  /// number(i) = ⊕_j rows(i, j) ⊗ after(j), where `after` is another row: evidence carried back.
  void assign_carried_back(const AnyRows& rows, const UnboundedRow& after, const AnyAlgebra& algebra);

 private:
  std::vector<ScaledNumber> numbers_;
  std::vector<double> doubles_;  // sums or weights of one band; kept for its memory
};

}  // namespace sigmax::kernels
