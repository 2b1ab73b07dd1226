#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <sigmax/core/compose.hpp>
#include <sigmax/core/update.hpp>
#include <sigmax/recognition/feature_model.hpp>
#include <sigmax/recognition/report.hpp>

namespace sigmax {

namespace detail {

/// Adds up rows of numbers by halves, as a binary counter carries. The rounding errors grow with the logarithm of the
/// number of rows, not with the number. Infinities are kept.
class PairwiseSum {
 public:
  explicit PairwiseSum(std::size_t size) : part_(size, 0.0) {}

  /// Where the caller adds the next row.
  std::span<double> next() {
    if (rows_ == rows_of_a_part) carry();
    ++rows_;
    return part_;
  }

  /// The sum of all rows so far.
  std::vector<double> total() const {
    std::vector<double> sum = part_;
    for (const auto& level : levels_) add(level, sum);
    return sum;
  }

 private:
  static constexpr std::size_t rows_of_a_part = 16;

  static void add(const std::vector<double>& from, std::vector<double>& to) {
    for (std::size_t i = 0; i < from.size(); ++i) to[i] += from[i];
  }

  /// Level k is empty, or the sum of 2ᵏ parts.
  void carry() {
    std::size_t level = 0;
    for (; level < levels_.size() && !levels_[level].empty(); ++level) {
      add(levels_[level], part_);
      levels_[level].clear();
    }
    if (level == levels_.size()) levels_.emplace_back();
    levels_[level] = std::exchange(part_, std::vector<double>(part_.size(), 0.0));
    rows_ = 0;
  }

  std::vector<double> part_;
  std::size_t rows_ = 0;  // of the part
  std::vector<std::vector<double>> levels_;
};

}  // namespace detail

/// Recognition of patterns from reports on one or several features. The kinds decide the inference: sigma, (41)–(43),
/// if patterns and features are random; max, (44)–(46), if they are fuzzy; sigma-max, (17) and (19), if a random sensor
/// reads a fuzzy feature; max-sigma, (18) and (20), if a fuzzy sensor reads a random feature.
///
///     const Classifier classifier{uninformative(target), emitter_given_target};
///     Belief belief{classifier.prior()};
///     classifier.observe(belief, Likelihood{emitter, {0.7, 0.1, 0.2}});        // a graded report
///     most_likely(belief);
///
///     const Classifier animals{prior, std::vector{legs_given_animal, milk_given_animal}};
///     animals.posterior({Reading{legs, "4"}});                                 // of one report; milk is missing
///
/// A classifier never changes: any number of beliefs, on any thread, may share one.
/// The kind of the pattern is that of the prior, and chooses the ⊕ that normalises; the kind of the features chooses
/// the ⊕ that eliminates them. Features, and reports, are independent given the pattern. The static p(feature|pattern)
/// may be built from p(pattern|feature) by `invert`, or learned from counts.
template <ScalableUncertainty Pattern, ScalableUncertainty Feature>
class Classifier {
 public:
  using pattern_kind = Pattern;
  using feature_kind = Feature;

  /// Throws std::invalid_argument if the condition of a feature is not the prior's variable, or there is no feature.
  Classifier(const Distribution<Pattern>& prior, Relation<Feature, Pattern> feature_given_pattern)
      : Classifier(prior, std::vector<FeatureModel<Pattern, Feature>>{std::move(feature_given_pattern)}) {}
  Classifier(const Distribution<Pattern>& prior, const std::vector<Relation<Feature, Pattern>>& features)
      : Classifier(prior, std::vector<FeatureModel<Pattern, Feature>>(features.begin(), features.end())) {}
  Classifier(const Distribution<Pattern>& prior, std::vector<FeatureModel<Pattern, Feature>> features)
      : prior_(prior), features_(std::move(features)), initial_(prior) {
    if (features_.empty())
      throw std::invalid_argument("a Classifier of '" + prior.variable().name() + "' needs at least one feature");
    for (const auto& feature : features_) check::same(prior.variable(), feature.pattern(), "Classifier");
  }

  /// The same of p(c|f) inverted under a belief in the features, (43) or (46). A pattern that no feature reaches is
  /// impossible: nothing is known of its features, and under maxima it would tie with the winner for ever. Throws
  /// std::domain_error if that leaves none.
  Classifier(const Distribution<Pattern>& prior, const Inverse<Feature, Pattern>& inverse)
      : Classifier(reached(prior, inverse.unreachable), inverse.relation) {}

  /// Takes one report, (42) and (41), or (45) and (44): a list of findings, one finding, or a row of data `InOrder`.
  /// Before it, the logarithms of the belief are multiplied by `forgetting` in (0, 1], so that old reports fade as λⁿ,
  /// for patterns that change; an excluded pattern stays excluded.
  ///
  /// Throws std::invalid_argument if a finding is of no feature, a row has not an index for each feature or one that
  /// does not exist, the belief is of another variable or the factor is out of range. Throws std::domain_error if the
  /// report excludes every pattern that was left; the belief is then unchanged.
  template <class SomeReport>
  void observe(Belief<Pattern>& belief, const SomeReport& report, double forgetting = 1.0) const {
    static_assert(std::is_same_v<SomeReport, InOrder> || std::is_convertible_v<SomeReport, Finding<Feature>> ||
                      std::is_convertible_v<SomeReport, Report<Feature>>,
                  "a report lists findings, and each names its variable; a row of indices is InOrder{row}");
    prove_factor(forgetting);
    update_faded(belief, likelihood(report), forgetting);
  }
  void observe(Belief<Pattern>& belief, std::initializer_list<Finding<Feature>> report, double forgetting = 1.0) const {
    observe(belief, Report<Feature>(report), forgetting);
  }

  /// Takes several reports at once, with a single ⊕ at the end: what observing them one by one gives, to rounding.
  /// Throws as `observe` does, and the belief is then as before the first of them.
  ///
  ///     classifier.observe_all(belief, std::vector{InOrder{rows[0]}, InOrder{rows[1]}});
  template <class Reports>
  void observe_all(Belief<Pattern>& belief, const Reports& reports, double forgetting = 1.0) const {
    Table logs(1, prior_.size());
    double weight = 1.0;  // of what was believed before
    prove_factor(forgetting);
    if (forgetting == 1.0) {
      detail::PairwiseSum sum(prior_.size());
      for (const auto& report : reports) add_log_likelihood(report, sum.next());
      std::ranges::copy(sum.total(), logs.values().begin());
    } else {
      for (const auto& report : reports) {
        for (double& log : logs.values()) log = faded(forgetting, log);
        add_log_likelihood(report, logs.values());
        weight *= forgetting;
      }
    }
    update_faded(belief, {prior_.variable(), std::move(logs), detail::ByLaw{}}, weight);
  }

  /// Takes a graded report with p(f_k|z_{1:k−1}) supplied for this step, as (43) and (46) are printed: p(f_k|c) is
  /// p(c|f_k) inverted under it. The features' own relations are not used.
  ///
  /// If `feature_prediction` is all that is known of the pattern, that is if the belief is p(c|f_k) composed with it,
  /// then the belief cancels: afterwards it is p(c|f_k) composed with the updated prediction, and no evidence
  /// accumulates but through the prediction. A pattern that the prediction does not reach is excluded.
  void observe_predicted(Belief<Pattern>& belief, const Likelihood<Feature>& report,
                         const Relation<Pattern, Feature>& pattern_given_feature,
                         const Distribution<Feature>& feature_prediction) const {
    check::same(prior_.variable(), pattern_given_feature.to(), "Classifier");
    const auto inverse = invert(pattern_given_feature, feature_prediction);
    auto likelihood_of_patterns = compose(report, inverse.relation);
    for (const std::size_t c : inverse.unreachable) likelihood_of_patterns.set_log(c, log_zero);
    update(belief, likelihood_of_patterns, belief);
  }

  /// What is believed after one report alone. Throws as `observe` does.
  template <class SomeReport>
  Belief<Pattern> posterior(const SomeReport& report) const {
    Belief<Pattern> belief = initial_;
    observe(belief, report);
    return belief;
  }
  Belief<Pattern> posterior(std::initializer_list<Finding<Feature>> report) const {
    return posterior(Report<Feature>(report));
  }

  /// How well each pattern explains one report, L(z|c), whatever was believed: (42), (45), (17), (18).
  Likelihood<Pattern> likelihood(InOrder row) const { return likelihood_of(row); }
  Likelihood<Pattern> likelihood(const Report<Feature>& report) const { return likelihood_of(report); }
  Likelihood<Pattern> likelihood(const Finding<Feature>& finding) const {
    return likelihood_of(Report<Feature>{finding});
  }

  /// A row of data as a report. Throws std::invalid_argument as `observe` does.
  Report<Feature> report(InOrder row) const {
    prove_size(row);
    Report<Feature> result;
    for (std::size_t i = 0; i < features_.size(); ++i)
      if (row.indices[i] != missing) result.emplace_back(Reading{features_[i].readings(), row.indices[i]});
    return result;
  }

  /// The place of the feature of each finding. Of features that are the same variable each has its turn. Throws
  /// std::invalid_argument if a finding is of none.
  std::vector<std::size_t> places(const Report<Feature>& report) const {
    std::vector<std::size_t> result;
    for (const auto& finding : report) {
      const auto* const reading = std::get_if<Reading>(&finding);
      const Outcomes& of = reading ? reading->variable : std::get<Likelihood<Feature>>(finding).variable();
      const std::size_t n = features_.size(), first = result.empty() ? 0 : result.back() + 1;
      std::size_t k = 0;
      const auto matches = [&](const auto& at) { return of == (reading ? at.readings() : at.feature()); };
      while (k < n && !matches(features_[(first + k) % n])) ++k;
      if (k == n)
        throw std::invalid_argument("the classifier of '" + prior_.variable().name() + "' has no feature '" +
                                    of.name() + "' with " + std::to_string(of.size()) + " outcomes");
      result.push_back((first + k) % n);
    }
    return result;
  }

  const Distribution<Pattern>& prior() const& { return prior_; }
  Distribution<Pattern> prior() const&& { return prior_; }
  std::span<const FeatureModel<Pattern, Feature>> features() const& { return features_; }
  std::vector<FeatureModel<Pattern, Feature>> features() const&& { return features_; }

 private:
  static Distribution<Pattern> reached(const Distribution<Pattern>& prior, std::span<const std::size_t> unreachable) {
    if (unreachable.empty()) return prior;
    Likelihood<Pattern> reach{prior.variable()};
    for (const std::size_t c : unreachable) reach.set_log(c, log_zero);
    return update(prior, reach);
  }

  static double faded(double factor, double log) { return log == log_zero ? log_zero : factor * log; }

  void prove_size(InOrder row) const {
    if (row.indices.size() != features_.size())
      throw std::invalid_argument("the classifier of '" + prior_.variable().name() + "' has " +
                                  std::to_string(features_.size()) + " features, but the row has " +
                                  std::to_string(row.indices.size()) + " indices");
  }

  /// logs += each of N columns, in one pass: this is what a crisp report costs.
  template <std::size_t N>
  static void add(const std::array<const double*, N>& columns, std::span<double> logs) {
    double* const to = logs.data();
    for (std::size_t c = 0; c < logs.size(); ++c) {
      double sum = to[c];
      for (const double* const column : columns) sum += column[c];
      to[c] = sum;
    }
  }

  void add_log_likelihood(InOrder row, std::span<double> logs) const {
    prove_size(row);
    const auto readings = row.indices;
    std::array<const double*, 4> columns{};
    std::size_t n = 0;
    for (std::size_t i = 0; i < readings.size(); ++i) {
      if (readings[i] == missing) continue;
      columns[n++] = features_[i].log_likelihoods(readings[i]).data();
      if (n < columns.size()) continue;
      add(columns, logs);
      n = 0;
    }
    for (std::size_t k = 0; k < n; ++k) add<1>({columns[k]}, logs);
  }
  void add_log_likelihood(const Report<Feature>& report, std::span<double> logs) const {
    const auto of = places(report);
    for (std::size_t i = 0; i < report.size(); ++i) {
      const auto& feature = features_[of[i]];
      if (const auto* const reading = std::get_if<Reading>(&report[i])) {
        add<1>({feature.log_likelihoods(reading->index).data()}, logs);
      } else {
        const auto graded = compose(std::get<Likelihood<Feature>>(report[i]), feature.relation());
        add<1>({graded.logs().data()}, logs);
      }
    }
  }

  template <class SomeReport>
  Likelihood<Pattern> likelihood_of(const SomeReport& report) const {
    Table logs(1, prior_.size());
    add_log_likelihood(report, logs.values());
    return {prior_.variable(), std::move(logs), detail::ByLaw{}};
  }

  static void prove_factor(double factor) {
    if (!(factor > 0.0 && factor <= 1.0))
      throw std::invalid_argument("a forgetting factor is in (0, 1], not " + std::to_string(factor));
  }

  static void update_faded(Belief<Pattern>& belief, const Likelihood<Pattern>& report, double weight) {
    if (weight == 1.0) return void(update(belief, report, belief));
    Belief<Pattern> left = belief;
    left.assign([&](std::size_t c) { return faded(weight, belief.log(c)); });
    update(left, report, belief);
  }

  Distribution<Pattern> prior_;
  std::vector<FeatureModel<Pattern, Feature>> features_;
  Belief<Pattern> initial_;  // the prior as logarithms
};

}  // namespace sigmax
