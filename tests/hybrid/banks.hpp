#pragma once

#include "support/enveloped.hpp"
#include "support/sigmax.hpp"

/// The flights and the filters of these tests. Which filter it is, over which models and by which rules, is a value: a
/// TargetChoice. So what is asked of all of them is written once, and compiled once.
namespace sigmax::support {

using Models = std::vector<AnyModel>;
using State = EstimateOf<AnyModel>;

/// One scan: seconds since the last, and what was measured, if anything.
struct Scan {
  double dt;
  std::optional<Gaussian<2>> z;
};

/// A radar at the origin sees a target that flies straight, turns hard and flies straight again. Steps are irregular,
/// and every eleventh scan and three in a row are missed.
inline std::vector<Scan> manoeuvring_target(std::size_t scans = 220) {
  constexpr double sigma_r = 10.0, sigma_a = 0.1 * std::numbers::pi / 180.0;
  std::mt19937_64 generator(7);
  std::normal_distribution<double> normal;
  std::vector<Scan> result;
  double x = 12000.0, y = 8000.0, vx = -100.0, vy = -100.0;
  for (std::size_t k = 0; k < scans; ++k) {
    const double dt = std::initializer_list<double>{0.2, 0.2, 0.35, 0.1, 0.0, 0.6}.begin()[k % 6];
    const bool turns = k >= 80 && k < 130;
    const double ax = (turns ? -30.0 : 0.0) + 3.0 * normal(generator);
    const double ay = (turns ? -50.0 : 0.0) + 3.0 * normal(generator);
    x += vx * dt + 0.5 * ax * dt * dt;
    y += vy * dt + 0.5 * ay * dt * dt;
    vx += ax * dt;
    vy += ay * dt;
    const double range = std::hypot(x, y) + sigma_r * normal(generator);
    const double azimuth = std::atan2(y, x) + sigma_a * normal(generator);
    const auto seen = restatement::standard_conversion(range, azimuth, 0.0, sigma_r, sigma_a, 0.0);
    Scan scan{dt, std::nullopt};
    if (k % 11 != 5 && !(k >= 60 && k < 63))
      scan.z = Gaussian<2>{Vector<2>{seen.z[0], seen.z[1]},
                           SquareMatrix<2>{{seen.R(0, 0), seen.R(0, 1)}, {seen.R(1, 0), seen.R(1, 1)}}};
    result.push_back(scan);
  }
  return result;
}

inline MotionChoice motion(const char* name, double sigma_w) {
  MotionChoice result{name};
  result[MotionParameter::sigma_w] = sigma_w;
  return result;
}
inline MotionChoice calm(double sigma_w = 1.0) { return motion("dwna", sigma_w); }
inline MotionChoice turning(double sigma_w = 4.0) { return motion("dwpa", sigma_w); }

/// Three planar models and a transition for their kind of mode.
inline TargetChoice chosen(bool fuzzy, Scheme scheme = Scheme::interacting) {
  TargetChoice choice;
  choice.axes = 2;
  choice.fuzzy = fuzzy;
  choice.scheme = scheme;
  choice.motions = {calm(1.0), calm(5.0), turning()};
  choice.models = {"calm", "rough", "turn"};
  choice.transition = fuzzy ? Rows{{1.0, 0.5, 0.2}, {0.5, 1.0, 0.5}, {0.1, 0.5, 1.0}}
                            : Rows{{0.90, 0.07, 0.03}, {0.10, 0.80, 0.10}, {0.02, 0.08, 0.90}};
  if (scheme == Scheme::histories) choice.augmentation = StateAugmentation::prior;
  return choice;
}
/// The same with other models, and another transition.
inline TargetChoice with(TargetChoice choice, std::vector<MotionChoice> motions, Rows transition) {
  choice.models.clear();
  for (std::size_t j = 0; j < motions.size(); ++j) choice.models.push_back("model " + std::to_string(j));
  choice.motions = std::move(motions);
  choice.transition = std::move(transition);
  return choice;
}
inline TargetChoice with(TargetChoice choice, StateAugmentation augmentation) {
  choice.augmentation = augmentation;
  return choice;
}

/// "himm, augmentation unbiased, selected, mixing stay, output first".
inline std::string name_of(const TargetChoice& choice) {
  static constexpr const char *schemes[] = {"imm", "gpb1", "gpb2", "static imm", "imm histories"},
                              *fuzzy_schemes[] = {"himm", "himm by one arg max", "viterbi", "static himm",
                                                  "himm histories"},
                              *all_lifts[] = {"zero", "borrowed", "unbiased", "prior"},
                              *covariances[] = {"selected", "own", "own recentred", "released", "envelope"},
                              *all_ties[] = {"stay", "first", "last"};
  const auto word = [](const auto& words, auto value) { return std::string(words[static_cast<int>(value)]); };
  return word(choice.fuzzy ? fuzzy_schemes : schemes, choice.scheme) + ", augmentation " +
         word(all_lifts, choice.augmentation) + ", " + word(covariances, choice.mixed_covariance) + ", mixing " +
         word(all_ties, choice.mixing_tie) + ", output " + word(all_ties, choice.output_tie);
}

inline constexpr auto augmentations = {StateAugmentation::zero, StateAugmentation::borrowed_variance,
                                       StateAugmentation::unbiased};
inline constexpr auto readings = {MixedCovariance::selected, MixedCovariance::own, MixedCovariance::own_recentred,
                                  MixedCovariance::released};
inline constexpr auto every_tie = {Tie::stay, Tie::first, Tie::last};

/// Asks a law of some filters.
template <class Law>
void for_each(const std::vector<TargetChoice>& choices, const Law& law) {
  for (const TargetChoice& choice : choices) {
    SCOPED_TRACE(name_of(choice));
    law(choice);
    if (testing::Test::HasFatalFailure()) return;
  }
}

/// Every filter by the default rules.
inline std::vector<TargetChoice> every_filter() {
  std::vector<TargetChoice> all;
  for (const bool fuzzy : {false, true})
    for (const Scheme scheme : {Scheme::interacting, Scheme::second_order, Scheme::histories})
      all.push_back(chosen(fuzzy, scheme));
  return all;
}
/// Every reading of the paper, of all filters that merge, under every augmentation.
inline std::vector<TargetChoice> every_reading() {
  std::vector<TargetChoice> all;
  for (const StateAugmentation augmentation : augmentations) {
    for (const Scheme scheme : {Scheme::interacting, Scheme::common_start, Scheme::second_order})
      all.push_back(with(chosen(false, scheme), augmentation));
    all.push_back(all.end()[-3]);
    all.back().imm_mixing = MixingWeights::released;
    for (const Scheme scheme : {Scheme::interacting, Scheme::common_start})
      for (const MixedCovariance reading : readings) {
        all.push_back(with(chosen(true, scheme), augmentation));
        all.back().mixed_covariance = reading;
      }
    all.push_back(with(chosen(true, Scheme::second_order), augmentation));
  }
  return all;
}

/// These, and each of the other rules.
inline std::vector<TargetChoice> every_rule() {
  std::vector<TargetChoice> all = every_reading();
  const auto add = [&](bool fuzzy, Scheme scheme, const auto& change) {
    all.push_back(with(chosen(fuzzy, scheme), StateAugmentation::zero));
    all.back().mixed_covariance = MixedCovariance::selected;
    change(all.back());
  };
  for (const Scheme scheme : {Scheme::interacting, Scheme::second_order}) {
    for (const Tie mixing : every_tie)
      for (const Tie output : every_tie)
        add(true, scheme, [&](TargetChoice& choice) {
          choice.mixing_tie = mixing;
          choice.output_tie = output;
        });
    for (const bool fuzzy : {false, true})
      add(fuzzy, scheme, [](TargetChoice& choice) { choice.likelihood = LikelihoodForm::possibility; });
    add(false, scheme, [](TargetChoice& choice) { choice.output_spread = OutputSpread::omitted; });
  }
  for (const StateAugmentation augmentation : augmentations)
    add(true, Scheme::interacting, [&](TargetChoice& choice) {
      choice.augmentation = augmentation;
      choice.mixed_covariance = MixedCovariance::envelope;
    });
  return all;
}

inline AnyModel model_of(const MotionChoice& motion, int axes = 2) { return known_model(motion, axes); }
inline Models models_of(const TargetChoice& choice) {
  Models models;
  for (const MotionChoice& each : choice.motions) models.push_back(model_of(each, choice.axes));
  return models;
}

/// Every start of `chosen` is wrong in its own way.
inline std::vector<State> starts() {
  SquareMatrix<4> small = 50.0 * SquareMatrix<4>::Identity();
  small.topRightCorner<2, 2>().setConstant(5.0);
  small.bottomLeftCorner<2, 2>().setConstant(5.0);
  SquareMatrix<6> large = 80.0 * SquareMatrix<6>::Identity();
  large.topRightCorner<2, 2>().setConstant(3.0);
  large.bottomLeftCorner<2, 2>().setConstant(3.0);
  return {State{Vector<4>{12005, 7990, -95, -103}, small}, State{Vector<4>{11996, 8004, -99, -108}, 2.0 * small},
          State{Vector<6>{12001, 8003, -101, -95, 3, -4}, large}};
}
/// Of these or of other models.
inline std::vector<State> starts(const TargetChoice& choice) {
  const auto all = starts();
  std::vector<State> result;
  for (std::size_t j = 0; j < choice.motions.size(); ++j)
    result.push_back(all[choice.motions[j].known().derivatives == 3 ? 2 : j % 2]);
  return result;
}

template <Uncertainty Kind>
ModeTransition<Kind> transition_of(const TargetChoice& choice) {
  const Variable<Kind> mode{"motion", choice.models};
  if (!choice.sojourn_s.empty()) return TimedTransition{mode, rates_of_sojourns(choice.sojourn_s)};
  return Relation<Kind, Kind>{mode, mode, choice.transition};
}

template <Uncertainty Kind>
Interaction<Kind> interaction_of(const TargetChoice& choice) {
  Interaction<Kind> interaction{
      .augmentation = choice.augmentation, .output_tie = choice.output_tie, .entry = choice.entry};
  if (choice.scheme == Scheme::common_start) interaction.mixed_start = MixedStart::common;
  interaction.likelihood = choice.likelihood;
  if constexpr (std::is_same_v<Kind, Fuzzy>)
    interaction.collapse = {choice.mixed_covariance, choice.mixing_tie};
  else
    interaction.collapse = {choice.imm_mixing, choice.output_spread};
  return interaction;
}

/// What a filter shows.
struct Shown {
  std::vector<std::string> components;
  Estimates estimates;
  std::vector<double> logs;  ///< of the modes' weights
  std::size_t winner = 0;
  State estimate, most_likely_estimate;
  bool measured = false;
  double gate_distance = 0.0, log_evidence = 0.0, log_score = 0.0;  ///< of the last measurement
  double nis = 0.0;                                                 ///< if it was taken
  std::vector<AnyInnovation> innovations = {};
};
template <class Filter>
Shown shown(const Filter& filter) {
  const auto logs = filter.belief().logs();
  const auto sized = [](const auto& estimate) { return State{estimate.mean, estimate.covariance}; };
  Shown result{filter.components(),       filter.estimates(),       {logs.begin(), logs.end()},
               filter.most_likely_mode(), sized(filter.estimate()), sized(filter.most_likely_estimate()),
               filter.accepted(),         filter.gate_distance(),   filter.log_evidence(),
               filter.log_score()};
  if (!result.measured) return result;
  result.nis = filter.nis();
  result.innovations = filter.innovations();
  return result;
}

/// The filter of a choice, and what it shows now.
class AnyFilter : public Shown {
 public:
  template <class Start>
  AnyFilter(const TargetChoice& choice, const Start& start)
      : filter_(choice.fuzzy ? made<Fuzzy>(choice, start) : made<Random>(choice, start)) {
    do_with([](auto&) {});
  }
  explicit AnyFilter(const TargetChoice& choice) : AnyFilter(choice, starts(choice)) {}

  /// Calls act(filter), which may change it.
  template <class Act>
  void do_with(const Act& act) {
    std::visit(
        [&](auto& filter) {
          act(filter);
          static_cast<Shown&>(*this) = shown(filter);
        },
        filter_);
  }
  template <class Sensor>
  void step(double dt, const MeasurementOf<Sensor>& z, const Sensor& sensor, const Gate& gate = {}) {
    do_with([&](auto& filter) { filter.step(dt, z, sensor, gate); });
  }
  void step(double dt) {
    do_with([&](auto& filter) { filter.step(dt); });
  }
  void step(const Scan& scan, const Gate& gate = {}) {
    scan.z ? step(scan.dt, *scan.z, PositionSensor<2>{}, gate) : step(scan.dt);
  }
  template <class Start>
  void restart(const Start& start) {
    do_with([&](auto& filter) { filter.restart(start); });
  }
  /// Goes on from the state of another of its kind.
  void restore(const AnyFilter& other) {
    do_with([&](auto& filter) { filter.restore(std::get<std::decay_t<decltype(filter)>>(other.filter_).state()); });
  }

 private:
  using Filter = std::variant<InteractingMultipleModel<Models, Random>, InteractingMultipleModel<Models, Fuzzy>,
                              SecondOrderMultipleModel<Models, Random>, SecondOrderMultipleModel<Models, Fuzzy>,
                              HistoryFilter<Models, Random>, HistoryFilter<Models, Fuzzy>>;

  template <Uncertainty Kind, class Start>
  static Filter made(const TargetChoice& choice, const Start& start) {
    const auto models = models_of(choice);
    const auto transition = transition_of<Kind>(choice);
    const auto interaction = interaction_of<Kind>(choice);
    if (choice.scheme == Scheme::second_order)
      return SecondOrderMultipleModel<Models, Kind>{models, transition, start, interaction};
    if (choice.scheme == Scheme::histories)
      return HistoryFilter<Models, Kind>{models, transition, start, HistoryRules<Kind>{}, interaction};
    return InteractingMultipleModel<Models, Kind>{models, transition, start, interaction};
  }

  Filter filter_;
};

/// That of one model: its Kalman filter, as fast_path_test.cpp shows.
inline AnyFilter alone(const MotionChoice& motion, const State& start) {
  return {with(chosen(false), {motion}, {{1.0}}), std::vector{start}};
}

/// Asks a law of every filter itself.
template <class Law>
void with_every_filter(const Law& law) {
  for_each(every_filter(), [&](const TargetChoice& choice) { AnyFilter(choice).do_with(law); });
}

template <class Estimate>
restatement::State restate(const Estimate& estimate) {
  return {entries(estimate.mean), dense(estimate.covariance)};
}
inline std::vector<restatement::State> restate(const Estimates& estimates) {
  std::vector<restatement::State> result;
  for (std::size_t j = 0; j < estimates.size(); ++j) result.push_back(restate(estimates[j]));
  return result;
}
inline restatement::Matrix restate(const Rows& rows) {
  restatement::Matrix result(rows.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < rows.size(); ++j) result(i, j) = rows[i][j];
  return result;
}
template <class Real = double>
std::vector<restatement::ModelOf<Real>> restated_models(const TargetChoice& choice) {
  std::vector<restatement::ModelOf<Real>> result;
  for (const MotionChoice& each : choice.motions)
    result.push_back(restatement::discrete_white_noise<Real>(static_cast<std::size_t>(choice.axes),
                                                             static_cast<std::size_t>(each.known().derivatives),
                                                             each[MotionParameter::sigma_w]));
  return result;
}

/// The enumerations are spelled alike and in one order.
inline restatement::Options restate(const TargetChoice& choice) {
  return {.kind = choice.fuzzy ? restatement::Kind::himm : restatement::Kind::imm,
          .order = choice.scheme == Scheme::second_order ? restatement::Order::second_order
                                                         : restatement::Order::interacting,
          .mixing_weights = static_cast<restatement::Weights>(choice.imm_mixing),
          .mixed_covariance = choice.fuzzy ? static_cast<restatement::MixedCovariance>(choice.mixed_covariance)
                                           : restatement::MixedCovariance::selected,
          .augmentation = static_cast<restatement::StateAugmentation>(choice.augmentation),
          .mixing_tie = static_cast<restatement::Tie>(choice.mixing_tie),
          .output_tie = static_cast<restatement::Tie>(choice.output_tie),
          .common_start = choice.scheme == Scheme::common_start,
          .possibilistic = choice.likelihood == LikelihoodForm::possibility,
          .output_spread_omitted = choice.output_spread == OutputSpread::omitted,
          .envelope = enveloped};
}
inline restatement::Filter restated(const TargetChoice& choice, const Estimates& start) {
  return {restated_models(choice), restate(choice.transition), restate(start), restatement::Vector(start.size(), 1.0),
          restate(choice)};
}
template <class Restated>
void step(Restated& filter, const Scan& scan) {
  if (scan.z)
    filter.step(scan.dt, entries(scan.z->mean), dense(scan.z->covariance));
  else
    filter.step(scan.dt);
}

/// A state given in some components, by the names of others.
inline restatement::State reordered(const restatement::State& state, const std::vector<std::string>& from,
                                    const std::vector<std::string>& to) {
  restatement::State result{restatement::Vector(to.size()), restatement::Matrix(to.size(), to.size())};
  for (std::size_t a = 0; a < to.size(); ++a) {
    const auto in_a = restatement::position(from, to[a]).value();
    result.mean[a] = state.mean[in_a];
    for (std::size_t b = 0; b < to.size(); ++b)
      result.covariance(a, b) = state.covariance(in_a, restatement::position(from, to[b]).value());
  }
  return result;
}

/// Whether all that a filter shows is near all that its restatement shows; `tolerance` is relative from one on.
inline testing::AssertionResult agrees(const Shown& filter, const restatement::Filter& restated,
                                       double tolerance = 1e-9) {
  testing::AssertionResult result = testing::AssertionSuccess();
  const auto compare = [&](const char* what, const auto& found, const auto& expected) {
    if (result) result = near(what, "the restatement's", "", found, expected, tolerance);
  };
  compare("the log weights", std::span<const double>(filter.logs), std::span<const double>(restated.log_weights()));
  if (result && filter.winner != restated.winner())
    result = testing::AssertionFailure() << "mode " << filter.winner << " wins, but mode " << restated.winner()
                                         << " in the restatement";
  for (std::size_t j = 0; j < filter.estimates.size(); ++j)
    compare("a model's estimate", filter.estimates[j], restated.states()[j]);
  if (result && filter.measured != restated.nis().has_value())
    result = testing::AssertionFailure() << "whether there was a measurement is in dispute";
  if (filter.measured && result) {
    compare("the NIS", filter.nis, *restated.nis());
    compare("the distance that gates compare", filter.gate_distance, restated.gate_distance());
    compare("the evidence", filter.log_evidence, restated.log_evidence());
    compare("the score", filter.log_score, restated.log_score());
  }
  if (result && filter.components.size() != restated.components().size())
    result = testing::AssertionFailure() << "the output has other components";
  if (result)
    compare("the output", filter.estimate, reordered(restated.estimate(), restated.components(), filter.components));
  return result;
}

/// Whether a filter's state is that of another.
inline testing::AssertionResult same_state(const char*, const char*, const char*, const Shown& a, const Shown& b,
                                           double tolerance) {
  if (a.winner != b.winner)
    return testing::AssertionFailure() << "the modes " << a.winner << " and " << b.winner << " win";
  auto result = near("the log weights", "the other's", "", a.logs, b.logs, tolerance);
  for (std::size_t j = 0; result && j < a.estimates.size(); ++j)
    result = near("an estimate", "the other's", "", a.estimates[j], b.estimates[j], tolerance);
  return result;
}

}  // namespace sigmax::support
