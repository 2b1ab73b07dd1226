// Which type of aircraft is it? The same quantities as [min, opt, max] and as densities; the numbers are made up.

#include <sigmax/core/transform.hpp>
#include <sigmax/recognition/classifier.hpp>
#include <sigmax/recognition/decision.hpp>
#include <sigmax/recognition/triangle.hpp>

#include "print.hpp"
#include "shell/random.hpp"

using namespace sigmax;

const RandomVariable type{"type", {"light", "regional", "narrow body", "wide body"}};
const std::vector<std::string> quantities{"takeoff speed, m/s", "climb rate, m/s",   "cruise speed, m/s",
                                          "ceiling, km",        "descent rate, m/s", "landing speed, m/s"};
const std::vector<std::vector<Triangle>> triangles{// by quantity, then by type
                                                   {{45, 60, 75}, {55, 62, 82}, {62, 80, 90}, {65, 85, 95}},
                                                   {{3, 9, 14}, {5, 8, 16}, {6, 12, 15}, {5, 13, 16}},
                                                   {{120, 180, 210}, {170, 190, 240}, {190, 225, 245}, {200, 240, 255}},
                                                   {{6, 10, 13}, {8, 10, 13}, {9, 11, 13}, {9, 12, 13.5}},
                                                   {{-14, -7, -4}, {-15, -9, -5}, {-16, -11, -5}, {-16, -9, -5}},
                                                   {{42, 52, 68}, {50, 58, 74}, {56, 68, 78}, {58, 72, 80}}};

/// The normal density of which [min, max] holds 90 %: its peak is not that of a triangle that leans.
double mean(const Triangle& t) { return (t.minimum() + t.maximum()) / 2.0; }
double deviation(const Triangle& t) { return (t.maximum() - t.minimum()) / 3.29; }
double below(const Triangle& t, double x) { return 0.5 * std::erfc((mean(t) - x) / (deviation(t) * std::sqrt(2.0))); }

double draw_by_density(const Triangle& t, apps::RandomStream& random) {
  return mean(t) + deviation(t) * random.normal();
}

/// From the density in proportion to the triangle.
double draw_by_triangle(const Triangle& t, apps::RandomStream& random) {
  const double a = t.minimum(), c = t.optimum(), b = t.maximum(), u = random.uniform();
  return u < (c - a) / (b - a) ? a + std::sqrt(u * (b - a) * (c - a)) : b - std::sqrt((1.0 - u) * (b - a) * (b - c));
}

/// Forty bins that hold all but a thousandth of every density at either end.
Discretization bins_of(const std::vector<Triangle>& of_types) {
  std::vector<double> ends;
  for (const Triangle& t : of_types)
    for (const double side : {-3.1, 3.1}) ends.push_back(mean(t) + side * deviation(t));
  return equal_width(ends, 40);
}

int main() {
  std::vector<Discretization> bins;
  std::vector<Relation<Random, Random>> probable, in_proportion;
  std::vector<Relation<Fuzzy, Fuzzy>> possible, by_ratio, by_dubois_prade;
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    bins.push_back(bins_of(triangles[q]));
    const auto quantity = bins[q].variable<Random>(quantities[q]);
    std::vector<std::vector<double>> p, pi;
    for (const Triangle& t : triangles[q]) {
      auto& row = p.emplace_back();
      for (std::size_t b = 0; b < bins[q].size(); ++b)
        row.push_back(below(t, bins[q].upper(b)) - below(t, bins[q].lower(b)));
      const auto values = triangular(as_fuzzy(quantity), bins[q], t, 0.01);  // 0.01 is possible outside [min, max]
      pi.emplace_back(values.values().begin(), values.values().end());
    }
    probable.emplace_back(quantity, type, p);
    possible.emplace_back(as_fuzzy(quantity), as_fuzzy(type), pi);
    in_proportion.push_back(with_random_condition(to_probability(possible[q], RatioScale{})));
    by_ratio.push_back(with_fuzzy_condition(to_possibility(probable[q], RatioScale{})));
    by_dubois_prade.push_back(with_fuzzy_condition(to_possibility(probable[q], DuboisPrade{})));
  }
  const auto prior = uninformative(type);
  const auto fuzzy_prior = uninformative(as_fuzzy(type));
  const Classifier<Random, Random> density{prior, probable}, proportion{prior, in_proportion};
  const Classifier<Fuzzy, Fuzzy> triangle{fuzzy_prior, possible}, ratio{fuzzy_prior, by_ratio},
      dubois_prade{fuzzy_prior, by_dubois_prade};

  for (const bool by_density : {true, false}) {
    examples::Contest contest;
    for (std::size_t run = 0; run < 4000; ++run) {
      apps::RandomStream random{1, run};
      const std::size_t truth = run % type.size();
      std::vector<std::size_t> report;
      for (std::size_t q = 0; q < bins.size(); ++q)
        report.push_back(bins[q].bin((by_density ? draw_by_density : draw_by_triangle)(triangles[q][truth], random)));
      const auto right = [&](const auto& classifier) { return credit(classifier.posterior(InOrder{report}), truth); };
      contest.add({right(density), right(triangle), right(proportion), right(ratio), right(dubois_prade)});
    }
    contest.print(
        by_density ? "Drawn from the densities, 4000 runs" : "Drawn in proportion to the triangles, 4000 runs",
        {"sigma, density", "max, triangle", "sigma, in proportion to the triangle", "max, density by the ratio scale",
         "max, density by Dubois-Prade"});
  }
}
