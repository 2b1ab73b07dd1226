/// A restatement of IMM and HIMM, (47)–(68), in dense matrices and plain loops.
///
/// It shares no code with the library, not even its algebra, and is written for reading: no cleverness, no speed. What
/// the paper leaves open is an option here as it is there, and the tie rules are part of the definition.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace restatement {

using Index = std::size_t;
using Vector = std::vector<double>;

inline constexpr double nothing = -std::numeric_limits<double>::infinity();  // The logarithm of zero.
inline constexpr double tie_tolerance = 1e-9;                                // In log weights.

/// A dense matrix, row by row.
struct Matrix {
  Matrix() = default;
  Matrix(Index rows_, Index columns_) : rows{rows_}, columns{columns_}, values(rows_ * columns_, 0.0) {}
  Matrix(Index rows_, Index columns_, Vector values_) : rows{rows_}, columns{columns_}, values{std::move(values_)} {
    if (values.size() != rows * columns) throw std::invalid_argument{"a matrix with a wrong number of values"};
  }

  double& operator()(Index i, Index j) { return values[i * columns + j]; }
  double operator()(Index i, Index j) const { return values[i * columns + j]; }

  Index rows = 0;
  Index columns = 0;
  Vector values;
};

inline Matrix identity(Index n) {
  Matrix result(n, n);
  for (Index i = 0; i < n; ++i) result(i, i) = 1.0;
  return result;
}

inline Matrix operator*(const Matrix& a, const Matrix& b) {
  Matrix result(a.rows, b.columns);
  for (Index i = 0; i < a.rows; ++i)
    for (Index j = 0; j < b.columns; ++j)
      for (Index k = 0; k < a.columns; ++k) result(i, j) += a(i, k) * b(k, j);
  return result;
}

inline Vector operator*(const Matrix& a, const Vector& x) {
  Vector result(a.rows, 0.0);
  for (Index i = 0; i < a.rows; ++i)
    for (Index k = 0; k < a.columns; ++k) result[i] += a(i, k) * x[k];
  return result;
}

inline Matrix transposed(const Matrix& a) {
  Matrix result(a.columns, a.rows);
  for (Index i = 0; i < a.rows; ++i)
    for (Index j = 0; j < a.columns; ++j) result(j, i) = a(i, j);
  return result;
}

inline Matrix operator*(double factor, Matrix a) {
  for (double& value : a.values) value *= factor;
  return a;
}

inline Matrix operator+(Matrix a, const Matrix& b) {
  for (Index i = 0; i < a.values.size(); ++i) a.values[i] += b.values[i];
  return a;
}

inline Matrix operator-(Matrix a, const Matrix& b) {
  for (Index i = 0; i < a.values.size(); ++i) a.values[i] -= b.values[i];
  return a;
}

inline Vector difference(const Vector& a, const Vector& b) {
  Vector result = a;
  for (Index i = 0; i < a.size(); ++i) result[i] -= b[i];
  return result;
}

inline Matrix outer(const Vector& a) {
  Matrix result(a.size(), a.size());
  for (Index i = 0; i < a.size(); ++i)
    for (Index j = 0; j < a.size(); ++j) result(i, j) = a[i] * a[j];
  return result;
}

inline double dot(const Vector& a, const Vector& b) {
  double result = 0.0;
  for (Index i = 0; i < a.size(); ++i) result += a[i] * b[i];
  return result;
}

inline Matrix symmetrised(const Matrix& a) {
  Matrix result(a.rows, a.columns);
  for (Index i = 0; i < a.rows; ++i)
    for (Index j = 0; j < a.columns; ++j) result(i, j) = 0.5 * (a(i, j) + a(j, i));
  return result;
}

/// Each value of `small` becomes a block value · `block`.
inline Matrix kronecker(const Matrix& small, const Matrix& block) {
  Matrix result(small.rows * block.rows, small.columns * block.columns);
  for (Index i = 0; i < small.rows; ++i)
    for (Index j = 0; j < small.columns; ++j)
      for (Index m = 0; m < block.rows; ++m)
        for (Index n = 0; n < block.columns; ++n)
          result(i * block.rows + m, j * block.columns + n) = small(i, j) * block(m, n);
  return result;
}

struct Inverse {
  Matrix matrix;
  double log_determinant = 0.0;
};

/// Gauss–Jordan elimination with partial pivoting.
inline Inverse inverse(Matrix a) {
  const Index n = a.rows;
  Inverse result{identity(n), 0.0};
  for (Index column = 0; column < n; ++column) {
    Index pivot = column;
    for (Index i = column + 1; i < n; ++i)
      if (std::abs(a(i, column)) > std::abs(a(pivot, column))) pivot = i;
    if (a(pivot, column) == 0.0) throw std::domain_error{"a singular matrix"};
    for (Index j = 0; j < n; ++j) {
      std::swap(a(column, j), a(pivot, j));
      std::swap(result.matrix(column, j), result.matrix(pivot, j));
    }
    const double scale = a(column, column);
    result.log_determinant += std::log(std::abs(scale));
    for (Index j = 0; j < n; ++j) {
      a(column, j) /= scale;
      result.matrix(column, j) /= scale;
    }
    for (Index i = 0; i < n; ++i) {
      if (i == column) continue;
      const double factor = a(i, column);
      for (Index j = 0; j < n; ++j) {
        a(i, j) -= factor * a(column, j);
        result.matrix(i, j) -= factor * result.matrix(column, j);
      }
    }
  }
  return result;
}

/// x_k = F(dt) x_{k−1} + w, w ~ N(0, Q(dt)); z_k = H x_k + v, (47)–(48); the components of x have names.
struct Model {
  std::vector<std::string> components;
  std::function<Matrix(double)> F;
  std::function<Matrix(double)> Q;
  Matrix H;
};

inline std::vector<std::string> kinematic_components(Index axes, Index derivatives) {
  const std::vector<std::string> prefixes{"", "v", "a"};
  const std::vector<std::string> names{"x", "y", "z"};
  std::vector<std::string> result;
  for (Index d = 0; d < derivatives; ++d)
    for (Index axis = 0; axis < axes; ++axis) result.push_back(prefixes[d] + names[axis]);
  return result;
}

/// Discrete white noise acceleration, section VI.B: components x, y, z, vx, vy, vz.
inline Model dwna(Index axes, double sigma_w) {
  return {kinematic_components(axes, 2),
          [axes](double T) {
            return kronecker(Matrix(2, 2, {1, T, 0, 1}), identity(axes));
          },
          [axes, sigma_w](double T) {
            const Matrix Q = outer({T * T / 2, T});
            return kronecker(sigma_w * sigma_w * Q, identity(axes));
          },
          kronecker(Matrix(1, 2, {1, 0}), identity(axes))};
}

/// Discrete Wiener process acceleration, section VI.B: components x, y, z, vx, vy, vz, ax, ay, az.
inline Model dwpa(Index axes, double sigma_w) {
  return {kinematic_components(axes, 3),
          [axes](double T) {
            return kronecker(Matrix(3, 3, {1, T, T * T / 2, 0, 1, T, 0, 0, 1}), identity(axes));
          },
          [axes, sigma_w](double T) {
            const Matrix Q = outer({T * T / 2, T, 1});
            return kronecker(sigma_w * sigma_w * Q, identity(axes));
          },
          kronecker(Matrix(1, 3, {1, 0, 0}), identity(axes))};
}

struct State {
  Vector mean;
  Matrix covariance;
};

/// What a measurement told beyond its prediction at a state, and the Jacobian there, in the components of a model.
struct Seen {
  Vector nu;
  Matrix H;
};
using See = std::function<Seen(const Model&, const Vector&)>;

inline See seen_by_matrix(const Vector& z) {
  return [z](const Model& model, const Vector& x) -> Seen { return {difference(z, model.H * x), model.H}; };
}

enum class Kind { imm, himm };
enum class Weights { correct, released };  // Which weights mix the covariance in (59).
enum class MixedCovariance { selected, own, own_recentred, released, envelope };  // The readings of (57).
enum class Lift { zero, borrowed_variance, unbiased };  // What a model lacks when it is received.
enum class Tie { stay, first, last };

struct Options {
  Kind kind = Kind::imm;
  Weights mixing_weights = Weights::correct;
  MixedCovariance mixed_covariance = MixedCovariance::selected;
  Lift lift = Lift::zero;
  Tie mixing_tie = Tie::stay;
  Tie output_tie = Tie::stay;
  bool common_start = false;           // One mixture for all models, by the weights before the step: GPB1.
  bool possibilistic = false;          // exp(−d²/2) instead of the density.
  bool output_spread_omitted = false;  // (68) as printed.
  std::function<State(const std::vector<State>&, const Vector&)> envelope = {};  // from states and weights.
};

/// The largest of some log weights; within the tolerance the rule decides, `current` first for `stay`.
inline Index largest(const Vector& log_weights, Tie tie, Index current) {
  const double top = *std::max_element(log_weights.begin(), log_weights.end());
  std::vector<Index> tied;
  for (Index l = 0; l < log_weights.size(); ++l)
    if (log_weights[l] >= top - tie_tolerance) tied.push_back(l);
  if (tie == Tie::stay && std::find(tied.begin(), tied.end(), current) != tied.end()) return current;
  return tie == Tie::last ? tied.back() : tied.front();
}

/// log Σ exp or max: what normalises the weights of a random or of a fuzzy mode.
inline double log_total(const Vector& logs, Kind kind) {
  const double top = *std::max_element(logs.begin(), logs.end());
  if (kind == Kind::himm || top == nothing) return top;
  double total = 0.0;
  for (const double value : logs) total += std::exp(value - top);
  return top + std::log(total);
}

inline std::optional<Index> position(const std::vector<std::string>& components, const std::string& name) {
  const auto found = std::find(components.begin(), components.end(), name);
  if (found == components.end()) return std::nullopt;
  return static_cast<Index>(found - components.begin());
}

/// IMM or HIMM over models whose components may differ.
class Filter {
 public:
  /// `transition(i, j)` is the weight of mode j after mode i; `weights` are linear and need not be normalised.
  Filter(std::vector<Model> models, Matrix transition, std::vector<State> states, const Vector& weights,
         Options options)
      : models_{std::move(models)},
        transition_{std::move(transition)},
        states_{std::move(states)},
        options_{options},
        log_weights_(models_.size()) {
    for (Index j = 0; j < models_.size(); ++j) log_weights_[j] = std::log(weights[j]);
    const double total = log_total(log_weights_, options_.kind);
    for (double& value : log_weights_) value -= total;
    winner_ = largest(log_weights_, options_.output_tie, 0);
    for (const Model& model : models_)
      for (const std::string& name : model.components)
        if (!position(components_, name)) components_.push_back(name);
  }

  /// One scan with a measurement by H.
  void step(double dt, const Vector& z, const Matrix& R) { step(dt, seen_by_matrix(z), R); }

  /// One scan with any measurement.
  void step(double dt, const See& see, const Matrix& R) {
    interact();
    predict(dt);
    const Vector before = log_weights_;
    Vector fits;  // Log weight of each hypothesis ⊗ exp(−d²/2), for gates.
    std::vector<Vector> innovations;
    std::vector<Matrix> innovation_covariances;
    for (Index j = 0; j < models_.size(); ++j) {
      const auto [nu, H] = see(models_[j], states_[j].mean);
      const Matrix S = symmetrised(H * states_[j].covariance * transposed(H) + R);  // (31)
      const Inverse S_inverse = inverse(S);
      const Matrix W = states_[j].covariance * transposed(H) * S_inverse.matrix;  // (32)
      const Vector correction = W * nu;
      for (Index i = 0; i < correction.size(); ++i) states_[j].mean[i] += correction[i];  // (29)
      const Matrix kept = identity(correction.size()) - W * H;
      states_[j].covariance = symmetrised(kept * states_[j].covariance * transposed(kept) +  // (30)
                                          W * R * transposed(W));
      fits.push_back(log_weights_[j] - 0.5 * dot(nu, S_inverse.matrix * nu));
      log_weights_[j] += log_likelihood(nu, S_inverse);  // (62), (63)
      innovations.push_back(nu);
      innovation_covariances.push_back(S);
    }
    const double total = log_total(log_weights_, options_.kind);
    for (double& value : log_weights_) value -= total;
    tell_evidence(before, total);
    gate_distance_ = -2.0 * log_total(fits, options_.kind);
    nis_ = collapsed_nis(before, innovations, innovation_covariances);
    winner_ = largest(log_weights_, options_.output_tie, winner_);
  }

  /// One scan without a measurement.
  void step(double dt) {
    interact();
    predict(dt);
    nis_.reset();
    winner_ = largest(log_weights_, options_.output_tie, winner_);
  }

  const std::vector<State>& states() const { return states_; }
  const Vector& log_weights() const { return log_weights_; }
  Index winner() const { return winner_; }
  std::optional<double> nis() const { return nis_; }
  /// −2 log Σ or max of w exp(−d²/2) over all hypotheses, with the weights before the measurement.
  double gate_distance() const { return gate_distance_; }
  /// log Σ or max of w Λ over the modes, with the weights before the measurement, and the same where they sum to one.
  double log_evidence() const { return log_evidence_; }
  double log_score() const { return log_score_; }

  /// The union of all components in the order in which the models bring them; the estimate is stated in it.
  const std::vector<std::string>& components() const { return components_; }

  /// (64)–(66), or (67)–(68) with the spread of the means.
  State estimate() const {
    const bool envelope = options_.mixed_covariance == MixedCovariance::envelope;
    if (options_.kind == Kind::himm && !envelope) return in_union(winner_);
    std::vector<State> lifted;
    std::vector<double> weights;
    for (Index l = 0; l < models_.size(); ++l) {
      lifted.push_back(in_union(l));
      weights.push_back(std::exp(log_weights_[l]));
    }
    if (envelope) return options_.envelope(lifted, weights);
    State result = moments(lifted, weights, weights);
    if (options_.output_spread_omitted)
      for (Index l = 0; l < lifted.size(); ++l)
        result.covariance = result.covariance - weights[l] * outer(difference(result.mean, lifted[l].mean));
    return result;
  }

 protected:
  double log_likelihood(const Vector& nu, const Inverse& S_inverse) const {
    const double squared_distance = dot(nu, S_inverse.matrix * nu);
    if (options_.possibilistic) return -0.5 * squared_distance;
    return -0.5 * (squared_distance + S_inverse.log_determinant +
                   static_cast<double>(nu.size()) * std::log(2.0 * std::numbers::pi));
  }

  /// Step 1, (51)–(59).
  void interact() {
    const Index M = models_.size();
    // move_in[j][l] is the log weight of r_{k−1} = l given r_k = j; an unreachable mode comes from itself
    // and keeps its state.
    Vector predicted(M);
    std::vector<Vector> move_in(M, Vector(M));
    for (Index j = 0; j < M; ++j) {
      for (Index l = 0; l < M; ++l) move_in[j][l] = std::log(transition_(l, j)) + log_weights_[l];
      predicted[j] = log_total(move_in[j], options_.kind);
      for (Index l = 0; l < M; ++l) {
        if (predicted[j] == nothing)
          move_in[j][l] = l == j ? 0.0 : nothing;
        else
          move_in[j][l] -= predicted[j];
        if (options_.common_start && predicted[j] != nothing) move_in[j][l] = log_weights_[l];
      }
    }

    std::vector<State> mixed;
    for (Index j = 0; j < M; ++j) {
      if (predicted[j] == nothing)
        mixed.push_back(states_[j]);
      else
        mixed.push_back(options_.kind == Kind::imm ? averaged(j, move_in) : selected(j, move_in[j]));
    }
    states_ = mixed;
    log_weights_ = predicted;
    const double total = log_total(log_weights_, options_.kind);
    for (double& value : log_weights_) value -= total;
  }

  /// (58)–(59) with Σ^l.
  State averaged(Index j, const std::vector<Vector>& move_in) const {
    std::vector<State> lifted;
    std::vector<double> mean_weights;
    std::vector<double> covariance_weights;
    for (Index l = 0; l < models_.size(); ++l) {
      lifted.push_back(received(l, j));
      mean_weights.push_back(std::exp(move_in[j][l]));
      covariance_weights.push_back(std::exp(
          options_.mixing_weights == Weights::correct || options_.common_start ? move_in[j][l] : move_in[l][j]));
    }
    return moments(lifted, mean_weights, covariance_weights);
  }

  /// (55)–(57).
  State selected(Index j, const Vector& move_in) const {
    if (options_.mixed_covariance == MixedCovariance::envelope) {
      std::vector<State> lifted;
      Vector weights;
      for (Index l = 0; l < models_.size(); ++l) {
        lifted.push_back(received(l, j));
        weights.push_back(std::exp(move_in[l]));
      }
      return options_.envelope(lifted, weights);
    }
    const Index l = largest(move_in, options_.mixing_tie, options_.common_start ? winner_ : j);
    const State winner = received(l, j);
    const Matrix& own = states_[j].covariance;
    switch (options_.mixed_covariance) {
      case MixedCovariance::selected:
        return winner;
      case MixedCovariance::own:
        return {winner.mean, own};
      case MixedCovariance::own_recentred:
        return {winner.mean, own + outer(difference(winner.mean, states_[j].mean))};
      case MixedCovariance::released:
        return {winner.mean, own + outer(difference(winner.mean, received(0, j).mean))};
      case MixedCovariance::envelope:
        break;
    }
    throw std::logic_error{"no such reading"};
  }

  static State moments(const std::vector<State>& states, const Vector& mean_weights, const Vector& covariance_weights) {
    const Index n = states.front().mean.size();
    State result{Vector(n, 0.0), Matrix(n, n)};
    for (Index l = 0; l < states.size(); ++l)
      for (Index i = 0; i < n; ++i) result.mean[i] += mean_weights[l] * states[l].mean[i];
    for (Index l = 0; l < states.size(); ++l)
      result.covariance = result.covariance + covariance_weights[l] * (states[l].covariance +
                                                                       outer(difference(result.mean, states[l].mean)));
    return result;
  }

  /// The state of model `l` in some components, of which each lacking one is received by a model that has it.
  State lifted(Index l, const std::vector<std::string>& components,
               const std::function<Index(const std::string&)>& receiver_of) const {
    const Index n = components.size();
    State result{Vector(n, 0.0), Matrix(n, n)};
    for (Index a = 0; a < n; ++a) {
      const auto from_a = position(models_[l].components, components[a]);
      if (from_a) {
        result.mean[a] = states_[l].mean[*from_a];
        for (Index b = 0; b < n; ++b)
          if (const auto from_b = position(models_[l].components, components[b]))
            result.covariance(a, b) = states_[l].covariance(*from_a, *from_b);
        continue;
      }
      if (options_.lift == Lift::zero) continue;
      const Index receiver = receiver_of(components[a]);
      const Index own_a = *position(models_[receiver].components, components[a]);
      if (options_.lift == Lift::borrowed_variance) {
        result.covariance(a, a) = states_[receiver].covariance(own_a, own_a);
        continue;
      }
      result.mean[a] = states_[receiver].mean[own_a];
      for (Index b = 0; b < n; ++b) {
        if (position(models_[l].components, components[b]) || receiver_of(components[b]) != receiver) continue;
        result.covariance(a, b) =
            states_[receiver].covariance(own_a, *position(models_[receiver].components, components[b]));
      }
    }
    return result;
  }

  State received(Index l, Index j) const {
    return lifted(l, models_[j].components, [j](const std::string&) { return j; });
  }

  /// Who receives a lacking component of the output: the most likely model that has it.
  State in_union(Index l) const {
    return lifted(l, components_, [this](const std::string& name) {
      Vector candidates = log_weights_;
      Index first = models_.size();
      for (Index m = models_.size(); m-- > 0;) {
        if (position(models_[m].components, name))
          first = m;
        else
          candidates[m] = nothing;
      }
      if (*std::max_element(candidates.begin(), candidates.end()) == nothing) return first;
      return largest(candidates, options_.output_tie, winner_);
    });
  }

  /// Step 2, the prediction: (27)–(28).
  void predict(double dt) {
    for (Index j = 0; j < models_.size(); ++j) {
      const Matrix F = models_[j].F(dt);
      states_[j].mean = F * states_[j].mean;
      states_[j].covariance = symmetrised(F * states_[j].covariance * transposed(F) + models_[j].Q(dt));
    }
  }

  double collapsed_nis(const Vector& log_weights, const std::vector<Vector>& innovations,
                       const std::vector<Matrix>& covariances) const {
    std::vector<State> modes;
    std::vector<double> weights;
    for (Index j = 0; j < innovations.size(); ++j) {
      modes.push_back({innovations[j], covariances[j]});
      weights.push_back(std::exp(log_weights[j]));
    }
    const State one = options_.kind == Kind::imm ? moments(modes, weights, weights)
                                                 : modes[largest(log_weights, options_.output_tie, winner_)];
    return dot(one.mean, inverse(one.covariance).matrix * one.mean);
  }

  void tell_evidence(const Vector& before, double total) {
    double sum = 0.0;
    for (const double log_weight : before) sum += std::exp(log_weight);
    log_evidence_ = total;
    log_score_ = total - std::log(sum);
  }

  std::vector<Model> models_;
  Matrix transition_;
  std::vector<State> states_;
  Options options_;
  Vector log_weights_;
  Index winner_ = 0;
  std::optional<double> nis_;
  double gate_distance_ = 0.0;
  double log_evidence_ = 0.0;
  double log_score_ = 0.0;
  std::vector<std::string> components_;
};

/// A measured position with its covariance.
struct Position {
  Vector z;
  Matrix R;
};

/// The standard conversion of range, azimuth and elevation by its printed elements; azimuth from x towards y.
inline Position standard_conversion(double r, double a, double e, double sigma_r, double sigma_a, double sigma_e) {
  const double ca = std::cos(a), sa = std::sin(a), ce = std::cos(e), se = std::sin(e);
  const double Sr = sigma_r * sigma_r, Sa = sigma_a * sigma_a, Se = sigma_e * sigma_e, r2 = r * r;
  const double xx = Sr * ce * ce * ca * ca + r2 * ce * ce * sa * sa * Sa + r2 * se * se * ca * ca * Se;
  const double yy = Sr * ce * ce * sa * sa + r2 * ce * ce * ca * ca * Sa + r2 * se * se * sa * sa * Se;
  const double zz = Sr * se * se + r2 * ce * ce * Se;
  const double xy = sa * ca * (Sr * ce * ce - r2 * ce * ce * Sa + r2 * se * se * Se);
  const double xz = se * ce * ca * (Sr - r2 * Se);
  const double yz = se * ce * sa * (Sr - r2 * Se);
  return {{r * ce * ca, r * ce * sa, r * se}, Matrix(3, 3, {xx, xy, xz, xy, yy, yz, xz, yz, zz})};
}

/// A start by weights: derivative d of the state is Σ_i weights(d, i) z_i, with independent measurements.
inline State weighted_start(const Matrix& weights, const std::vector<Position>& points) {
  const Index axes = points.front().z.size();
  State result{Vector(weights.rows * axes, 0.0), Matrix(weights.rows * axes, weights.rows * axes)};
  for (Index i = 0; i < points.size(); ++i)
    for (Index d = 0; d < weights.rows; ++d)
      for (Index axis = 0; axis < axes; ++axis) {
        result.mean[d * axes + axis] += weights(d, i) * points[i].z[axis];
        for (Index f = 0; f < weights.rows; ++f)
          for (Index other = 0; other < axes; ++other)
            result.covariance(d * axes + axis, f * axes + other) +=
                weights(d, i) * weights(f, i) * points[i].R(axis, other);
      }
  return result;
}

/// x = z₂, v = (z₂ − z₁)/T.
inline State two_point_start(const Position& first, const Position& second, double T) {
  return weighted_start(Matrix(2, 2, {0, 1, -1 / T, 1 / T}), {first, second});
}

/// Unbiased under constant acceleration, with `T12` from the first point to the second and `T23` on to the third: the
/// derivatives at the third point of the parabola through all three.
inline State three_point_start(const Position& first, const Position& second, const Position& third, double T12,
                               double T23) {
  const double T13 = T12 + T23;
  const Matrix weights(3, 3,
                       {0, 0, 1,                                                   //
                        T23 / (T12 * T13), -T13 / (T12 * T23), 1 / T13 + 1 / T23,  //
                        2 / (T12 * T13), -2 / (T12 * T23), 2 / (T13 * T23)});
  return weighted_start(weights, {first, second, third});
}

/// The start of the released program: x = z₃, v = (z₃ − z₂)/T, a = (z₃ − 2z₂ + z₁)/T², and R₃ for every point.
inline State released_start(const Position& first, const Position& second, const Position& third, double T) {
  const Index axes = third.z.size();
  State result{Vector(3 * axes), kronecker(Matrix(3, 3,
                                                  {1, 1 / T, 1 / (T * T),                //
                                                   1 / T, 2 / (T * T), 3 / (T * T * T),  //
                                                   1 / (T * T), 3 / (T * T * T), 6 / (T * T * T * T)}),
                                           third.R)};
  for (Index axis = 0; axis < axes; ++axis) {
    result.mean[axis] = third.z[axis];
    result.mean[axes + axis] = (third.z[axis] - second.z[axis]) / T;
    result.mean[2 * axes + axis] = (third.z[axis] - 2 * second.z[axis] + first.z[axis]) / (T * T);
  }
  return result;
}

/// The leading part of a state: a model without acceleration takes what it has.
inline State leading(const State& state, Index n) {
  State result{Vector(n), Matrix(n, n)};
  for (Index i = 0; i < n; ++i) {
    result.mean[i] = state.mean[i];
    for (Index j = 0; j < n; ++j) result.covariance(i, j) = state.covariance(i, j);
  }
  return result;
}

}  // namespace restatement
