// Compositions of dense tables: compiled once for every instruction set, chosen when the program runs.
//
// A tile of the result, some rows by some vectors, stays in registers while one index j after the other adds its terms.
// What a tile reads of `left` is a strip: as many columns as it has, copied together where the table is large.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/tiled.cpp"
#include "kernels/targets.hpp"
// The order of these matters.
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include <sigmax/core/kernels/tiled.hpp>

#include "kernels/flush.hpp"

HWY_BEFORE_NAMESPACE();
namespace sigmax::kernels::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Doubles = hn::ScalableTag<double>;
using Vector = hn::Vec<Doubles>;
constexpr Doubles all;
constexpr std::size_t lanes = hn::MaxLanes(all);

// A tile fills the registers, with what it reads and multiplies beside it.
constexpr bool many_registers = HWY_TARGET == HWY_AVX3 || HWY_ARCH_ARM_A64;
constexpr std::size_t tile_rows = many_registers ? 8 : 6, tile_vectors = many_registers ? 3 : 2;
constexpr std::size_t tile_columns = tile_vectors * lanes;
// The rows of a tile lie in the first cache while the strips of a block, which is in the second, pass by.
constexpr std::size_t inner_block = 512, column_block = 144;
static_assert(column_block % tile_columns == 0);
// Up to this size strips are read where they are.
constexpr std::size_t in_place_inner = 128, in_place_columns = 256;

HWY_INLINE Vector greater(Vector term, Vector sum) {
#if HWY_ARCH_X86
  return hn::Max(term, sum);  // as std::max has it: the sum if they are equal, or the term is no number
#else
  return hn::IfThenElse(hn::Lt(sum, term), term, sum);
#endif
}
HWY_INLINE Vector product(Max, Vector weight, Vector value) { return hn::Mul(weight, value); }
HWY_INLINE Vector product(MaxMin, Vector weight, Vector value) { return hn::Min(weight, value); }
template <SelectiveAlgebra A>
HWY_INLINE Vector added(A, Vector weight, Vector value, Vector sum) {
  return greater(product(A{}, weight, value), sum);
}
HWY_INLINE Vector added(Sigma, Vector weight, Vector value, Vector sum) { return hn::MulAdd(weight, value, sum); }

/// Numbers that lie `step` apart from row to row, and one after the other in a row.
struct Rows {
  const double* first;
  std::size_t step;
  HWY_INLINE const double* row(std::size_t r) const { return first + r * step; }
};

/// sums(r, ·) = sums(r, ·) ⊕ ⊕_j weights(r, j) ⊗ strip(j, ·), for R rows and V vectors.
template <class A, std::size_t R, std::size_t V>
HWY_INLINE void add(std::size_t inner, Rows weights, Rows strip, Vector (&sums)[R][V]) {
  for (std::size_t j = 0; j < inner; ++j) {
    Vector values[V];
    for (std::size_t v = 0; v < V; ++v) values[v] = hn::LoadU(all, strip.row(j) + v * lanes);
    for (std::size_t r = 0; r < R; ++r) {
      const Vector weight = hn::Set(all, weights.row(r)[j]);
      for (std::size_t v = 0; v < V; ++v) sums[r][v] = added(A{}, weight, values[v], sums[r][v]);
    }
  }
}

/// The same where the sums are; `fresh` if they are not there yet and begin as zero.
template <class A, std::size_t R, std::size_t V>
HWY_NOINLINE void add_tile(std::size_t inner, Rows weights, Rows strip, double* out, std::size_t step, bool fresh) {
  Vector sums[R][V];
  for (std::size_t r = 0; r < R; ++r)
    for (std::size_t v = 0; v < V; ++v) sums[r][v] = fresh ? hn::Zero(all) : hn::LoadU(all, out + r * step + v * lanes);
  add<A>(inner, weights, strip, sums);
  for (std::size_t r = 0; r < R; ++r)
    for (std::size_t v = 0; v < V; ++v) hn::StoreU(sums[r][v], all, out + r * step + v * lanes);
}

/// The same for up to a tile's vectors.
template <class A, std::size_t R>
HWY_INLINE void add_vectors(std::size_t vectors, std::size_t inner, Rows weights, Rows strip, double* out,
                            std::size_t step, bool fresh) {
  if (vectors == 1)
    add_tile<A, R, 1>(inner, weights, strip, out, step, fresh);
  else if (vectors == 2)
    add_tile<A, R, 2>(inner, weights, strip, out, step, fresh);
  else
    add_tile<A, R, tile_vectors>(inner, weights, strip, out, step, fresh);
}

/// The same for up to a tile's columns. Those that do not fill a vector go through a copy.
template <class A, std::size_t R>
HWY_INLINE void add_columns(std::size_t columns, std::size_t inner, Rows weights, Rows strip, double* out,
                            std::size_t step, bool fresh) {
  const std::size_t vectors = hwy::DivCeil(columns, lanes);
  if (columns == vectors * lanes) {
    add_vectors<A, R>(vectors, inner, weights, strip, out, step, fresh);
    return;
  }
  double copy[R * tile_columns];
  for (std::size_t r = 0; r < R && !fresh; ++r) std::copy_n(out + r * step, columns, copy + r * tile_columns);
  add_vectors<A, R>(vectors, inner, weights, strip, copy, tile_columns, fresh);
  for (std::size_t r = 0; r < R; ++r) std::copy_n(copy + r * tile_columns, columns, out + r * step);
}

/// action(r, constant) for every group of rows that makes a tile: as many as fit, then fewer.
template <std::size_t Most, class Action>
HWY_INLINE void for_each_group(std::size_t rows, const Action& action) {
  std::size_t r = 0;
  for (; r + Most <= rows; r += Most) action(r, std::integral_constant<std::size_t, Most>{});
  if (Most > 4 && rows - r >= 4) action(r, std::integral_constant<std::size_t, 4>{}), r += 4;
  if (rows - r >= 2) action(r, std::integral_constant<std::size_t, 2>{}), r += 2;
  if (rows - r >= 1) action(r, std::integral_constant<std::size_t, 1>{});
}

/// Memory that a thread keeps for its next composition.
double* room(std::vector<double>& kept, std::size_t size) {
  if (kept.size() < size) kept.resize(size);
  return kept.data();
}

/// A strip of left(j0 + j, k + ·), filled up with zeros to whole vectors, `width` numbers a row.
void copy_strip(const DenseParts& parts, std::size_t j0, std::size_t inner, std::size_t k, std::size_t width,
                double* out) {
  const std::size_t columns = std::min(width, parts.columns - k);
  for (std::size_t j = 0; j < inner; ++j, out += width) {
    const double* const row = parts.left + (j0 + j) * parts.columns + k;
    if (columns == width) {
      for (std::size_t v = 0; v < width; v += lanes) hn::StoreU(hn::LoadU(all, row + v), all, out + v);
    } else {
      std::fill(std::copy_n(row, columns, out), out + width, 0.0);
    }
  }
}

/// A composition whose strips are copied.
template <class A>
void compose_copied(const DenseParts& parts) {
  thread_local std::vector<double> kept;
  double* const strips = room(kept, std::min(inner_block, parts.inner) * column_block);
  for (std::size_t k0 = 0; k0 < parts.columns; k0 += column_block) {
    const std::size_t columns = std::min(column_block, parts.columns - k0);
    for (std::size_t j0 = 0; j0 < parts.inner; j0 += inner_block) {
      const std::size_t inner = std::min(inner_block, parts.inner - j0);
      for (std::size_t k = 0; k < columns; k += tile_columns)
        copy_strip(parts, j0, inner, k0 + k, tile_columns, strips + k * inner);
      for_each_group<tile_rows>(parts.rows, [&](std::size_t i, auto group) HWY_ATTR {
        for (std::size_t k = 0; k < columns; k += tile_columns)
          add_columns<A, group>(std::min(tile_columns, columns - k), inner,
                                {parts.right + i * parts.inner + j0, parts.inner}, {strips + k * inner, tile_columns},
                                parts.result + i * parts.columns + k0 + k, parts.columns, j0 == 0);
      });
    }
  }
}

/// A composition whose strips are read where they are, but for columns that do not fill a vector.
template <class A>
void compose_in_place(const DenseParts& parts) {
  const auto compose_strip = [&](std::size_t k, std::size_t columns, Rows strip) HWY_ATTR {
    for_each_group<tile_rows>(parts.rows, [&](std::size_t i, auto group) HWY_ATTR {
      add_columns<A, group>(columns, parts.inner, {parts.right + i * parts.inner, parts.inner}, strip,
                            parts.result + i * parts.columns + k, parts.columns, true);
    });
  };
  const std::size_t filled = parts.columns / lanes * lanes;
  for (std::size_t k = 0; k < filled; k += tile_columns)
    compose_strip(k, std::min(tile_columns, filled - k), {parts.left + k, parts.columns});
  if (filled == parts.columns) return;
  double rest[in_place_inner * lanes];
  copy_strip(parts, 0, parts.inner, filled, lanes, rest);
  compose_strip(filled, parts.columns - filled, {rest, lanes});
}

template <class A>
void compose_all(const DenseParts& parts) {
  if (parts.inner <= in_place_inner && parts.columns <= in_place_columns)
    compose_in_place<A>(parts);
  else
    compose_copied<A>(parts);
}

// With winners a tile is smaller, for their indices lie in registers, too.
constexpr std::size_t winner_rows = many_registers ? 4 : 2;

/// Up to a tile's columns of R rows, and the first index that attains each number; strips as they are copied.
template <class A, std::size_t R>
void compose_with_winners(std::size_t columns, std::size_t inner, Rows weights, const double* strip, double* out,
                          Winner* first, std::size_t step) {
  constexpr hn::Rebind<std::int32_t, Doubles> integers;
  Vector sums[R][tile_vectors], firsts[R][tile_vectors];
  for (std::size_t r = 0; r < R; ++r)
    for (std::size_t v = 0; v < tile_vectors; ++v) sums[r][v] = firsts[r][v] = hn::Zero(all);
  Vector index = hn::Zero(all);
  const Vector one = hn::Set(all, 1.0);
  for (std::size_t j = 0; j < inner; ++j, strip += tile_columns, index = hn::Add(index, one)) {
    Vector values[tile_vectors];
    for (std::size_t v = 0; v < tile_vectors; ++v) values[v] = hn::LoadU(all, strip + v * lanes);
    for (std::size_t r = 0; r < R; ++r) {
      const Vector weight = hn::Set(all, weights.row(r)[j]);
      for (std::size_t v = 0; v < tile_vectors; ++v) {
        const Vector term = product(A{}, weight, values[v]);
        firsts[r][v] = hn::IfThenElse(hn::Lt(sums[r][v], term), index, firsts[r][v]);
        sums[r][v] = greater(term, sums[r][v]);
      }
    }
  }
  double numbers[tile_columns];
  std::int32_t indices[tile_columns];
  for (std::size_t r = 0; r < R; ++r) {
    for (std::size_t v = 0; v < tile_vectors; ++v) {
      hn::StoreU(sums[r][v], all, numbers + v * lanes);
      hn::StoreU(hn::DemoteTo(integers, firsts[r][v]), integers, indices + v * lanes);
    }
    std::copy_n(numbers, columns, out + r * step);
    std::copy_n(indices, columns, first + r * step);
  }
}

template <class A>
void compose_all_with_winners(const DenseParts& parts, Winner* first) {
  thread_local std::vector<double> kept;
  double* const strip = room(kept, parts.inner * tile_columns);
  for (std::size_t k = 0; k < parts.columns; k += tile_columns) {
    copy_strip(parts, 0, parts.inner, k, tile_columns, strip);
    for_each_group<winner_rows>(parts.rows, [&](std::size_t i, auto group) HWY_ATTR {
      compose_with_winners<A, group>(
          std::min(tile_columns, parts.columns - k), parts.inner, {parts.right + i * parts.inner, parts.inner}, strip,
          parts.result + i * parts.columns + k, first + i * parts.columns + k, parts.columns);
    });
  }
}

/// The least of all numbers.
double least_of_all(const double* numbers, std::size_t size) {
  double least = std::numeric_limits<double>::infinity();
  std::size_t i = 0;
  if (size >= lanes) {
    Vector smallest = hn::Set(all, least);
    for (; i + lanes <= size; i += lanes) smallest = hn::Min(smallest, hn::LoadU(all, numbers + i));
    least = hn::GetLane(hn::MinOfLanes(all, smallest));
  }
  for (; i < size; ++i) least = std::min(least, numbers[i]);
  return least;
}

void compose_sum(const DenseParts& parts) { compose_all<Sigma>(parts); }
void compose_max(const DenseParts& parts) { compose_all<Max>(parts); }
void compose_max_min(const DenseParts& parts) { compose_all<MaxMin>(parts); }
void winners_max(const DenseParts& parts, Winner* first) { compose_all_with_winners<Max>(parts, first); }
void winners_max_min(const DenseParts& parts, Winner* first) { compose_all_with_winners<MaxMin>(parts, first); }

}  // namespace
}  // namespace sigmax::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sigmax::kernels {
namespace {

HWY_EXPORT(compose_sum);
HWY_EXPORT(compose_max);
HWY_EXPORT(compose_max_min);
HWY_EXPORT(winners_max);
HWY_EXPORT(winners_max_min);
HWY_EXPORT(least_of_all);

constexpr double least_normal = std::numeric_limits<double>::min();

/// The least and the greatest of the numbers that are not zero.
struct Range {
  double least = std::numeric_limits<double>::infinity(), greatest = 0.0;
};
Range range_of(const double* numbers, std::size_t size) {
  Range range;
  for (std::size_t i = 0; i < size; ++i) {
    if (numbers[i] != 0.0) range.least = std::min(range.least, numbers[i]);
    range.greatest = std::max(range.greatest, numbers[i]);
  }
  return range;
}

/// Composes by products, without arithmetic on subnormal numbers. Where a result is so small that what was lost
/// matters, it is composed again of larger numbers: scaling by powers of two rounds nothing.
template <class Compose>
bool compose_products(const DenseParts& parts, double least_exact, const Compose& compose, Winner* first = nullptr) {
  const std::size_t size = parts.rows * parts.columns;
  {
    const FlushedSubnormals flushed;
    compose(parts);
  }
  if (HWY_DYNAMIC_DISPATCH(least_of_all)(parts.result, size) >= least_exact) return true;
  const Range right = range_of(parts.right, parts.rows * parts.inner);
  const Range left = range_of(parts.left, parts.inner * parts.columns);
  if (!(right.least * left.least < least_normal)) return true;  // no product is lost
  if (!(right.greatest < 0x1p200 && left.greatest < 0x1p200)) return false;
  const auto raised = [](const double* numbers, std::size_t count) {
    std::vector<double> result(numbers, numbers + count);
    for (double& number : result) number *= 0x1p256;
    return result;
  };
  const auto raised_right = raised(parts.right, parts.rows * parts.inner);
  const auto raised_left = raised(parts.left, parts.inner * parts.columns);
  {
    const FlushedSubnormals flushed;
    compose({raised_right.data(), raised_left.data(), parts.result, parts.rows, parts.inner, parts.columns});
  }
  for (std::size_t k = 0; k < size; ++k) {
    parts.result[k] *= 0x1p-512;
    if (first != nullptr && parts.result[k] == 0.0) first[k] = 0;
  }
  return true;
}

}  // namespace

bool compose_tiled(Sigma, const DenseParts& parts) {
  // Each term may have lost up to the least normal number: that is below rounding in sums above this.
  const double least_exact = static_cast<double>(parts.inner) * least_normal * 0x1p54;
  return compose_products(parts, least_exact, HWY_DYNAMIC_DISPATCH(compose_sum));
}
bool compose_tiled(Max, const DenseParts& parts) {
  return compose_products(parts, least_normal, HWY_DYNAMIC_DISPATCH(compose_max));
}
bool compose_tiled(MaxMin, const DenseParts& parts) {
  HWY_DYNAMIC_DISPATCH(compose_max_min)(parts);
  return true;
}
bool compose_tiled(Max, const DenseParts& parts, Winner* first) {
  const auto compose = [first](const DenseParts& some) { HWY_DYNAMIC_DISPATCH(winners_max)(some, first); };
  return compose_products(parts, least_normal, compose, first);
}
bool compose_tiled(MaxMin, const DenseParts& parts, Winner* first) {
  HWY_DYNAMIC_DISPATCH(winners_max_min)(parts, first);
  return true;
}

}  // namespace sigmax::kernels
#endif
