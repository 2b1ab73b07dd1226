/// Prediction and update of one model. Included once for each instruction set, which says how many bytes its vectors
/// have and what its kernels are called. Everything is private to the file that includes it, and no function of the
/// standard library is inline here, since what is compiled for one processor must not serve another.

#include <cmath>
#include <type_traits>

#include "kernels/kernels.hpp"

/// Loops whose sizes the compiler knows, so that numbers stay in registers.
#define SIGMAX_UNROLL _Pragma("GCC unroll 16")

namespace sigmax::detail {
namespace {

/// What the sums and products of one step may lose of the terms that they are made of.
constexpr double rounding = 128.0 * 0x1p-52;

using One = double __attribute__((vector_size(8)));
using Two = double __attribute__((vector_size(16)));
using Four = double __attribute__((vector_size(32)));
using Full = std::conditional_t<SIGMAX_LANE_BYTES == 32, Four, Two>;

/// A size that only the call tells.
constexpr int any = -1;

/// So many rows of a column, in vectors; what is beyond the rows means nothing.
template <int Rows>
struct Column {
  using Piece = std::conditional_t<Rows == 1, One, std::conditional_t<Rows == 2, Two, Full>>;
  static constexpr int width = sizeof(Piece) / sizeof(double);
  static constexpr int pieces = (Rows + width - 1) / width;
  Piece piece[pieces > 0 ? pieces : 1];

  double operator[](int i) const { return piece[i / width][i % width]; }
  void set(int i, double number) { piece[i / width][i % width] = number; }
};

/// Numbers that were stored one by one are read so too: a load of several would wait until they have left for the
/// cache.
template <int Rows>
inline Column<Rows> column_of(const double* numbers) {
  Column<Rows> column;
  const auto number = [&](int i) { return i < Rows ? numbers[i] : 0.0; };
  SIGMAX_UNROLL
  for (int p = 0; p < Column<Rows>::pieces; ++p) {
    const int i = p * Column<Rows>::width;
    if constexpr (Column<Rows>::width == 1)
      column.piece[p] = One{number(i)};
    else if constexpr (Column<Rows>::width == 2)
      column.piece[p] = Two{number(i), number(i + 1)};
    else
      column.piece[p] = Four{number(i), number(i + 1), number(i + 2), number(i + 3)};
  }
  return column;
}

/// C ± A B, or A B alone, with as many rows as the compiler knows and A in hand.
template <int Rows>
void multiply_rows(const double* A, int a_column, Strided B, double* C, int c_column, int inner, int columns,
                   Into into) {
  using Rowwise = Column<Rows>;
  constexpr int most = 32;
  for (int first = 0; first < inner || (first == 0 && into == Into::only); first += most) {
    const int count = inner - first < most ? inner - first : most;
    Rowwise column[most];
    for (int k = 0; k < count; ++k) column[k] = column_of<Rows>(A + (first + k) * a_column);
    for (int j = 0; j < columns; ++j) {
      double* const result = C + j * c_column;
      Rowwise sum{};
      if (into != Into::only || first != 0) sum = column_of<Rows>(result);
      for (int k = 0; k < count; ++k) {
        const double entry = B.numbers[(first + k) * B.row + j * B.column];
        const double factor = into == Into::minus ? -entry : entry;
        SIGMAX_UNROLL
        for (int p = 0; p < Rowwise::pieces; ++p) sum.piece[p] += column[k].piece[p] * factor;
      }
      SIGMAX_UNROLL
      for (int i = 0; i < Rows; ++i) result[i] = sum[i];
    }
    if (inner == 0) return;
  }
}

void product_of(const double* A, int a_column, Strided B, double* C, int c_column, int rows, int inner, int columns,
                Into into) {
  static constexpr decltype(&multiply_rows<1>) by_rows[]{
      multiply_rows<1>, multiply_rows<2>, multiply_rows<3>, multiply_rows<4>, multiply_rows<5>,
      multiply_rows<6>, multiply_rows<7>, multiply_rows<8>, multiply_rows<9>, multiply_rows<10>};
  constexpr int most = 10;
  for (int first = 0; first < rows; first += most) {
    const int part = rows - first < most ? rows - first : most;
    by_rows[part - 1](A + first, a_column, B, C + first, c_column, inner, columns, into);
  }
}

/// A matrix in hand, of sizes that the compiler knows, or of those that it is made with.
template <int Rows, int Columns>
struct Block {
  Column<Rows> column[Columns > 0 ? Columns : 1];

  Block(int, int) {}
  Block(const double* numbers, int apart, int, int) {
    SIGMAX_UNROLL
    for (int k = 0; k < Columns; ++k) column[k] = column_of<Rows>(numbers + k * apart);
  }
  static constexpr int rows() { return Rows; }
  static constexpr int columns() { return Columns; }
  double operator()(int i, int k) const { return column[k][i]; }
  void add(int i, int k, double number) { column[k].set(i, column[k][i] + number); }
};

template <>
struct Block<any, any> {
  Block(int rows, int columns)
      : rows_(rows), columns_(columns), numbers_(rows * columns <= 256 ? few_ : new double[rows * columns]) {}
  Block(const double* numbers, int apart, int rows, int columns) : Block(rows, columns) {
    for (int k = 0; k < columns; ++k)
      for (int i = 0; i < rows; ++i) numbers_[i + k * rows] = numbers[i + k * apart];
  }
  Block(const Block& other) : Block(other.numbers_, other.rows_, other.rows_, other.columns_) {}
  Block& operator=(const Block&) = delete;
  ~Block() {
    if (numbers_ != few_) delete[] numbers_;
  }
  int rows() const { return rows_; }
  int columns() const { return columns_; }
  double* data() { return numbers_; }
  Strided strided() const { return columns_of(numbers_, rows_); }
  double operator()(int i, int k) const { return numbers_[i + k * rows_]; }
  void add(int i, int k, double number) { numbers_[i + k * rows_] += number; }

 private:
  int rows_, columns_;
  double few_[256];
  double* numbers_;
};

template <int Rows, int Columns>
struct TransposedBlock {
  const Block<Columns, Rows>& of;
  int columns() const { return of.rows(); }
  Strided strided() const { return {of.strided().numbers, of.rows(), 1}; }
  double operator()(int i, int k) const { return of(k, i); }
};
template <int Rows, int Columns>
TransposedBlock<Columns, Rows> transposed(const Block<Rows, Columns>& block) {
  return {block};
}

/// C ± A B, or A B alone.
template <Into into, int Rows, int Inner, int Columns, template <int, int> class Right>
inline void multiply_blocks(const Block<Rows, Inner>& A, const Right<Inner, Columns>& B, Block<Rows, Columns>& C) {
  if constexpr (Rows == any) {
    product_of(A.strided().numbers, A.rows(), B.strided(), C.data(), C.rows(), C.rows(), A.columns(), C.columns(),
               into);
  } else {
    SIGMAX_UNROLL
    for (int j = 0; j < Columns; ++j) SIGMAX_UNROLL
    for (int p = 0; p < Column<Rows>::pieces; ++p) {
      auto sum = into == Into::only ? A.column[0].piece[p] * B(0, j) : C.column[j].piece[p];
      SIGMAX_UNROLL
      for (int k = into == Into::only ? 1 : 0; k < Inner; ++k)
        sum = into == Into::minus ? sum - A.column[k].piece[p] * B(k, j) : sum + A.column[k].piece[p] * B(k, j);
      C.column[j].piece[p] = sum;
    }
  }
}
template <int Rows, int Inner, int Columns, template <int, int> class Right>
inline Block<Rows, Columns> product(const Block<Rows, Inner>& A, const Right<Inner, Columns>& B) {
  Block<Rows, Columns> C(A.rows(), B.columns());
  multiply_blocks<Into::only>(A, B, C);
  return C;
}

bool all_finite(const double* numbers, int count) {
  for (int i = 0; i < count; ++i)
    if (!__builtin_isfinite(numbers[i])) return false;
  return true;
}

/// The lower triangle of Cholesky's factor L of S; false where a pivot is not above this part of its variance. NaN
/// gives NaN.
template <int M>
inline bool cholesky(const double* S, int size, double least, double* L) {
  const int m = M > 0 ? M : size;
  for (int k = 0; k < m; ++k) {
    double pivot = S[k + k * m];
    for (int j = 0; j < k; ++j) pivot -= L[k + j * m] * L[k + j * m];
    if (pivot <= least * S[k + k * m]) return false;
    L[k + k * m] = __builtin_sqrt(pivot);
    const double inverse = 1.0 / L[k + k * m];
    for (int i = k + 1; i < m; ++i) {
      double rest = S[i + k * m];
      for (int j = 0; j < k; ++j) rest -= L[i + j * m] * L[k + j * m];
      L[i + k * m] = rest * inverse;
    }
  }
  return true;
}

/// See `Kernels`.
template <int M>
inline Outcome score_by(const ConstView& z, InnovationView& innovation, double* S_inverse) {
  const int m = M > 0 ? M : z.n;
  double few[M > 0 ? 2 * M * M : 1];
  Block<any, any> many(M > 0 ? 0 : 2 * m, m);
  double* const L = M > 0 ? few : many.data();
  double* const inverse = L + m * m;  // of L
  double* const S = innovation.covariance;
  if (!cholesky<M>(S, m, rounding, L)) {
    // A pivot that drowned, as where a spread is 10⁸ times as wide as the measurement, is lifted above the rounding.
    for (int k = 0; k < m; ++k) S[k + k * m] *= 1.0 + rounding;
    if (!cholesky<M>(S, m, 0.0, L)) return Outcome::not_positive_definite;
  }
  double distance = 0.0, root = 1.0, log_root = 0.0;
  for (int i = 0; i < m; ++i) {
    const double pivot = L[i + i * m];
    inverse[i + i * m] = 1.0 / pivot;
    double whitened = inverse[i + i * m] * innovation.residual[i];
    for (int k = 0; k < i; ++k) {
      double sum = 0.0;
      for (int j = k; j < i; ++j) sum += L[i + j * m] * inverse[j + k * m];
      inverse[i + k * m] = -sum * inverse[i + i * m];
      whitened += inverse[i + k * m] * innovation.residual[k];
    }
    distance += whitened * whitened;
    root *= pivot;
    if (root > 1e-100 && root < 1e100) continue;  // else the next might leave the numbers that there are
    log_root += std::log(root);
    root = 1.0;
  }
  log_root += std::log(root);
  constexpr double log_two_pi = 1.8378770664093454836;
  innovation.squared_distance = distance;
  innovation.log_likelihood = -0.5 * distance - log_root - 0.5 * m * log_two_pi;
  if (!__builtin_isfinite(distance)) {  // infinite also for a finite measurement that is too far off
    if (!all_finite(z.mean, m) || !all_finite(z.covariance, m * m)) return Outcome::measurement_not_finite;
    if (!all_finite(innovation.residual, m) || !all_finite(S, m * m)) return Outcome::estimate_not_finite;
    innovation.squared_distance = __builtin_inf();  // where terms of both signs overflowed
    innovation.log_likelihood = -innovation.squared_distance;
  }
  for (int k = 0; k < m; ++k)  // S⁻¹ = L⁻ᵀ L⁻¹
    for (int i = k; i < m; ++i) {
      double sum = 0.0;
      for (int j = i; j < m; ++j) sum += inverse[j + i * m] * inverse[j + k * m];
      S_inverse[i + k * m] = S_inverse[k + i * m] = sum;
    }
  return Outcome::done;
}

Outcome score_any(const ConstView& z, InnovationView& innovation, double* S_inverse) {
  if (z.n == 1) return score_by<1>(z, innovation, S_inverse);
  if (z.n == 2) return score_by<2>(z, innovation, S_inverse);
  if (z.n == 3) return score_by<3>(z, innovation, S_inverse);
  return score_by<any>(z, innovation, S_inverse);
}

/// I − W H.
template <int M, int K>
inline Block<K, K> complement(const Block<K, M>& W, const Block<M, K>& H) {
  auto A = product(W, H);
  for (int j = 0; j < A.columns(); ++j)
    for (int i = 0; i < A.rows(); ++i) A.add(i, j, (i == j ? 1.0 : 0.0) - 2.0 * A(i, j));
  return A;
}

/// A Hᵀ, which is A where the components are measured themselves.
template <bool themselves, int Rows, int M, int K>
inline Block<Rows, M> seen_of(const Block<Rows, K>& A, const Block<M, K>& H) {
  if constexpr (themselves)
    return A;
  else
    return product(A, transposed(H));
}

/// Joseph's update, (I − WH) P (I − WH)ᵀ + W R Wᵀ, block by block: 1 of the k components that are seen, for which H
/// (m × k) has columns, and 2 of the others. Where they are measured themselves, H = [I 0], I − W₁ is R S⁻¹, which does
/// not cancel.
template <int M, int K, int Rest, bool themselves>
Outcome update_by(const double* numbers_of_H, int seen, const ConstView& prior, const ConstView& z,
                  const View& posterior, InnovationView& innovation) {
  const int n = K > 0 ? K + Rest : prior.n, k = K > 0 ? K : seen, m = M > 0 ? M : z.n, rest = n - k;
  const double* const P = prior.covariance;
  const Block<K, K> P11(P, n, k, k);
  const Block<M, M> R(z.covariance, m, m, m);
  const Block<Rest, K> P21(P + k, n, rest, k);
  Block<Rest, Rest> P22(P + k + k * n, n, rest, rest);
  const Block<M, K> H(themselves ? P : numbers_of_H, themselves ? n : m, m, k);
  const auto PHt1 = seen_of<themselves>(P11, H);
  const auto PHt2 = seen_of<themselves>(P21, H);
  Block<M, M> S(z.covariance, m, m, m);
  if constexpr (!themselves) multiply_blocks<Into::plus>(H, PHt1, S);
  double few[M > 0 ? M * M : 1];
  Block<any, any> many(M > 0 ? 0 : m, m);
  double* const inverse = M > 0 ? few : many.data();
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < m; ++i) innovation.covariance[i + j * m] = S(i, j) + (themselves ? PHt1(i, j) : 0.0);
  const Outcome outcome = score_by<M>(z, innovation, inverse);
  if (outcome != Outcome::done) return outcome;
  const Block<M, M> S_inverse(inverse, m, m, m);
  const auto W1 = product(PHt1, S_inverse);
  const auto W2 = product(PHt2, S_inverse);
  const auto WR1 = product(W1, R);
  const auto A = [&] {
    if constexpr (themselves)
      return product(R, S_inverse);
    else
      return complement(W1, H);
  }();
  const auto W2H = [&] {
    if constexpr (themselves)
      return W2;
    else
      return product(W2, H);
  }();

  auto C = P21;  // − W₂H P₁₁
  multiply_blocks<Into::minus>(W2, transposed(PHt1), C);
  const auto WR2 = product(W2, R);
  auto D = seen_of<themselves>(C, H);  // − W₂R
  multiply_blocks<Into::minus>(W2, R, D);
  multiply_blocks<Into::minus>(W2, transposed(PHt2), P22);
  multiply_blocks<Into::minus>(D, transposed(W2), P22);
  auto new21 = product(C, transposed(A));
  multiply_blocks<Into::plus>(WR2, transposed(W1), new21);
  auto new11 = product(product(A, P11), transposed(A));
  multiply_blocks<Into::plus>(WR1, transposed(W1), new11);
  for (int i = 0; i < k; ++i) {  // the rounding of the terms of each variance, before they may cancel
    double terms = 0.0;
    for (int j = 0; j < k; ++j) terms += A(i, j) * A(i, j) * P11(j, j);
    new11.add(i, i, rounding * terms);
  }
  for (int i = 0; i < rest; ++i) {
    double terms = P[(k + i) * (n + 1)];
    for (int j = 0; j < k; ++j) terms += W2H(i, j) * W2H(i, j) * P11(j, j);
    P22.add(i, i, rounding * terms);
  }

  for (int i = 0; i < n; ++i) {
    double moved = prior.mean[i];
    for (int j = 0; j < m; ++j) moved += (i < k ? W1(i, j) : W2(i - k, j)) * innovation.residual[j];
    posterior.mean[i] = moved;
  }
  double* const result = posterior.covariance;
  for (int j = 0; j < k; ++j) {
    for (int i = j; i < k; ++i) result[i + j * n] = result[j + i * n] = new11(i, j);
    for (int i = 0; i < rest; ++i) result[k + i + j * n] = result[j + (k + i) * n] = new21(i, j);
  }
  for (int j = 0; j < rest; ++j)
    for (int i = j; i < rest; ++i) result[k + i + (k + j) * n] = result[k + j + (k + i) * n] = P22(i, j);
  return Outcome::done;
}

/// The same, of sizes that the compiler knows where they are those of a detection: of a position along the axes or in a
/// radar's space, of a bearing, or with a range rate.
template <int M, int K, int Rest>
Outcome update_as(const double* H, int seen, const ConstView& prior, const ConstView& z, const View& posterior,
                  InnovationView& innovation) {
  if constexpr (M == K)
    if (!H) return update_by<M, K, Rest, true>(H, seen, prior, z, posterior, innovation);
  return update_by<M, K, Rest, false>(H, seen, prior, z, posterior, innovation);
}

struct Sizes {
  int measured, seen, rest;
  decltype(&update_as<any, any, any>) update;
};
Outcome update_any(const double* H, int seen, const ConstView& prior, const ConstView& z, const View& posterior,
                   InnovationView& innovation) {
  static constexpr Sizes known[]{
      {1, 1, 1, update_as<1, 1, 1>}, {1, 1, 2, update_as<1, 1, 2>}, {2, 2, 2, update_as<2, 2, 2>},
      {2, 2, 3, update_as<2, 2, 3>}, {2, 2, 4, update_as<2, 2, 4>}, {3, 3, 3, update_as<3, 3, 3>},
      {3, 3, 4, update_as<3, 3, 4>}, {3, 3, 6, update_as<3, 3, 6>}, {1, 2, 2, update_as<1, 2, 2>},
      {1, 2, 3, update_as<1, 2, 3>}, {1, 2, 4, update_as<1, 2, 4>}, {1, 2, 5, update_as<1, 2, 5>},
      {1, 2, 7, update_as<1, 2, 7>}, {3, 4, 0, update_as<3, 4, 0>}, {3, 4, 2, update_as<3, 4, 2>},
      {4, 6, 0, update_as<4, 6, 0>}, {4, 6, 1, update_as<4, 6, 1>}, {4, 6, 3, update_as<4, 6, 3>}};
  for (const Sizes& one : known)
    if (z.n == one.measured && seen == one.seen && prior.n == seen + one.rest)
      return one.update(H, seen, prior, z, posterior, innovation);
  return update_as<any, any, any>(H, seen, prior, z, posterior, innovation);
}

/// (27), (28) with F = F_s ⊗ I and F_s upper triangular: blocks are added, nothing is multiplied by zero.
template <int Axes, int Order>
void predict_axes(const AxisLaw& law, const ConstView& prior, const View& result) {
  constexpr int n = Axes * Order;
  double F[Order * Order], Q[Order * Order];  // where no store into a result can change them
  for (int i = 0; i < Order * Order; ++i) {
    F[i] = law.F[i];
    Q[i] = law.Q[i];
  }
  double x[n], P[n * n], terms[n];  // of the variances of F P Fᵀ, before they may cancel
  SIGMAX_UNROLL
  for (int a = 0; a < Order; ++a) SIGMAX_UNROLL
  for (int i = a * Axes; i < (a + 1) * Axes; ++i) {
    x[i] = law.input[i];
    terms[i] = 0.0;
    SIGMAX_UNROLL
    for (int b = a; b < Order; ++b) {
      const double f = F[a + b * Order];
      const int other = i + (b - a) * Axes;
      x[i] += f * prior.mean[other];
      terms[i] += f * f * prior.covariance[other + other * n];
    }
  }
  SIGMAX_UNROLL
  for (int k = 0; k < n; ++k) SIGMAX_UNROLL
  for (int a = 0; a < Order; ++a) SIGMAX_UNROLL
  for (int i = a * Axes; i < (a + 1) * Axes; ++i) {
    double sum = F[a + a * Order] * prior.covariance[i + k * n];
    SIGMAX_UNROLL
    for (int b = a + 1; b < Order; ++b) sum += F[a + b * Order] * prior.covariance[i + (b - a) * Axes + k * n];
    P[i + k * n] = sum;
  }
  SIGMAX_UNROLL
  for (int a = 0; a < Order; ++a) SIGMAX_UNROLL
  for (int k = a * Axes; k < (a + 1) * Axes; ++k) SIGMAX_UNROLL
  for (int i = k; i < n; ++i) {
    double sum = F[a + a * Order] * P[i + k * n];
    SIGMAX_UNROLL
    for (int b = a + 1; b < Order; ++b) sum += F[a + b * Order] * P[i + (k + (b - a) * Axes) * n];
    if ((i - k) % Axes == 0) sum += Q[i / Axes + a * Order];
    if (i == k) sum += rounding * terms[i];
    result.covariance[i + k * n] = result.covariance[k + i * n] = sum;
  }
  SIGMAX_UNROLL
  for (int i = 0; i < n; ++i) result.mean[i] = x[i];
}

template <int Axes>
void predict_order(const AxisLaw& law, const ConstView& prior, const View& result) {
  if (law.order == 1) return predict_axes<Axes, 1>(law, prior, result);
  if (law.order == 2) return predict_axes<Axes, 2>(law, prior, result);
  predict_axes<Axes, 3>(law, prior, result);
}
void predict_any(const AxisLaw& law, int axes, const ConstView& prior, const View& result) {
  if (axes == 1) return predict_order<1>(law, prior, result);
  if (axes == 2) return predict_order<2>(law, prior, result);
  predict_order<3>(law, prior, result);
}

/// P = F P Fᵀ + Q, each variance with the rounding of the terms of F P Fᵀ, before they may cancel.
void predict_covariance(const double* F, const double* Q, const double* P, int n, double* result) {
  Block<any, any> FP(n, n), sum(Q, n, n, n), terms(n, 1);
  product_of(F, n, columns_of(P, n), FP.data(), n, n, n, n, Into::only);
  product_of(FP.data(), n, {F, n, 1}, sum.data(), n, n, n, n, Into::plus);
  double* const total = terms.data();
  for (int i = 0; i < n; ++i) total[i] = 0.0;
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < n; ++i) total[i] += F[i + k * n] * F[i + k * n] * P[k + k * n];
  for (int k = 0; k < n; ++k) {
    for (int i = k + 1; i < n; ++i) result[i + k * n] = result[k + i * n] = sum(i, k);
    result[k + k * n] = sum(k, k) + rounding * total[k];
  }
}

}  // namespace

const Kernels& SIGMAX_KERNELS() {
  static constexpr Kernels all{product_of, predict_any, predict_covariance, score_any, update_any};
  return all;
}

}  // namespace sigmax::detail
