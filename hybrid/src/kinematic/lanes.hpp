/// What the kernel computes with: a number, or a vector of them. Private to the file that includes it, which says how
/// many bytes a vector has: SIGMAX_LANE_BYTES.

#include <type_traits>
#include <utility>

namespace sigmax::detail::kinematic {
namespace {

using Doubles = double __attribute__((vector_size(SIGMAX_LANE_BYTES)));
using Floats = float __attribute__((vector_size(SIGMAX_LANE_BYTES)));

/// The number of a lane, and how many there are.
template <class V>
struct Lane {
  using Number = std::remove_cvref_t<decltype(V{}[0])>;
  static constexpr int count = static_cast<int>(sizeof(V) / sizeof(Number));
};
template <>
struct Lane<double> {
  using Number = double;
  static constexpr int count = 1;
};
template <class V>
using NumberOf = typename Lane<V>::Number;

/// What a comparison gives: whether it holds, in each lane.
template <class V>
using Mask = decltype(V{} < V{});

/// The same number in all lanes.
template <class V>
inline V all(double number) {
  return V{} + static_cast<NumberOf<V>>(number);
}

/// The t-th number of all lanes.
template <class V>
inline V read(const NumberOf<V>* from, int t) {
  V lanes;
  __builtin_memcpy(&lanes, from + t * Lane<V>::count, sizeof(V));
  return lanes;
}

template <class V>
inline void write(NumberOf<V>* to, int t, V lanes) {
  __builtin_memcpy(to + t * Lane<V>::count, &lanes, sizeof(V));
}

/// mask ? a : b, in each lane; and the lesser of both.
template <class V, class M>
inline V select(M mask, V a, V b) {
  return mask ? a : b;
}
template <class V>
inline V lesser(V a, V b) {
  return a < b ? a : b;
}

/// A bit for each lane where the mask does not hold.
template <class V>
inline unsigned failures(Mask<V> mask) {
  unsigned bits = 0;
  for (int lane = 0; lane < Lane<V>::count; ++lane)
    if (!mask[lane]) bits |= 1U << static_cast<unsigned>(lane);
  return bits;
}

template <class V>
inline V root(V x) {
  if constexpr (Lane<V>::count == 1) {
    return __builtin_sqrt(x);
  } else {
    for (int lane = 0; lane < Lane<V>::count; ++lane) x[lane] = static_cast<NumberOf<V>>(__builtin_sqrt(x[lane]));
    return x;
  }
}

/// The same bits as another type.
template <class To, class From>
inline To as(From from) {
  return __builtin_bit_cast(To, from);
}

/// exp(x) of x ≤ 0 to an ulp or two: x = n log 2 + r, Taylor's series of r in its even and odd terms, and n into the
/// exponent. Zero where the result would be subnormal.
template <int Terms, class V, class Number>
inline V exponentials(V x, Number least, Number shift, Number high, Number low, int fraction_bits) {
  using Bits = std::conditional_t<Lane<V>::count == 1, long long, Mask<V>>;
  const V bounded = select<V>(x > V{} + least, x, V{} + least);
  const V shifted = bounded * static_cast<Number>(1.44269504088896340736) + shift;
  const V n = shifted - shift;
  const V r = (bounded - n * high) - n * low, square = r * r;
  double factorial = 1.0;
  for (int k = 2; k <= Terms; ++k) factorial *= k;
  V even{}, odd{};
  for (int k = Terms; k > 0; k -= 2) {
    odd = odd * square + static_cast<Number>(1.0 / factorial);
    factorial /= k;
    even = even * square + static_cast<Number>(1.0 / factorial);
    factorial /= k > 1 ? k - 1 : 1;
  }
  const V series = even + r * odd;
  const Bits exponent = (as<Bits>(shifted) - as<Bits>(V{} + shift)) << fraction_bits;
  return select<V>(x > V{} + least, as<V>(as<Bits>(series) + exponent), V{});
}
template <class V>
inline V exponential(V x) {
  if constexpr (std::is_same_v<NumberOf<V>, double>)
    return exponentials<13>(x, -708.0, 0x1.8p52, 0x1.62e42feep-1, 0x1.a39ef35793c76p-33, 52);
  else
    return exponentials<7>(x, -87.0F, 0x1.8p23F, 0x1.62e4p-1F, 0x1.7f7d1cp-20F, 23);
}

/// log(x) of normal x to an ulp or two: x = m 2^n with m within √2 of one, and log m = 2 artanh((m − 1)/(m + 1)).
inline Doubles logarithm(Doubles x) {
  using Bits = Mask<Doubles>;
  constexpr double shift = 0x1.8p52;
  constexpr long long least = 0x3fe6a09e667f3bcdLL, bias = 1024;  // √½
  const Bits exponent = ((as<Bits>(x) - least + (bias << 52)) >> 52) - bias;
  const Doubles m = as<Doubles>(as<Bits>(x) - (exponent << 52));
  const Doubles n = as<Doubles>(as<Bits>(all<Doubles>(shift)) + exponent) - shift;
  const Doubles s = (m - 1.0) / (m + 1.0), square = s * s;
  Doubles even{}, odd{};
  for (int k = 21; k > 1; k -= 4) {
    odd = odd * (square * square) + 2.0 / k;
    even = even * (square * square) + 2.0 / (k - 2);
  }
  return n * 0x1.62e42feep-1 + (s * 2.0 + (s * square * (even + square * odd) + n * 0x1.a39ef35793c76p-33));
}

}  // namespace
}  // namespace sigmax::detail::kinematic
