// A state of which only the square is seen, by sums and by maxima. Arguments: runs, and a folder for plots.

#include <sigmax/estimation/grid_filter.hpp>

#include "runs.hpp"
#include "support/plot.hpp"
#include "support/random.hpp"

using namespace sigmax;

const double variance_w = 10.0, variance_v = 1.0;  // of the two noises
double grown(double x, int k) { return 0.5 * x + 25.0 * x / (1.0 + x * x) + 8.0 * std::cos(1.2 * k); }

struct Estimates {
  std::vector<double> mean, most_likely;
  std::vector<double> cells, parts;  // the last belief, as parts of its greatest value
};

template <Uncertainty Kind>  // nothing else tells sums from maxima
Estimates follow(const std::vector<double>& measurements) {
  GridFilter<Kind, 1> filter{Grid<1>{Vector<1>{-20.0}, Vector<1>{20.0}, Vector<1>{0.2}},
                             [](const Vector<1>& x) { return -0.5 * x(0) * x(0) / 5.0; },
                             {.negligible = 1e-9, .cells = 40, .most = 10000}};
  Estimates estimates;
  for (int k = 1; const double z : measurements) {
    filter.predict([k](const Vector<1>& x) { return Vector<1>{grown(x(0), k)}; }, SquareMatrix<1>{variance_w});
    filter.update([z](const Vector<1>& x) { return -0.5 * std::pow(z - x(0) * x(0) / 20.0, 2.0) / variance_v; });
    estimates.mean.push_back(filter.moments().mean(0));
    estimates.most_likely.push_back(filter.most_likely()(0)), ++k;
  }
  filter.adapt();
  for (std::size_t i = 0; i < filter.grid().size(); ++i) {
    estimates.cells.push_back(filter.grid().centre(i)(0));
    estimates.parts.push_back(filter.belief()[i] / filter.belief()[index_of_greatest(filter.belief().values())]);
  }
  return estimates;
}

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::stoi(argv[1]) : 50, steps = 50;
  examples::Study study;
  for (int run = 0; run < runs; ++run) {
    apps::RandomStream noise{1, static_cast<std::uint64_t>(run)};
    std::vector<double> truth, measurements;
    double x = std::sqrt(5.0) * noise.normal();
    for (int k = 1; k <= steps; ++k) {
      truth.push_back(x = grown(x, k) + std::sqrt(variance_w) * noise.normal());
      measurements.push_back(x * x / 20.0 + std::sqrt(variance_v) * noise.normal());
    }
    const Estimates random = follow<Random>(measurements), fuzzy = follow<Fuzzy>(measurements);
    study.add(truth, {random.mean, random.most_likely, fuzzy.mean, fuzzy.most_likely});
    if (run != 0 || argc <= 2) continue;
    apps::Plot belief{"Growth model, belief after 50 steps", "x", "part of the greatest value"};
    belief.points("truth", {truth.back()}, {0.0});
    belief.line("probability", random.cells, random.parts);
    belief.line("possibility", fuzzy.cells, fuzzy.parts);
    belief.save(std::string(argv[2]) + "/growth_model.svg");
  }
  std::cout << "RMSE over " << runs << " runs of " << steps << " steps, with 95 % confidence\n";
  study.print();
}
