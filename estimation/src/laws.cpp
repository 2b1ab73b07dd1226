#include <sigmax/estimation/motion_numbers.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace sigmax::detail {
namespace {

/// sin x / x, smooth at 0.
double sinc(double x) {
  if (std::abs(x) >= 1e-2) return std::sin(x) / x;
  const double square = x * x;
  return 1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0));
}

/// Its derivative.
double sinc_derivative(double x) {
  if (std::abs(x) < 1e-2) return -x / 3.0 * (1.0 - x * x / 10.0 * (1.0 - x * x / 28.0));
  return (std::cos(x) - sinc(x)) / x;
}

/// (x − sin x)/x³, by its series where that would cancel.
double cubic_remainder_of_sine(double x) {
  const double square = x * x;
  if (square > 1.0) return (x - std::sin(x)) / (square * x);
  double term = 1.0 / 6.0;
  double sum = 0.0;
  for (int n = 0; n < 10; ++n) {
    sum += term;
    term *= -square / ((2 * n + 4) * (2 * n + 5));
  }
  return sum;
}

/// What a turn at the rate ω does to a horizontal position and velocity in T seconds, with θ = ωT: the velocity turns
/// by θ, and the position moves by T (along · v + across · v turned by 90°).
struct Turn {
  double along;   ///< sin θ / θ
  double across;  ///< (1 − cos θ)/θ
  double cosine;
  double sine;

  explicit Turn(double theta) {
    const double half = theta / 2.0;  // by which one sine and one cosine are enough
    const double half_sine = std::sin(half), half_cosine = std::cos(half), ratio = sinc(half);
    along = ratio * half_cosine;
    across = ratio * half_sine;
    cosine = 1.0 - 2.0 * half_sine * half_sine;
    sine = 2.0 * half_sine * half_cosine;
  }
};

/// Entries of a matrix of n rows, which starts as zeros.
struct Entries {
  double* numbers;
  int n;

  Entries(double* matrix, int size) : numbers(matrix), n(size) { std::fill_n(matrix, n * n, 0.0); }
  double& operator()(int i, int k) const { return numbers[i + k * n]; }
};

/// F of a turn over x, y, vx, vy or x, y, z, vx, vy, vz, in a matrix that may be larger; z moves uniformly.
void write_turn(const Turn& turn, int axes, double dt, const Entries& F) {
  for (int i = 0; i < F.n; ++i) F(i, i) = 1.0;
  F(0, axes) = F(1, axes + 1) = dt * turn.along;
  F(0, axes + 1) = -dt * turn.across;
  F(1, axes) = dt * turn.across;
  F(axes, axes) = F(axes + 1, axes + 1) = turn.cosine;
  F(axes, axes + 1) = -turn.sine;
  F(axes + 1, axes) = turn.sine;
  if (axes == 3) F(2, 5) = dt;
}

/// Tⁿ/n!.
std::array<double, 4> taylor(double dt) { return {1.0, dt, dt * dt / 2.0, dt * dt * dt / 6.0}; }

/// F_s(a, b) = Tᵇ⁻ᵃ/(b−a)!: every derivative is the integral of the next.
void taylor_transition(int order, double dt, double* numbers) {
  const auto power = taylor(dt);
  for (int b = 0; b < order; ++b)
    for (int a = 0; a < order; ++a) numbers[a + b * order] = a > b ? 0.0 : power[static_cast<std::size_t>(b - a)];
}

/// Σ_{n ≥ k} (−1)ⁿ uⁿ⁻ᵏ/n! (a 2ⁿ + b n + c): what is left of a e⁻²ᵘ − b u e⁻ᵘ + c e⁻ᵘ after its first k powers, over
/// uᵏ. Summed as a series for small u, so that nothing cancels and u = 0 is a number like another.
double exponential_tail(double u, int k, double a, double b, double c) {
  double power = 1.0;  // (−1)ⁿ uⁿ/n!, or uⁿ⁻ᵏ instead of uⁿ
  double double_power = 1.0;
  double head = 0.0;
  for (int n = 0; n < k; ++n) {
    head += power * (a * double_power + b * n + c);
    power *= -(u < 1.0 ? 1.0 : u) / (n + 1);
    double_power *= 2.0;
  }
  if (u >= 1.0) return (a * std::exp(-2.0 * u) + (c - b * u) * std::exp(-u) - head) / std::pow(u, k);
  double tail = 0.0;
  for (int n = k; n < k + 30; ++n) {
    tail += power * (a * double_power + b * n + c);
    power *= -u / (n + 1);
    double_power *= 2.0;
  }
  return tail;
}

}  // namespace

void discrete_white_noise(int order, double sigma_w, double dt, double* F, double* Q, double* gain) {
  taylor_transition(order, dt, F);
  const std::array<double, 3> G{0.5 * dt * dt, dt, 1.0};
  std::copy_n(G.begin(), order, gain);
  for (int a = 0; a < order; ++a)
    for (int b = 0; b < order; ++b) Q[a + b * order] = gain[a] * gain[b] * sigma_w * sigma_w;
}

void white_noise(int order, double q, double dt, double* F, double* Q, double* gain) {
  taylor_transition(order, dt, F);
  const auto power = taylor(dt);
  for (int a = 0; a < order; ++a) {
    const int p = order - 1 - a;
    gain[a] = power[static_cast<std::size_t>(p + 1)];
    for (int b = 0; b < order; ++b) {
      const int r = order - 1 - b;
      Q[a + b * order] = q * power[static_cast<std::size_t>(p)] * power[static_cast<std::size_t>(r)] * dt / (p + r + 1);
    }
  }
}

void ornstein_uhlenbeck(int order, double theta, double sigma, double dt, double* F_numbers, double* Q_numbers,
                        double* gain) {
  struct Coefficients {
    double a, b, c;
  };
  // 2 ∫ of the products of the last column of F_s, as combinations of e⁻²ᵘ, u e⁻ᵘ and e⁻ᵘ: (p, r) = 00; 10, 11; 20, …
  constexpr std::array<Coefficients, 6> table{
      {{-1, 0, 0}, {1, 0, -2}, {-1, 0, 4}, {-1, 2, 0}, {1, -2, -2}, {-1, 4, 0}}};
  const double u = theta * dt;
  taylor_transition(order, dt, F_numbers);
  const Entries Q(Q_numbers, order);
  const int last = order - 1;
  for (int p = 0; p < order; ++p) {
    F_numbers[last - p + last * order] = std::pow(-dt, p) * exponential_tail(u, p, 0.0, 0.0, 1.0);
    gain[last - p] = -std::pow(-dt, p) * u * exponential_tail(u, p + 1, 0.0, 0.0, 1.0);
    for (int r = 0; r <= p; ++r) {
      const auto& [a, b, c] = table[static_cast<std::size_t>(p * (p + 1) / 2 + r)];
      Q(last - p, last - r) = Q(last - r, last - p) =
          sigma * sigma * std::pow(dt, p + r) * u * exponential_tail(u, p + r + 1, a, b, c);
    }
  }
}

void known_turn(int axes, double omega, double q, double dt, double* F, double* Q_numbers) {
  const double theta = omega * dt;
  write_turn(Turn(theta), axes, dt, Entries(F, 2 * axes));
  const double s = cubic_remainder_of_sine(theta);
  const double c = 0.5 * sinc(0.5 * theta) * sinc(0.5 * theta);
  const Entries Q(Q_numbers, 2 * axes);
  for (int a = 0; a < axes; ++a) {
    const bool turns = a < 2;
    Q(a, a) = q * dt * dt * dt * (turns ? 2.0 * s : 1.0 / 3.0);
    Q(a, axes + a) = Q(axes + a, a) = q * dt * dt * (turns ? c : 0.5);
    Q(axes + a, axes + a) = q * dt;
  }
  Q(0, axes + 1) = Q(axes + 1, 0) = q * dt * dt * theta * s;
  Q(1, axes) = Q(axes, 1) = -Q(0, axes + 1);
}

void coordinated_turn(int axes, double q, double q_omega, const double* x, double dt, double* image, double* F_numbers,
                      double* Q_numbers) {
  const int rate = 2 * axes;
  const double theta = x[rate] * dt, vx = x[axes], vy = x[axes + 1];
  const Turn turn(theta);
  std::copy_n(x, rate + 1, image);
  image[0] += dt * (turn.along * vx - turn.across * vy);
  image[1] += dt * (turn.across * vx + turn.along * vy);
  if (axes == 3) image[2] += dt * x[5];
  image[axes] = turn.cosine * vx - turn.sine * vy;
  image[axes + 1] = turn.sine * vx + turn.cosine * vy;
  if (F_numbers) {
    const double half = 0.5 * theta, ratio = sinc(half), slope = sinc_derivative(half);
    const double along = 0.5 * (slope * std::cos(half) - ratio * std::sin(half));  // derivatives by θ
    const double across = 0.5 * ratio * (ratio + theta * slope);
    const Entries F(F_numbers, rate + 1);
    write_turn(turn, axes, dt, F);
    F(0, rate) = dt * dt * (along * vx - across * vy);
    F(1, rate) = dt * dt * (across * vx + along * vy);
    F(axes, rate) = -dt * (turn.sine * vx + turn.cosine * vy);
    F(axes + 1, rate) = dt * (turn.cosine * vx - turn.sine * vy);
  }
  if (Q_numbers) {
    const Entries Q(Q_numbers, rate + 1);
    for (int a = 0; a < axes; ++a) {
      Q(a, a) = q * dt * dt * dt / 3.0;
      Q(a, axes + a) = Q(axes + a, a) = q * dt * dt / 2.0;
      Q(axes + a, axes + a) = q * dt;
    }
    Q(rate, rate) = q_omega * dt;
  }
}

void spread_over_axes(const double* law, int order, int axes, double* matrix) {
  const int n = order * axes;
  std::fill_n(matrix, n * n, 0.0);
  for (int b = 0; b < order; ++b)
    for (int a = 0; a < order; ++a)
      for (int i = 0; i < axes; ++i) matrix[a * axes + i + (b * axes + i) * n] = law[a + b * order];
}

std::vector<std::string> motion_components(int axes, int orders) {
  std::vector<std::string> names;
  for (const char* derivative : {"", "v", "a"})
    for (const char* axis : {"x", "y", "z"})
      if (static_cast<int>(names.size()) < axes * orders && axis[0] - 'x' < axes)
        names.push_back(std::string(derivative) + axis);
  return names;
}

double finite_rate(double omega) {
  if (std::isfinite(omega)) return omega;
  throw std::invalid_argument("the rate of model 'known_turn' is " + std::to_string(omega) + "; expected a finite one");
}

double motion_parameter(double value, std::string_view parameter, std::string_view model) {
  if (value >= 0.0 && value <= 1e150) return value;
  throw std::invalid_argument(std::string(parameter) + " of model '" + std::string(model) + "' is " +
                              std::to_string(value) + "; expected a finite number of at least 0.000000");
}

}  // namespace sigmax::detail
