// What class of aircraft? Counted samples become p(f|c) and, by three transforms, π(f|c); the counts are made up.

#include <sigmax/core/transform.hpp>
#include <sigmax/recognition/classifier.hpp>
#include <sigmax/recognition/counts.hpp>
#include <sigmax/recognition/decision.hpp>

#include "print.hpp"
#include "shell/random.hpp"

using namespace sigmax;

const RandomVariable klass{"class", {"rotorcraft", "single engine", "multi engine"}};
const std::vector<RandomVariable> features{{"altitude, ft", {"below 1200", "1200 to 3000", "above"}},
                                           {"airspeed, kt", {"below 90", "90 to 140", "140 to 250", "above"}},
                                           {"climb, ft/min", {"below -250", "level", "above 250"}},
                                           {"turn, deg/s", {"left", "straight", "right"}}};
const std::vector<std::vector<std::vector<double>>> seen{{{55, 37, 8}, {22, 48, 30}, {10, 25, 65}},
                                                         {{28, 61, 11, 0}, {21, 66, 13, 0}, {1, 13, 52, 34}},
                                                         {{24, 55, 21}, {21, 58, 21}, {27, 46, 27}},
                                                         {{12, 76, 12}, {8, 84, 8}, {7, 86, 7}}};

int main() {
  Counts counts{klass, features};
  for (std::size_t f = 0; f < features.size(); ++f)
    for (std::size_t c = 0; c < klass.size(); ++c)
      for (std::size_t value = 0; value < features[f].size(); ++value)
        counts.observe_value(c, f, value, seen[f][c][value]);

  const auto probable = learned_relations(counts, 1.0);  // 1: Laplace's rule
  const Classifier<Random, Random> sigma{uninformative(klass), probable};
  const auto max = [&](const auto& transform) {
    return Classifier<Fuzzy, Fuzzy>{uninformative(as_fuzzy(klass)), learned_relations(counts, 1.0, transform)};
  };
  const auto ratio = max(RatioScale{}), dubois_prade = max(DuboisPrade{}), sandri = max(DuboisPradeSandri{});

  for (const int reports : {1, 10}) {
    examples::Contest contest;
    for (std::size_t run = 0; run < 5000; ++run) {
      apps::RandomStream random{1, run};
      const std::size_t truth = run % klass.size();
      std::vector<std::vector<std::size_t>> rows(static_cast<std::size_t>(reports));
      for (auto& row : rows)
        for (const auto& feature : probable) row.push_back(random.draw(feature.row(truth)));
      const auto right = [&](const auto& classifier) {
        Belief belief{classifier.prior()};
        classifier.observe_all(belief, std::vector<InOrder>(rows.begin(), rows.end()));
        return credit(belief, truth);
      };
      contest.add({right(sigma), right(ratio), right(dubois_prade), right(sandri)});
    }
    contest.print("After " + std::to_string(reports) + (reports == 1 ? " report" : " reports") + ", 5000 runs",
                  {"sigma", "max, ratio scale", "max, Dubois-Prade", "max, Dubois-Prade-Sandri"});
  }
}
