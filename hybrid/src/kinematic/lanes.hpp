/// What the kernel computes with: numbers or vectors of them, one for each of several tracks, and columns of one number
/// for each axis. Private to the file that includes it, which says how many bytes a vector has: SIGMAX_LANE_BYTES.

#include <type_traits>

namespace sigmax::detail::kinematic {
namespace {

using Doubles = double __attribute__((vector_size(SIGMAX_LANE_BYTES)));
using Floats = float __attribute__((vector_size(SIGMAX_LANE_BYTES)));

/// Up to three numbers of one track along the axes; what is in the fourth lane does not matter.
using Quad = double __attribute__((vector_size(32)));

/// A number, or one for each of several tracks, for each axis.
template <class V, int A>
struct Axes {
  V along[A];
  V& operator[](int axis) { return along[axis]; }
  const V& operator[](int axis) const { return along[axis]; }
  friend Axes operator+(Axes a, const Axes& b) {
    for (int i = 0; i < A; ++i) a[i] += b[i];
    return a;
  }
  friend Axes operator-(Axes a, const Axes& b) {
    for (int i = 0; i < A; ++i) a[i] -= b[i];
    return a;
  }
  friend Axes operator*(Axes a, const Axes& b) {
    for (int i = 0; i < A; ++i) a[i] *= b[i];
    return a;
  }
  template <class Factor>
  friend Axes operator*(Factor factor, Axes a) {
    for (int i = 0; i < A; ++i) a[i] = factor * a[i];
    return a;
  }
};

/// The number of a lane, the lane of a column, and whether a column computes the upper triangle along with the lower.
template <class V>
struct LaneOf {
  using Real = std::remove_cvref_t<decltype(V{}[0])>;
  static constexpr int count = static_cast<int>(sizeof(V) / sizeof(Real));
};
template <>
struct LaneOf<double> {
  using Real = double;
  static constexpr int count = 1;
};
template <class C>
struct ColumnOf;
template <>
struct ColumnOf<Quad> {
  using Lane = double;
};
template <class V, int A>
struct ColumnOf<Axes<V, A>> {
  using Lane = V;
};

/// @{
/// Column k of a diagonal block, which may be known from its diagonal down; `changed` from there; column k but for its
/// entry k zero, and that added to a column; the diagonal; and the least along each axis.
template <int A>
Quad full(const Quad* block, int k) {
  return block[k];
}
inline Quad below(int, Quad, Quad changed) { return changed; }
inline Quad only(int k, Quad column) {
  const decltype(column < Quad{}) mask{k == 0 ? -1 : 0, k == 1 ? -1 : 0, k == 2 ? -1 : 0, 0};
  return mask ? column : Quad{};
}
inline Quad plus_only(int k, Quad column, Quad added) { return column + only(k, added); }
template <int A>
Quad diagonal(const Quad* block) {
  Quad result = block[0];
  if constexpr (A > 1) result = __builtin_shufflevector(result, block[1], 0, 5, 2, 3);
  if constexpr (A > 2) result = __builtin_shufflevector(result, block[2], 0, 1, 6, 3);
  return result;
}
inline void fill(Quad& column, double value) { column = value + Quad{}; }
inline Quad least(Quad a, Quad b) { return a < b ? a : b; }
template <int A, class V>
Axes<V, A> full(const Axes<V, A>* block, int k) {
  Axes<V, A> column = block[k];
  for (int i = 0; i < k; ++i) column[i] = block[i][k];
  return column;
}
template <class V, int A>
Axes<V, A> below(int k, Axes<V, A> column, const Axes<V, A>& changed) {
  for (int i = k; i < A; ++i) column[i] = changed[i];
  return column;
}
template <class V, int A>
Axes<V, A> only(int k, const Axes<V, A>& column) {
  Axes<V, A> result{};
  result[k] = column[k];
  return result;
}
template <class V, int A>
Axes<V, A> plus_only(int k, Axes<V, A> column, const Axes<V, A>& added) {
  column[k] += added[k];
  return column;
}
template <int A, class V>
Axes<V, A> diagonal(const Axes<V, A>* block) {
  Axes<V, A> result;
  for (int k = 0; k < A; ++k) result[k] = block[k][k];
  return result;
}
template <class V, int A, class Number>
void fill(Axes<V, A>& column, Number value) {
  for (int i = 0; i < A; ++i) column[i] = V{} + value;
}
template <class V, int A>
Axes<V, A> least(Axes<V, A> a, const Axes<V, A>& b) {
  for (int i = 0; i < A; ++i) a[i] = a[i] < b[i] ? a[i] : b[i];
  return a;
}
/// @}

/// @{
/// The transpose of a block.
template <int A>
inline __attribute__((always_inline)) void transpose(const Quad* block, Quad* result) {
  if constexpr (A == 3) {
    const Quad low = __builtin_shufflevector(block[0], block[1], 0, 4, 2, 6);
    const Quad high = __builtin_shufflevector(block[0], block[1], 1, 5, 3, 7);
    result[0] = __builtin_shufflevector(low, block[2], 0, 1, 4, 5);
    result[1] = __builtin_shufflevector(high, block[2], 0, 1, 5, 4);
    result[2] = __builtin_shufflevector(low, block[2], 2, 3, 6, 7);
  } else {
    for (int k = 0; k < A; ++k) {
      result[k] = Quad{};
      for (int i = 0; i < A; ++i) result[k][i] = block[i][k];
    }
  }
}
template <int A, class V>
void transpose(const Axes<V, A>* block, Axes<V, A>* result) {
  for (int k = 0; k < A; ++k)
    for (int i = 0; i < A; ++i) result[k][i] = block[i][k];
}
/// @}

template <class V>
using MaskOf = decltype(V{} < V{});

/// @{
/// mask ? a : b, in each lane.
inline double select(bool mask, double a, double b) { return mask ? a : b; }
inline Quad select(bool mask, Quad a, Quad b) { return mask ? a : b; }
inline Doubles select(MaskOf<Doubles> mask, Doubles a, Doubles b) { return mask ? a : b; }
inline Floats select(MaskOf<Floats> mask, Floats a, Floats b) { return mask ? a : b; }
template <class Mask, class V, int A>
Axes<V, A> select(Mask mask, Axes<V, A> a, const Axes<V, A>& b) {
  for (int i = 0; i < A; ++i) a[i] = select(mask, a[i], b[i]);
  return a;
}
/// @}

inline bool any(bool mask) { return mask; }
template <class Mask>
bool any_lane(Mask mask) {
  auto left = mask[0];
  for (unsigned lane = 1; lane < sizeof(Mask) / sizeof(left); ++lane) left |= mask[lane];
  return left != 0;
}
inline bool any(MaskOf<Doubles> mask) { return any_lane(mask); }
inline bool any(MaskOf<Floats> mask) { return any_lane(mask); }

inline double root(double x) { return __builtin_sqrt(x); }
template <class V>
V roots(V x) {
  for (int lane = 0; lane < LaneOf<V>::count; ++lane)
    x[lane] = static_cast<typename LaneOf<V>::Real>(__builtin_sqrt(x[lane]));
  return x;
}
inline Doubles root(Doubles x) { return roots(x); }
inline Floats root(Floats x) { return roots(x); }

/// exp(x) of x ≤ 0 to an ulp or two: x = n log 2 + r, Taylor's series of r, and n into the exponent. Zero where the
/// result would be subnormal.
template <int Terms, class V, class Real>
V exponentials(V x, Real least, Real shift, Real high, Real low, int fraction_bits) {
  using Bits = MaskOf<V>;
  const V bounded = select(x > V{} + least, x, V{} + least);
  const V shifted = bounded * static_cast<Real>(1.44269504088896340736) + shift;
  const V n = shifted - shift;
  const V r = (bounded - n * high) - n * low;
  V series = V{} + Real{1};
  for (int k = Terms; k > 0; --k) series = Real{1} + series * r * static_cast<Real>(1.0 / k);
  Bits exponent, bits;
  const V shifts = V{} + shift;
  __builtin_memcpy(&exponent, &shifted, sizeof(V));
  __builtin_memcpy(&bits, &shifts, sizeof(V));
  exponent = (exponent - bits) << fraction_bits;
  __builtin_memcpy(&bits, &series, sizeof(V));
  bits += exponent;
  __builtin_memcpy(&series, &bits, sizeof(V));
  return select(x > V{} + least, series, V{});
}
inline double exponential(double x) { return __builtin_exp(x); }
inline Doubles exponential(Doubles x) {
  return exponentials<13>(x, -708.0, 0x1.8p52, 0x1.62e42feep-1, 0x1.a39ef35793c76p-33, 52);
}
inline Floats exponential(Floats x) { return exponentials<7>(x, -87.0F, 0x1.8p23F, 0x1.62e4p-1F, 0x1.7f7d1cp-20F, 23); }

}  // namespace
}  // namespace sigmax::detail::kinematic
