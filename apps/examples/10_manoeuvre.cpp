// Airliner, bomber or fighter? The mode weights of an IMM and of an HIMM are the reports of four classifiers.

#include <sigmax/core/transform.hpp>
#include <sigmax/estimation/discrete_white_noise.hpp>
#include <sigmax/estimation/start.hpp>
#include <sigmax/hybrid/interacting_multiple_model.hpp>
#include <sigmax/recognition/classifier.hpp>
#include <sigmax/recognition/decision.hpp>
#include <sigmax/recognition/dominance.hpp>

#include "print.hpp"
#include "shell/random.hpp"

using namespace sigmax;
using Points = std::vector<TimedMeasurement<1>>;

constexpr double step = 2.0, deviation = 50.0;  // s, m
const RandomVariable mode{"mode", {"cv", "+3g", "-3g", "+5g", "-5g"}};
const RandomVariable manoeuvre{"manoeuvre", {"weak", "medium", "strong"}};  // of modes: 0, 1, 1, 2, 2
const RandomVariable target{"target", {"airliner", "bomber", "fighter"}};
const std::vector<double> acceleration{-5.0, -25.0, -45.0};  // of the targets, m/s²

/// Thirty positions; the target accelerates during the steps to samples 15 … 20.
Points fly(double manoeuvring, apps::RandomStream& random) {
  Points points;
  double x = 10000.0, v = -150.0;
  for (int k = 1; k <= 30; ++k) {
    if (k > 1) {
      const double a = k >= 15 && k <= 20 ? manoeuvring : 0.0;
      x += step * v + 0.5 * step * step * a;
      v += step * a;
    }
    points.push_back(
        {step * (k - 1), {Vector<1>(x + deviation * random.normal()), SquareMatrix<1>(deviation * deviation)}});
  }
  return points;
}

/// A filter's weights of the manoeuvres from the tenth sample on: the ⊕ of those of their modes.
template <Uncertainty Kind>
std::vector<std::vector<double>> follow(const Points& points, const Relation<Kind, Kind>& transition) {
  std::vector<IndependentAxes<1, DiscreteWhiteNoise<2>>> models;
  for (const double g : {0.0, 3.0, -3.0, 5.0, -5.0}) models.push_back(dwna<1>(5.0, Vector<1>(9.80665 * g)));
  const std::vector<Gaussian<2>> starts(models.size(), two_point_start(points[0], points[1]));
  InteractingMultipleModel filter{models, transition, starts};
  std::vector<std::vector<double>> reports;
  for (std::size_t k = 2; k < points.size(); ++k) {
    filter.step(step, points[k].measurement);
    const auto& w = filter.belief();
    if (k < 9) continue;
    if constexpr (std::is_same_v<Kind, Fuzzy>)
      reports.push_back({w[0], std::max(w[1], w[2]), std::max(w[3], w[4])});
    else
      reports.push_back({w[0], w[1] + w[2], w[3] + w[4]});
  }
  return reports;
}

template <Uncertainty Kind>
double credit(const Classifier<Kind, Kind>& classifier, const std::vector<std::vector<double>>& reports,
              std::size_t truth) {
  Belief belief{classifier.prior()};
  for (const auto& report : reports)
    classifier.observe(belief, Likelihood{classifier.features().front().feature(), report});
  return sigmax::credit(belief, truth);
}

int main() {
  const Relation<Random, Random> probable{
      target, manoeuvre, {{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0}, {0.0, 0.5, 0.5}, {0.0, 0.0, 1.0}}};
  const Relation<Fuzzy, Fuzzy> possible{
      as_fuzzy(target), as_fuzzy(manoeuvre), {{1.0, 1.0, 1.0}, {0.0, 1.0, 1.0}, {0.0, 0.0, 1.0}}};
  const Classifier<Random, Random> sigma{uninformative(target), invert(probable, uninformative(manoeuvre))};
  const Classifier<Fuzzy, Fuzzy> max{uninformative(as_fuzzy(target)),
                                     invert(possible, uninformative(as_fuzzy(manoeuvre)))};
  std::vector<std::vector<double>> rows(mode.size(), std::vector<double>(mode.size(), 0.025));
  for (std::size_t j = 0; j < rows.size(); ++j) rows[j][j] = 0.9;
  const Relation<Random, Random> transition{mode, mode, rows};
  const auto fuzzy_transition = with_fuzzy_condition(to_possibility(transition, RatioScale{}));

  for (std::size_t truth = 0; truth < target.size(); ++truth) {
    examples::Contest contest;
    for (std::size_t run = 0; run < 1000; ++run) {
      apps::RandomStream random{1, run * target.size() + truth};
      const Points points = fly(acceleration[truth], random);
      const auto imm = follow(points, transition), himm = follow(points, fuzzy_transition);
      contest.add(
          {credit(sigma, imm, truth), credit(max, himm, truth), credit(max, imm, truth), credit(sigma, himm, truth)});
    }
    contest.print("Right about the " + target.label(truth) + " in 1000 runs",
                  {"sigma, of the IMM", "max, of the HIMM", "sigma-max, of the IMM", "max-sigma, of the HIMM"});
  }
  for (const Dominance& one : dominated_patterns(max))
    std::cout << "max never prefers the " << target.label(one.pattern) << ": the " << target.label(one.dominator)
              << " is always as possible\n";
}
