/// A restatement of IMM and HIMM, (47)–(68), and of GPB2 and the Viterbi filter, in dense matrices and plain loops.
///
/// It shares no code with the library, not even its algebra, and is written for reading: no cleverness, no speed. What
/// the paper leaves open is an option here as it is there, and the tie rules are part of the definition.
#pragma once

#include "support/test.hpp"

namespace restatement {

using Index = std::size_t;
using Vector = std::vector<double>;

inline constexpr double nothing = -std::numeric_limits<double>::infinity();  // The logarithm of zero.
inline constexpr double tie_tolerance = 1e-9;                                // In log weights.

/// A dense matrix of any numbers, row by row.
template <class Real>
struct MatrixOf {
  MatrixOf() = default;
  MatrixOf(Index rows_, Index columns_) : MatrixOf(rows_, columns_, std::vector<Real>(rows_ * columns_, Real(0))) {}
  MatrixOf(Index rows_, Index columns_, std::vector<Real> values_)
      : rows{rows_}, columns{columns_}, values{std::move(values_)} {
    if (values.size() != rows * columns) throw std::invalid_argument{"a matrix with a wrong number of values"};
  }

  Real& operator()(Index i, Index j) { return values[i * columns + j]; }
  const Real& operator()(Index i, Index j) const { return values[i * columns + j]; }

  friend MatrixOf operator*(const MatrixOf& a, const MatrixOf& b) {
    MatrixOf result(a.rows, b.columns);
    for (Index i = 0; i < a.rows; ++i)
      for (Index k = 0; k < a.columns; ++k)
        if (a(i, k) != 0)
          for (Index j = 0; j < b.columns; ++j) result(i, j) += a(i, k) * b(k, j);
    return result;
  }
  friend MatrixOf operator*(const Real& factor, MatrixOf a) {
    for (Real& value : a.values) value *= factor;
    return a;
  }
  friend MatrixOf operator+(MatrixOf a, const MatrixOf& b) {
    for (Index i = 0; i < a.values.size(); ++i) a.values[i] += b.values[i];
    return a;
  }
  friend MatrixOf operator-(MatrixOf a, const MatrixOf& b) {
    for (Index i = 0; i < a.values.size(); ++i) a.values[i] -= b.values[i];
    return a;
  }

  Index rows = 0;
  Index columns = 0;
  std::vector<Real> values;
};
using Matrix = MatrixOf<double>;

/// The same matrix in other numbers, and a column of them.
template <class Real>
MatrixOf<Real> as(const Matrix& a) {
  return {a.rows, a.columns, std::vector<Real>(a.values.begin(), a.values.end())};
}
template <class Real>
MatrixOf<Real> as(const Vector& x) {
  return {x.size(), 1, std::vector<Real>(x.begin(), x.end())};
}

template <class Real = double>
MatrixOf<Real> identity(Index n) {
  MatrixOf<Real> result(n, n);
  for (Index i = 0; i < n; ++i) result(i, i) = 1;
  return result;
}

inline Vector operator*(const Matrix& a, const Vector& x) {
  Vector result(a.rows, 0.0);
  for (Index i = 0; i < a.rows; ++i)
    for (Index k = 0; k < a.columns; ++k) result[i] += a(i, k) * x[k];
  return result;
}

template <class Real>
MatrixOf<Real> transposed(const MatrixOf<Real>& a) {
  MatrixOf<Real> result(a.columns, a.rows);
  for (Index i = 0; i < a.rows; ++i)
    for (Index j = 0; j < a.columns; ++j) result(j, i) = a(i, j);
  return result;
}

inline Vector difference(const Vector& a, const Vector& b) {
  Vector result = a;
  for (Index i = 0; i < a.size(); ++i) result[i] -= b[i];
  return result;
}

template <class Real>
MatrixOf<Real> outer(const std::vector<Real>& a) {
  const MatrixOf<Real> column(a.size(), 1, a);
  return column * transposed(column);
}

inline double dot(const Vector& a, const Vector& b) {
  double result = 0.0;
  for (Index i = 0; i < a.size(); ++i) result += a[i] * b[i];
  return result;
}

inline Matrix symmetrised(const Matrix& a) { return 0.5 * (a + transposed(a)); }

/// Each value of `small` becomes a block value · `block`.
template <class Real>
MatrixOf<Real> kronecker(const MatrixOf<Real>& small, const MatrixOf<Real>& block) {
  MatrixOf<Real> result(small.rows * block.rows, small.columns * block.columns);
  for (Index i = 0; i < small.rows; ++i)
    for (Index j = 0; j < small.columns; ++j)
      for (Index m = 0; m < block.rows; ++m)
        for (Index n = 0; n < block.columns; ++n)
          result(i * block.rows + m, j * block.columns + n) = small(i, j) * block(m, n);
  return result;
}

/// a⁻¹ b by Gauss–Jordan elimination with partial pivoting, and log |det a|.
template <class Real>
std::pair<MatrixOf<Real>, Real> solved(MatrixOf<Real> a, MatrixOf<Real> b) {
  using std::abs, std::log;  // or those of a long number's own
  Real log_determinant = 0;
  for (Index column = 0; column < a.rows; ++column) {
    Index pivot = column;
    for (Index i = column + 1; i < a.rows; ++i)
      if (abs(a(i, column)) > abs(a(pivot, column))) pivot = i;
    const Real scale = a(pivot, column);
    if (scale == 0) throw std::domain_error{"a singular matrix"};
    log_determinant += log(abs(scale));
    const auto eliminate = [&](MatrixOf<Real>& m, const std::vector<Real>& factors) {
      for (Index j = 0; j < m.columns; ++j) {
        std::swap(m(column, j), m(pivot, j));
        m(column, j) /= scale;
        for (Index i = 0; i < m.rows; ++i)
          if (i != column && factors[i] != 0) m(i, j) -= factors[i] * m(column, j);
      }
    };
    std::vector<Real> factors;
    for (Index i = 0; i < a.rows; ++i) factors.push_back(a(i, column));
    std::swap(factors[column], factors[pivot]);
    eliminate(a, factors);
    eliminate(b, factors);
  }
  return {b, log_determinant};
}

struct Inverse {
  Matrix matrix;
  double log_determinant = 0.0;
};
inline Inverse inverse(const Matrix& a) {
  const auto [matrix, log_determinant] = solved(a, identity(a.rows));
  return {matrix, log_determinant};
}

/// x_k = F(dt) x_{k−1} + u(dt) + w, w ~ N(0, Q(dt)); z_k = H x_k + v, (47)–(48); the components of x have names.
template <class Real>
struct ModelOf {
  std::vector<std::string> components;
  std::function<MatrixOf<Real>(double)> F, Q;
  Matrix H;
  std::function<Vector(double)> input = {};  // known, and added to F x, if there is one
};
using Model = ModelOf<double>;

inline std::vector<std::string> kinematic_components(Index axes, Index derivatives) {
  const std::vector<std::string> prefixes{"", "v", "a"};
  const std::vector<std::string> names{"x", "y", "z"};
  std::vector<std::string> result;
  for (Index d = 0; d < derivatives; ++d)
    for (Index axis = 0; axis < axes; ++axis) result.push_back(prefixes[d] + names[axis]);
  return result;
}

/// The same law along each axis: F and Q of a time step over the derivatives of one.
template <class Real>
ModelOf<Real> along_axes(Index axes, Index derivatives, const std::function<MatrixOf<Real>(Real)>& F,
                         const std::function<MatrixOf<Real>(Real)>& Q) {
  Matrix H(axes, axes * derivatives);
  for (Index axis = 0; axis < axes; ++axis) H(axis, axis) = 1.0;
  return {kinematic_components(axes, derivatives), [=](double T) { return kronecker(F(T), identity<Real>(axes)); },
          [=](double T) { return kronecker(Q(T), identity<Real>(axes)); }, H};
}

/// DWNA, of two derivatives, and DWPA, of three, section VI.B: x, y, z, vx, vy, vz, ax, ay, az.
template <class Real = double>
ModelOf<Real> discrete_white_noise(Index axes, Index derivatives, double sigma_w) {
  return along_axes<Real>(
      axes, derivatives,
      [derivatives](Real T) {
        const std::vector<Real> taylor{1, T, T * T / 2};
        MatrixOf<Real> F(derivatives, derivatives);
        for (Index a = 0; a < derivatives; ++a)
          for (Index b = a; b < derivatives; ++b) F(a, b) = taylor[b - a];
        return F;
      },
      [derivatives, sigma_w](Real T) {
        std::vector<Real> gain{T * T / 2, T, 1};
        gain.resize(derivatives);
        return Real(sigma_w) * Real(sigma_w) * outer(gain);
      });
}
inline Model dwna(Index axes, double sigma_w) { return discrete_white_noise(axes, 2, sigma_w); }
inline Model dwpa(Index axes, double sigma_w) { return discrete_white_noise(axes, 3, sigma_w); }

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

/// (27)–(28).
inline State predicted(const Model& model, const State& state, double dt) {
  const Matrix F = model.F(dt);
  Vector mean = F * state.mean;
  if (model.input) mean = difference(mean, difference(Vector(mean.size(), 0.0), model.input(dt)));
  return {mean, symmetrised(F * state.covariance * transposed(F) + model.Q(dt))};
}

/// An estimate with what was seen, and how well that was expected.
struct Sighting {
  State posterior;
  Vector nu;
  Matrix S;
  double squared_distance = 0.0;
  double log_density = 0.0;
};
/// By what is seen about its prediction, its covariance S, and its covariance with the state; (30) as printed.
inline Sighting corrected(const State& prior, const Vector& nu, const Matrix& S, const Matrix& cross) {
  const Inverse S_inverse = inverse(S);
  const Matrix W = cross * S_inverse.matrix;  // (32)
  Sighting result{prior, nu, S, dot(nu, S_inverse.matrix * nu), 0.0};
  const Vector correction = W * nu;
  for (Index i = 0; i < correction.size(); ++i) result.posterior.mean[i] += correction[i];  // (29)
  result.posterior.covariance = prior.covariance - W * S * transposed(W);
  result.log_density = -0.5 * (result.squared_distance + S_inverse.log_determinant +
                               static_cast<double>(nu.size()) * std::log(2.0 * std::numbers::pi));
  return result;
}
/// The same with (30) in Joseph's form.
inline Sighting sighted(const State& prior, const Seen& seen, const Matrix& R) {
  const auto& [nu, H] = seen;
  const Matrix& P = prior.covariance;
  const Matrix S = symmetrised(H * P * transposed(H) + R);  // (31)
  Sighting result = corrected(prior, nu, S, P * transposed(H));
  const Matrix W = P * transposed(H) * inverse(S).matrix, kept = identity(P.rows) - W * H;
  result.posterior.covariance = symmetrised(kept * P * transposed(kept) + W * R * transposed(W));
  return result;
}

enum class Kind { imm, himm };
enum class Order { interacting, second_order, histories };  // When predecessors merge: before z, after it, never.
enum class Weights { correct, released };                   // Which weights mix the covariance in (59).
enum class MixedCovariance { selected, own, own_recentred, released, envelope };  // The readings of (57).
enum class StateAugmentation { zero, borrowed_variance, unbiased, prior };  // What a model lacks when it is received.
enum class Tie { stay, first, last };

struct Options {
  Kind kind = Kind::imm;
  Order order = Order::interacting;
  Weights mixing_weights = Weights::correct;
  MixedCovariance mixed_covariance = MixedCovariance::selected;
  StateAugmentation augmentation = StateAugmentation::zero;
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
template <class Real>
Real log_total(const std::vector<Real>& logs, Kind kind) {
  using std::exp, std::log;
  Real top = logs[0];
  for (const Real& value : logs) top = value > top ? value : top;
  if (kind == Kind::himm || top == nothing) return top;
  Real total = 0;
  for (const Real& value : logs) total += exp(Real(value - top));
  return top + log(total);
}

inline std::optional<Index> position(const std::vector<std::string>& components, const std::string& name) {
  const auto found = std::find(components.begin(), components.end(), name);
  if (found == components.end()) return std::nullopt;
  return static_cast<Index>(found - components.begin());
}

/// The mean of some states by their weights, and their covariance with that of the means; its weights may differ.
inline State moments(const std::vector<State>& states, const Vector& weights, const Vector& covariance_weights) {
  const Index n = states.front().mean.size();
  State result{Vector(n, 0.0), Matrix(n, n)};
  for (Index l = 0; l < states.size(); ++l)
    for (Index i = 0; i < n; ++i) result.mean[i] += weights[l] * states[l].mean[i];
  for (Index l = 0; l < states.size(); ++l)
    result.covariance = result.covariance +
                        covariance_weights[l] * (states[l].covariance + outer(difference(result.mean, states[l].mean)));
  return result;
}

/// IMM, HIMM, GPB2 or the Viterbi filter, over models whose components may differ.
class Filter {
 public:
  /// `transition(i, j)` is the weight of mode j after mode i; `weights` are linear and need not be normalised.
  Filter(std::vector<Model> models, Matrix transition, std::vector<State> states, const Vector& weights,
         Options options)
      : models_{std::move(models)},
        transition_{std::move(transition)},
        states_{std::move(states)},
        options_{std::move(options)} {
    for (const double weight : weights) log_weights_.push_back(std::log(weight));
    normalise();
    winner_ = largest(log_weights_, options_.output_tie, 0);
    for (const Model& model : models_)
      for (const std::string& name : model.components)
        if (!position(components_, name)) components_.push_back(name);
  }

  /// One scan with a measurement by H, with any measurement, and without one.
  void step(double dt, const Vector& z, const Matrix& R) { step(dt, seen_by_matrix(z), R); }
  void step(double dt, const See& see, const Matrix& R) { cycle(dt, &see, R); }
  void step(double dt) { cycle(dt, nullptr, {}); }

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
    std::vector<State> augmented;
    std::vector<double> weights;
    for (Index l = 0; l < models_.size(); ++l) {
      augmented.push_back(in_union(l));
      weights.push_back(std::exp(log_weights_[l]));
    }
    if (envelope) return options_.envelope(augmented, weights);
    State result = moments(augmented, weights, weights);
    if (options_.output_spread_omitted)
      for (Index l = 0; l < augmented.size(); ++l)
        result.covariance = result.covariance - weights[l] * outer(difference(result.mean, augmented[l].mean));
    return result;
  }

 protected:
  /// One way into a mode: what is known of the state if it is true, and its log weight before and after z.
  struct Hypothesis {
    State state;
    double before = nothing;
    double after = nothing;
    State innovation = {};
  };

  void cycle(double dt, const See* see, const Matrix& R) {
    std::vector<std::vector<Hypothesis>> of_mode;
    Vector before, after, fits;
    for (Index j = 0; j < models_.size(); ++j) {
      auto& own = of_mode.emplace_back(options_.order == Order::second_order ? pairs(j) : std::vector{mixed(j)});
      for (Hypothesis& each : own) {
        each.state = predicted(models_[j], each.state, dt);
        each.after = each.before;
        if (!see) continue;
        const Sighting seen = sighted(each.state, (*see)(models_[j], each.state.mean), R);
        each.state = seen.posterior;
        each.innovation = {seen.nu, seen.S};
        each.after += options_.possibilistic ? -0.5 * seen.squared_distance : seen.log_density;  // (62), (63)
        fits.push_back(each.before - 0.5 * seen.squared_distance);
      }
      before.push_back(log_total(logs_of(own, &Hypothesis::before), options_.kind));
      after.push_back(log_total(logs_of(own, &Hypothesis::after), options_.kind));
    }
    nis_.reset();
    if (see) {
      gate_distance_ = -2.0 * log_total(fits, options_.kind);
      nis_ = collapsed_nis(of_mode, before);
      log_evidence_ = log_total(after, options_.kind);
      log_score_ = log_evidence_ - log_total(before, Kind::imm);
    }
    for (Index j = 0; j < models_.size(); ++j) states_[j] = merged(of_mode[j], after[j], j);
    log_weights_ = after;
    normalise();
    winner_ = largest(log_weights_, options_.output_tie, winner_);
  }

  static Vector logs_of(const std::vector<Hypothesis>& all, double Hypothesis::*log) {
    Vector result;
    for (const Hypothesis& each : all) result.push_back(each.*log);
    return result;
  }

  /// Log weights of the modes before, with mode j now, as they are and given j.
  Vector move_in(Index j) const {
    Vector result;
    for (Index l = 0; l < models_.size(); ++l) result.push_back(std::log(transition_(l, j)) + log_weights_[l]);
    return result;
  }
  Vector given(Index j) const {
    if (options_.common_start) return log_weights_;
    Vector result = move_in(j);
    const double total = log_total(result, options_.kind);
    for (Index l = 0; l < result.size(); ++l)
      result[l] = total == nothing ? (l == j ? 0.0 : nothing) : result[l] - total;
    return result;
  }

  /// Step 1, (51)–(59): one start for mode j. A mode that nothing reaches keeps its state.
  Hypothesis mixed(Index j) const {
    const double total = log_total(move_in(j), options_.kind);
    if (total == nothing) return {states_[j]};
    return {options_.kind == Kind::imm ? averaged(j) : selected(j), total};
  }

  /// Each predecessor by itself.
  std::vector<Hypothesis> pairs(Index j) const {
    std::vector<Hypothesis> result;
    for (Index l = 0; l < models_.size(); ++l) result.push_back({received(l, j), move_in(j)[l]});
    return result;
  }

  /// (58)–(59) with Σ^l.
  State averaged(Index j) const {
    std::vector<State> augmented;
    Vector weights, covariance_weights;
    for (Index l = 0; l < models_.size(); ++l) {
      augmented.push_back(received(l, j));
      weights.push_back(std::exp(given(j)[l]));
      covariance_weights.push_back(options_.mixing_weights == Weights::correct || options_.common_start
                                       ? weights.back()
                                       : std::exp(given(l)[j]));
    }
    return moments(augmented, weights, covariance_weights);
  }

  /// (55)–(57).
  State selected(Index j) const {
    const Vector logs = given(j);
    if (options_.mixed_covariance == MixedCovariance::envelope) {
      std::vector<State> augmented;
      Vector weights;
      for (Index l = 0; l < models_.size(); ++l) {
        augmented.push_back(received(l, j));
        weights.push_back(std::exp(logs[l]));
      }
      return options_.envelope(augmented, weights);
    }
    const State winner = received(largest(logs, options_.mixing_tie, options_.common_start ? winner_ : j), j);
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

  /// One Gaussian for the ways into mode j; where all are excluded, it comes from itself.
  State merged(const std::vector<Hypothesis>& ways, double total, Index j) const {
    const Index own = ways.size() > 1 ? j : 0;
    if (total == nothing) return ways[own].state;
    if (options_.kind == Kind::himm)
      return ways[largest(logs_of(ways, &Hypothesis::after), options_.mixing_tie, own)].state;
    Vector weights;
    std::vector<State> states;
    for (const Hypothesis& each : ways) {
      weights.push_back(std::exp(each.after - total));
      states.push_back(each.state);
    }
    return moments(states, weights, weights);
  }

  /// Of the mixture of all innovations, by their weights before the measurement.
  double collapsed_nis(const std::vector<std::vector<Hypothesis>>& of_mode, const Vector& before) const {
    State one;
    if (options_.kind == Kind::himm) {
      const Index j = largest(before, options_.output_tie, winner_);
      const auto& ways = of_mode[j];
      one = ways[largest(logs_of(ways, &Hypothesis::before), options_.mixing_tie, ways.size() > 1 ? j : 0)].innovation;
    } else {
      Vector weights;
      std::vector<State> innovations;
      for (const auto& ways : of_mode)
        for (const Hypothesis& each : ways) {
          weights.push_back(std::exp(each.before - log_total(before, options_.kind)));
          innovations.push_back(each.innovation);
        }
      one = moments(innovations, weights, weights);
    }
    return dot(one.mean, inverse(one.covariance).matrix * one.mean);
  }

  void normalise() {
    const double total = log_total(log_weights_, options_.kind);
    for (double& value : log_weights_) value -= total;
  }

  /// The state of model `l` in some components, of which each lacking one is received by a model that has it.
  State augmented(Index l, const std::vector<std::string>& components,
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
      if (options_.augmentation == StateAugmentation::zero) continue;
      const Index receiver = receiver_of(components[a]);
      const Index own_a = *position(models_[receiver].components, components[a]);
      if (options_.augmentation == StateAugmentation::borrowed_variance) {
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
    return augmented(l, models_[j].components, [j](const std::string&) { return j; });
  }

  /// Who receives a lacking component of the output: the most likely model that has it.
  State in_union(Index l) const {
    return augmented(l, components_, [this](const std::string& name) {
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
