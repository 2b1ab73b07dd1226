/// How the estimates of a track lie in a block, and with what the kernel computes them. Numbers stand for derivatives a
/// and b and for an axis u, or for a pair of axes k, of u and v ≤ u: P(a, b, k) is the covariance of derivative a along
/// u and b along v.

#include <sigmax/estimation/refs.hpp>

#include "kinematic/lanes.hpp"

namespace sigmax::detail::kinematic {
namespace {

/// action(i) for each i below Count, a constant.
template <int Number>
struct Constant {
  constexpr operator int() const { return Number; }
};
template <int Count, class Action>
inline void for_each(const Action& action) {
  [&]<int... i>(std::integer_sequence<int, i...>) { (action(Constant<i>{}), ...); }
  (std::make_integer_sequence<int, Count>{});
}

/// How many numbers a lower triangle has: (0, 0), (1, 0), (1, 1), …
constexpr int triangle(int n) { return n * (n + 1) / 2; }
constexpr int first_of_pair(int k) { return k < 1 ? 0 : k < 3 ? 1 : 2; }
constexpr int second_of_pair(int k) { return k - triangle(first_of_pair(k)); }

/// Tracks side by side, or one: a number V of all of them, in each place of the mean and of the lower triangle.
template <class V, int Axes>
struct Tracks {
  using Number = V;
  using OfAxes = V;   ///< in so many vectors
  using OfPairs = V;  ///< likewise
  static constexpr int axes = Axes, axis_vectors = Axes, pair_vectors = triangle(Axes);
  static constexpr int mean_size(int order) { return order * Axes * Lane<V>::count; }
  static constexpr int size(int order) { return (order * Axes + triangle(order * Axes)) * Lane<V>::count; }
  static constexpr int place(int a, int b, int k) {
    const int i = a * Axes + first_of_pair(k), j = b * Axes + second_of_pair(k);
    return i < j ? triangle(j) + i : triangle(i) + j;
  }

  /// Whether pair k is of one axis and itself, and P(a, b, k) then the same as P(b, a, k); one where it is.
  static constexpr bool has_diagonal(int k) { return first_of_pair(k) == second_of_pair(k); }
  static constexpr bool is_mirrored(int a, int b, int k) { return has_diagonal(k) && a < b; }
  static constexpr NumberOf<V> diagonal() { return 1; }

  /// Numbers of the axes, as those of the first or the second of a pair; the number of one axis, or of one pair.
  static V of_first(const V* numbers, int k) { return numbers[first_of_pair(k)]; }
  static V of_second(const V* numbers, int k) { return numbers[second_of_pair(k)]; }
  static V at(const V* numbers, int place) { return numbers[place]; }
  static V from(const double* numbers, int u) { return all<V>(numbers[u]); }

  /// The covariances of a derivative along the axes from u on with the position along axis m.
  template <class P>
  static V with_position(const P& covariance, int a, int u, int m) {
    return u < m ? covariance(0, a, triangle(m) + u) : covariance(a, 0, triangle(u) + m);
  }

  /// Makes P(a, b, k) the same as P(b, a, k) where it is, and has a place of its own.
  template <class Estimate>
  static void mirror(const Estimate&) {}

  /// @{
  /// An estimate of one track with its whole covariance, from here and to here.
  template <class Estimate>
  static void read_mean(const Estimate& from, double* mean) {
    for (int i = 0; i < Estimate::derivatives * Axes; ++i) mean[i] = from.x[i];
  }
  template <class Estimate>
  static void read(const Estimate& from, View to) {
    read_mean(from, to.mean);
    constexpr int n = Estimate::derivatives * Axes;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= i; ++j) to.covariance[i + j * n] = to.covariance[j + i * n] = from.P[triangle(i) + j];
  }
  static void write(ConstView from, double* to) {
    for (int i = 0; i < from.n; ++i) *to++ = from.mean[i];
    for (int i = 0; i < from.n; ++i)
      for (int j = 0; j <= i; ++j) *to++ = from.covariance[i + j * from.n];
  }
  /// @}

  /// The least number of a diagonal, and the sum of all, as of the axes.
  static V least_of_diagonal(V numbers) { return numbers; }
  static V sum_of_diagonal(V numbers) { return numbers; }
  static V sum_of_axes(V numbers) { return numbers; }
};

/// One track along three axes: a vector over the axes for each derivative, and one over their six pairs for each two.
struct InSpace {
  using Number = double;
  using OfAxes = double __attribute__((vector_size(32)));
  using OfPairs = double __attribute__((vector_size(64)));
  static constexpr int axes = 3, axis_vectors = 1, pair_vectors = 1;
  static constexpr int mean_size(int) { return 16; }
  static constexpr int place(int a, int b, int) { return a * 3 + b; }
  static constexpr int size(int order) { return mean_size(order) + 8 * (place(order - 1, order - 1, 0) + 1); }

  static constexpr bool has_diagonal(int) { return true; }
  static constexpr bool is_mirrored(int, int, int) { return false; }
  static constexpr OfPairs diagonal() { return OfPairs{1, 0, 1, 0, 0, 1, 0, 0}; }

  static OfPairs of_first(const OfAxes* n, int) { return __builtin_shufflevector(*n, *n, 0, 1, 1, 2, 2, 2, 3, 3); }
  static OfPairs of_second(const OfAxes* n, int) { return __builtin_shufflevector(*n, *n, 0, 0, 1, 0, 1, 2, 3, 3); }
  static double at(const OfAxes* numbers, int u) { return (*numbers)[u]; }
  static double at(const OfPairs* numbers, int k) { return (*numbers)[k]; }
  static OfAxes from(const double* numbers, int) { return OfAxes{numbers[0], numbers[1], numbers[2], 0.0}; }

  /// The covariances of derivative a along axis u with derivative b along each axis, of P(a, b) and P(b, a), which has
  /// the diagonal if so.
  template <int u, bool diagonal_of_second>
  static OfAxes row(OfPairs first, OfPairs second) {
    constexpr auto place = [](int v) {
      return v < u ? triangle(u) + v : triangle(v) + u + (v > u || diagonal_of_second ? 8 : 0);
    };
    return __builtin_shufflevector(first, second, place(0), place(1), place(2), 6);
  }
  template <class P>
  static OfAxes with_position(const P& covariance, int a, int, int m) {
    const OfPairs low = covariance(a, 0, 0), high = covariance(0, a, 0);
    return m == 0 ? row<0, true>(high, low) : m == 1 ? row<1, true>(high, low) : row<2, true>(high, low);
  }

  template <class Estimate>
  static void mirror(const Estimate& P) {
    for_each<Estimate::derivatives>(
        [&](auto b) { for_each<b>([&](auto a) { P(a, b, 0) = diagonal() > OfPairs{} ? P(b, a, 0) : P(a, b, 0); }); });
  }

  /// Three numbers, and a fourth that the next ones replace, if there are any.
  template <bool last>
  static void put(double* to, OfAxes numbers) {
    if constexpr (last)
      for (int u = 0; u < 3; ++u) to[u] = numbers[u];
    else
      __builtin_memcpy(to, &numbers, sizeof(OfAxes));
  }
  template <class Estimate>
  static void read_mean(const Estimate& from, double* mean) {
    for_each<Estimate::derivatives>([&](auto a) { put<a + 1 == Estimate::derivatives>(mean + 3 * a, from.x[a]); });
  }
  template <class Estimate>
  static void read(Estimate from, View to) {
    constexpr int order = Estimate::derivatives;
    read_mean(from, to.mean);
    for_each<order * 3>([&](auto i) {
      constexpr int a = i / 3, u = i % 3;
      for_each<order>([&](auto b) {
        const OfAxes numbers = row<u, (b > a)>(from(a, b, 0), from(b, a, 0));
        put<i + 1 == order * 3 && b + 1 == order>(to.covariance + (i * order + b) * 3, numbers);
      });
    });
  }
  static void write(ConstView from, double* to) {
    const int n = from.n, order = n / 3;
    for (int i = 0; i < size(order); ++i) to[i] = 0.0;
    for (int i = 0; i < n; ++i) to[i / 3 * 4 + i % 3] = from.mean[i];
    to += mean_size(order);
    for (int a = 0; a < order; ++a)
      for (int b = 0; b < order; ++b)
        for (int k = 0; k < 6; ++k)
          to[place(a, b, 0) * 8 + k] = from.covariance[a * 3 + first_of_pair(k) + (b * 3 + second_of_pair(k)) * n];
  }

  static double least_of_diagonal(OfPairs n) { return lesser(n[0], lesser(n[2], n[5])); }
  static double sum_of_diagonal(OfPairs n) { return n[0] + n[2] + n[5]; }
  static double sum_of_axes(OfAxes n) { return n[0] + n[1] + n[2]; }
};

}  // namespace
}  // namespace sigmax::detail::kinematic
