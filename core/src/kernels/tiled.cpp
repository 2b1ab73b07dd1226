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
#include <limits>
#include <type_traits>
#include <vector>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "kernels/tiled.hpp"

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

/// Where a tile of the result is.
struct Out {
  double* numbers;
  std::size_t step;
};

/// out(r, ·) = out(r, ·) ⊕ ⊕_j weights(r, j) ⊗ strip(j, ·), for R rows and V vectors; `fresh` if there is nothing in
/// `out` yet.
template <class A, std::size_t R, std::size_t V>
HWY_NOINLINE void add_tile(std::size_t inner, Rows weights, Rows strip, Out out, bool fresh) {
  Vector sums[R][V];
  for (std::size_t r = 0; r < R; ++r)
    for (std::size_t v = 0; v < V; ++v)
      sums[r][v] = fresh ? hn::Zero(all) : hn::LoadU(all, out.numbers + r * out.step + v * lanes);
  for (std::size_t j = 0; j < inner; ++j) {
    Vector values[V];
    for (std::size_t v = 0; v < V; ++v) values[v] = hn::LoadU(all, strip.row(j) + v * lanes);
    for (std::size_t r = 0; r < R; ++r) {
      const Vector weight = hn::Set(all, weights.row(r)[j]);
      for (std::size_t v = 0; v < V; ++v) sums[r][v] = added(A{}, weight, values[v], sums[r][v]);
    }
  }
  for (std::size_t r = 0; r < R; ++r)
    for (std::size_t v = 0; v < V; ++v) hn::StoreU(sums[r][v], all, out.numbers + r * out.step + v * lanes);
}

/// The same for up to a tile's vectors.
template <class A, std::size_t R>
HWY_INLINE void add_vectors(std::size_t vectors, std::size_t inner, Rows weights, Rows strip, Out out, bool fresh) {
  if (vectors == 1)
    add_tile<A, R, 1>(inner, weights, strip, out, fresh);
  else if (vectors == 2)
    add_tile<A, R, 2>(inner, weights, strip, out, fresh);
  else
    add_tile<A, R, tile_vectors>(inner, weights, strip, out, fresh);
}

/// The same for up to a tile's columns. Those that do not fill a vector go through a copy.
template <class A, std::size_t R>
HWY_INLINE void add_columns(std::size_t columns, std::size_t inner, Rows weights, Rows strip, Out out, bool fresh) {
  const std::size_t vectors = hwy::DivCeil(columns, lanes);
  if (columns == vectors * lanes) {
    add_vectors<A, R>(vectors, inner, weights, strip, out, fresh);
    return;
  }
  double copy[R * tile_columns];
  for (std::size_t r = 0; r < R && !fresh; ++r)
    std::copy_n(out.numbers + r * out.step, columns, copy + r * tile_columns);
  add_vectors<A, R>(vectors, inner, weights, strip, {copy, tile_columns}, fresh);
  for (std::size_t r = 0; r < R; ++r) std::copy_n(copy + r * tile_columns, columns, out.numbers + r * out.step);
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
double* room(std::size_t size) {
  thread_local std::vector<double> kept;
  if (kept.size() < size) kept.resize(size);
  return kept.data();
}

/// A strip of left(j0 + j, k + ·), filled up with zeros to a tile's columns.
void copy_strip(const DenseParts& parts, std::size_t j0, std::size_t inner, std::size_t k, double* out) {
  const std::size_t columns = std::min(tile_columns, parts.columns - k);
  for (std::size_t j = 0; j < inner; ++j, out += tile_columns) {
    const double* const row = parts.left + (j0 + j) * parts.columns + k;
    if (columns == tile_columns) {
      for (std::size_t v = 0; v < tile_columns; v += lanes) hn::StoreU(hn::LoadU(all, row + v), all, out + v);
    } else {
      std::fill(std::copy_n(row, columns, out), out + tile_columns, 0.0);
    }
  }
}

/// Some columns of a composition, to which `inner` indices add their terms. Strips are read where they are, if they are
/// of whole vectors, or from copies.
template <class A>
struct Block {
  const DenseParts& parts;
  bool in_place;
  double* copies;
  std::size_t k0, columns, j0, inner;

  std::size_t width(std::size_t k) const { return std::min(tile_columns, columns - k); }
  bool is_copied(std::size_t k) const { return !in_place || width(k) % lanes != 0; }
  double* copy(std::size_t k) const { return in_place ? copies : copies + k * inner; }

  void copy_strips() const {
    for (std::size_t k = 0; k < columns; k += tile_columns)
      if (is_copied(k)) copy_strip(parts, j0, inner, k0 + k, copy(k));
  }

  template <std::size_t R>
  HWY_INLINE void add(std::size_t i, std::size_t k) const {
    const Rows strip = is_copied(k) ? Rows{copy(k), tile_columns} : Rows{parts.left + k, parts.columns};
    add_columns<A, R>(width(k), inner, {parts.right + i * parts.inner + j0, parts.inner}, strip,
                      {parts.result + i * parts.columns + k0 + k, parts.columns}, j0 == 0);
  }
};

template <class A>
HWY_NOINLINE void compose_all(const DenseParts& parts) {
  if (parts.inner <= in_place_inner && parts.columns <= in_place_columns) {
    double last[in_place_inner * tile_columns];
    const Block<A> whole{parts, true, last, 0, parts.columns, 0, parts.inner};
    whole.copy_strips();
    for (std::size_t k = 0; k < parts.columns; k += tile_columns)
      for_each_group<tile_rows>(parts.rows,
                                [&, k](std::size_t i, auto group) HWY_ATTR { whole.template add<group>(i, k); });
    return;
  }
  double* const copies = room(inner_block * column_block);
  for (std::size_t k0 = 0; k0 < parts.columns; k0 += column_block)
    for (std::size_t j0 = 0; j0 < parts.inner; j0 += inner_block) {
      const std::size_t columns = std::min(column_block, parts.columns - k0);
      const std::size_t inner = std::min(inner_block, parts.inner - j0);
      const Block<A> some{parts, false, copies, k0, columns, j0, inner};
      some.copy_strips();
      for_each_group<tile_rows>(parts.rows, [&](std::size_t i, auto group) HWY_ATTR {
        for (std::size_t k = 0; k < columns; k += tile_columns) some.template add<group>(i, k);
      });
    }
}

void compose_by(const AnyAlgebra& algebra, const DenseParts& parts) {
  if (algebra.name == AnyAlgebra::sigma)
    compose_all<Sigma>(parts);
  else if (algebra.name == AnyAlgebra::max)
    compose_all<Max>(parts);
  else
    compose_all<MaxMin>(parts);
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

}  // namespace
}  // namespace sigmax::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sigmax::kernels {
namespace {

HWY_EXPORT(compose_by);
HWY_EXPORT(least_of_all);

/// While it lives, results of this thread's arithmetic that are smaller than the least normal number become zero; then
/// everything is as it was. On some processors arithmetic is a hundred times as slow on such numbers. Where the
/// machine offers no such mode nothing changes but the time.
class FlushedSubnormals {
 public:
#if defined(__SSE2__)
  FlushedSubnormals() : before_(_mm_getcsr()) { _mm_setcsr(before_ | _MM_FLUSH_ZERO_ON); }
  ~FlushedSubnormals() { _mm_setcsr(before_); }
#else
  FlushedSubnormals() = default;
#endif
  FlushedSubnormals(const FlushedSubnormals&) = delete;
  FlushedSubnormals& operator=(const FlushedSubnormals&) = delete;

 private:
  unsigned before_ = 0;
};

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
bool compose_products(const DenseParts& parts, double least_exact, const Compose& compose) {
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
  for (std::size_t k = 0; k < size; ++k) parts.result[k] *= 0x1p-512;
  return true;
}

}  // namespace

bool compose_tiled(const AnyAlgebra& algebra, const DenseParts& parts) {
  if (algebra.name == AnyAlgebra::other) return false;
  const auto compose = [&](const DenseParts& some) { HWY_DYNAMIC_DISPATCH(compose_by)(algebra, some); };
  if (algebra.name == AnyAlgebra::max_min) {
    compose(parts);
    return true;
  }
  // Each term of a sum may have lost up to the least normal number: that is below rounding in sums above this.
  const double terms = algebra.selective ? 1.0 : static_cast<double>(parts.inner) * 0x1p54;
  return compose_products(parts, terms * least_normal, compose);
}

}  // namespace sigmax::kernels
#endif
