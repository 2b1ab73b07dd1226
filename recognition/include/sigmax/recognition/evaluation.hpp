#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
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

  /// Adds all cases of another one of as many patterns.
  void add(const ConfusionMatrix& other);

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

/// How well beliefs fit the truth: for probabilities log-loss and Brier score, for possibilities the necessity of the
/// truth and coverage, for both what was decided. Cases are not kept: the memory is that of the confusion matrix.
///
///     Evaluation<Random> sums{animal};
///     Evaluation<Fuzzy> maxima{as_fuzzy(animal)};
///     RunningMean difference;
///     for (…) difference.add(maxima.add(truth, max.posterior(row)) - sums.add(truth, sigma.posterior(row)));
///     sums.confusion().accuracy();
///     difference.interval();   // paired by case
///
/// Of cross-validation that interval holds for the classifiers as trained in these folds; it does not count that other
/// training data would have made others.
template <Uncertainty Kind>
class Evaluation {
 public:
  /// Possibilities cover the truth if it is in the cut {c : π(c) ≥ cut}. Throws std::invalid_argument if `cut` is not
  /// in (0, 1].
  explicit Evaluation(Variable<Kind> pattern, double cut = 0.5)
      : pattern_(std::move(pattern)), cut_(cut), confusion_(pattern_.size()) {
    if (!(cut > 0.0 && cut <= 1.0)) throw std::invalid_argument("a cut is in (0, 1], not " + std::to_string(cut));
  }

  /// Scores what is believed of one object. Returns one if it was recognised, else zero, to be paired with the answer
  /// of another classifier. Throws std::invalid_argument, naming the variable, if the belief is of another one or has
  /// no such pattern.
  double add(std::size_t truth, const Belief<Kind>& belief) {
    check::same(pattern_, belief.variable(), "Evaluation");
    pattern_.label(truth);  // throws if there is no such pattern
    const Decision decision = decide(belief);
    confusion_.add(truth, decision.pattern);
    if (decision.tied > 1) ++ties_;
    if constexpr (SelectiveAlgebra<AlgebraOf<Kind>>) {
      double in_cut = 0.0;
      for (std::size_t c = 0; c < belief.size(); ++c) in_cut += belief[c] >= cut_ ? 1.0 : 0.0;
      necessity_.add(1.0 - greatest_other(belief, truth));
      covered_.add(belief[truth] >= cut_ ? 1.0 : 0.0);
      cut_size_.add(in_cut);
    } else {
      double squares = 0.0;
      for (std::size_t c = 0; c < belief.size(); ++c) {
        const double error = belief[c] - (c == truth ? 1.0 : 0.0);
        squares += error * error;
      }
      log_loss_.add(-std::max(belief.log(truth), std::log(least_probability)));
      brier_.add(squares);
    }
    ++size_;
    return decision.pattern == truth ? 1.0 : 0.0;
  }

  /// Adds all cases of another evaluation of the same pattern, say of another part of the data. Throws
  /// std::invalid_argument, naming both variables, if it is of another one.
  void add(const Evaluation& other) {
    check::same(pattern_, other.pattern_, "Evaluation");
    confusion_.add(other.confusion_);
    for (const auto mean : {&Evaluation::log_loss_, &Evaluation::brier_, &Evaluation::necessity_, &Evaluation::covered_,
                            &Evaluation::cut_size_})
      (this->*mean).add(other.*mean);
    ties_ += other.ties_;
    size_ += other.size_;
  }

  std::size_t size() const { return size_; }

  /// How many cases ended in a tie for the best, which the first of the best patterns won.
  std::size_t ties() const { return ties_; }

  const ConfusionMatrix& confusion() const& { return confusion_; }
  ConfusionMatrix confusion() && { return std::move(confusion_); }

  /// Mean of −log p(truth), where a probability below 1e-15 counts as 1e-15. This mean and those below throw
  /// std::domain_error if there was no case.
  double log_loss() const requires(!SelectiveAlgebra<AlgebraOf<Kind>>) { return log_loss_.mean(); }

  /// Mean of Σ_c (p(c) − [c = truth])², in [0, 2].
  double brier() const requires(!SelectiveAlgebra<AlgebraOf<Kind>>) { return brier_.mean(); }

  /// Mean of N({truth}) = 1 − the greatest possibility of another pattern.
  double necessity() const requires(SelectiveAlgebra<AlgebraOf<Kind>>) { return necessity_.mean(); }

  /// Share of the cases in which π(truth) ≥ cut.
  double coverage() const requires(SelectiveAlgebra<AlgebraOf<Kind>>) { return covered_.mean(); }

  /// How many patterns are that possible, on average: the fewer, the more is said.
  double cut_size() const requires(SelectiveAlgebra<AlgebraOf<Kind>>) { return cut_size_.mean(); }

  /// The smallest probability that `log_loss` distinguishes from zero.
  static constexpr double least_probability = 1e-15;

 private:
  Variable<Kind> pattern_;
  double cut_;
  ConfusionMatrix confusion_;
  RunningMean log_loss_, brier_, necessity_, covered_, cut_size_;
  std::size_t ties_ = 0;
  std::size_t size_ = 0;
};

}  // namespace sigmax
