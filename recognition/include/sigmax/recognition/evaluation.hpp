#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <sigmax/core/mean_interval.hpp>
#include <sigmax/recognition/decision.hpp>

namespace sigmax {

/// How often each pattern, a row, was taken for each, a column.
class ConfusionMatrix {
 public:
  explicit ConfusionMatrix(std::size_t patterns) : counts_(patterns, patterns) {}

  void add(std::size_t truth, std::size_t decision) { counts_(truth, decision) += 1.0; }

  std::size_t size() const { return counts_.rows(); }
  double operator()(std::size_t truth, std::size_t decision) const { return counts_(truth, decision); }

  /// Share of the cases that were recognised. Throws std::domain_error if there was none.
  double accuracy() const;

  /// 2 TP / (2 TP + FP + FN) of one pattern; zero if it never occurred and was never decided for.
  double f1(std::size_t pattern) const;

  /// Mean F1 of the patterns that occurred or were decided for, as scikit-learn's f1_score(average="macro") has it.
  /// Throws std::domain_error if there was none.
  double macro_f1() const;

 private:
  Table counts_;
};

/// How well beliefs fit the truth, case by case: for probabilities log-loss and Brier score, for possibilities the
/// necessity of the truth and coverage, for both what was decided.
///
///     Evaluation<Random> evaluation{animal};
///     for (…) evaluation.add(truth, classifier.log_belief());
///     evaluation.confusion().accuracy();
///     paired_interval(evaluation.correct(), other.correct());
template <Uncertainty Kind>
class Evaluation {
 public:
  /// Possibilities cover the truth if it is in the cut {c : π(c) ≥ cut}. Throws std::invalid_argument if `cut` is not
  /// in (0, 1].
  explicit Evaluation(Variable<Kind> pattern, double cut = 0.5)
      : pattern_(std::move(pattern)), cut_(cut), confusion_(pattern_.size()) {
    if (!(cut > 0.0 && cut <= 1.0)) throw std::invalid_argument("a cut is in (0, 1], not " + std::to_string(cut));
  }

  /// Scores what is believed of one object. Throws std::invalid_argument, naming the variable, if the belief is of
  /// another one or has no such pattern.
  void add(std::size_t truth, const Belief<Kind>& belief) {
    check::same(pattern_, belief.variable(), "Evaluation");
    pattern_.label(truth);  // throws if there is no such pattern
    const std::size_t decision = decide(belief).pattern;
    confusion_.add(truth, decision);
    correct_.push_back(decision == truth ? 1.0 : 0.0);
    double others = 0.0, squares = 0.0, in_cut = 0.0;
    for (std::size_t c = 0; c < belief.size(); ++c) {
      const double value = belief[c];
      if (c != truth) others = std::max(others, value);
      const double error = value - (c == truth ? 1.0 : 0.0);
      squares += error * error;
      in_cut += value >= cut_ ? 1.0 : 0.0;
    }
    log_losses_.push_back(-std::max(belief.log(truth), std::log(least_probability)));
    briers_.push_back(squares);
    necessities_.push_back(1.0 - others);
    covered_.push_back(belief[truth] >= cut_ ? 1.0 : 0.0);
    cut_sizes_.push_back(in_cut);
  }

  std::size_t size() const { return correct_.size(); }
  const ConfusionMatrix& confusion() const { return confusion_; }

  /// The scores of the cases in order, for `mean` and for pairing with those of another classifier: one if it was
  /// recognised, else zero;
  std::span<const double> correct() const { return correct_; }

  /// −log p(truth), where a probability below 1e-15 counts as 1e-15;
  std::span<const double> log_losses() const requires(!SelectiveAlgebra<AlgebraOf<Kind>>) { return log_losses_; }

  /// Σ_c (p(c) − [c = truth])², in [0, 2];
  std::span<const double> briers() const requires(!SelectiveAlgebra<AlgebraOf<Kind>>) { return briers_; }

  /// N({truth}) = 1 − max over the other patterns of π;
  std::span<const double> necessities() const requires(SelectiveAlgebra<AlgebraOf<Kind>>) { return necessities_; }

  /// one if π(truth) ≥ cut, else zero, and how many patterns are that possible: the fewer, the more is said.
  std::span<const double> covered() const requires(SelectiveAlgebra<AlgebraOf<Kind>>) { return covered_; }
  std::span<const double> cut_sizes() const requires(SelectiveAlgebra<AlgebraOf<Kind>>) { return cut_sizes_; }

  /// The smallest probability that `log_losses` distinguishes from zero.
  static constexpr double least_probability = 1e-15;

 private:
  Variable<Kind> pattern_;
  double cut_;
  ConfusionMatrix confusion_;
  std::vector<double> correct_, log_losses_, briers_, necessities_, covered_, cut_sizes_;
};

/// Mean of scores. Throws std::domain_error if there is none.
double mean(std::span<const double> scores);

/// The mean of a − b over the same cases with its interval, see `mean_interval`.
///
/// Of cross-validation it holds for the classifiers as trained in these folds; it does not count that other training
/// data would have made others. Throws std::invalid_argument if the numbers of cases differ or are below two.
Interval paired_interval(std::span<const double> a, std::span<const double> b);

}  // namespace sigmax
