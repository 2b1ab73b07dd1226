// A state of which only the square is seen, by sums and by maxima. Arguments: runs, and a folder for pages.

#include <sigmax/estimation/grid_filter.hpp>

#include "runs.hpp"
#include "shell/random.hpp"

using namespace sigmax;
using examples::Study;

const double variance_w = 10.0, variance_v = 1.0;  // of the two noises
double grown(double x, int k) { return 0.5 * x + 25.0 * x / (1.0 + x * x) + 8.0 * std::cos(1.2 * k); }

template <Uncertainty Kind>  // nothing else tells sums from maxima
Study::Estimates follow(const std::vector<double>& measurements, apps::LineChart& last_belief) {
  GridFilter<Kind, 1> filter{Grid<1>{Vector<1>{-20.0}, Vector<1>{20.0}, Vector<1>{0.2}},
                             [](const Vector<1>& x) { return -0.5 * x(0) * x(0) / 5.0; },
                             {.negligible = 1e-9, .cells = 200, .most = 10000}};
  Study::Estimates estimates;
  for (int k = 1; const double z : measurements) {
    filter.predict([k](const Vector<1>& x) { return Vector<1>{grown(x(0), k)}; }, SquareMatrix<1>{variance_w});
    filter.update([z](const Vector<1>& x) { return -0.5 * std::pow(z - x(0) * x(0) / 20.0, 2.0) / variance_v; });
    estimates.mean.push_back(filter.moments().mean(0));
    estimates.most_likely.push_back(filter.most_likely()(0));
    ++k;
  }
  filter.adapt();
  const double greatest = filter.belief()[index_of_greatest(filter.belief().values())];
  auto& curves = last_belief.curves;
  curves.push_back({.name = std::string(Kind::measure), .values = std::vector<double>(last_belief.x.size(), NAN)});
  for (std::size_t i = 0; i < filter.grid().size(); ++i) {
    last_belief.x.push_back(filter.grid().centre(i)(0));
    for (apps::Curve& curve : curves) curve.values.push_back(NAN);
    curves.back().values.back() = filter.belief()[i] / greatest;
  }
  return estimates;
}

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::stoi(argv[1]) : 20, steps = 50;
  Study study(1);
  for (int run = 0; run < runs; ++run) {
    apps::RandomStream noise{1, static_cast<std::uint64_t>(run)};
    std::vector<double> truth, measurements;
    double x = std::sqrt(5.0) * noise.normal();
    for (int k = 1; k <= steps; ++k) {
      truth.push_back(x = grown(x, k) + std::sqrt(variance_w) * noise.normal());
      measurements.push_back(x * x / 20.0 + std::sqrt(variance_v) * noise.normal());
    }
    apps::LineChart belief{.title = "Growth model, belief after 50 steps",
                           .x_label = "x",
                           .y_label = "part of the greatest value",
                           .shaded = {{x, x, "truth"}},
                           .joined = 1.0};
    const auto random = follow<Random>(measurements, belief), fuzzy = follow<Fuzzy>(measurements, belief);
    study.add(truth, random, fuzzy);
    if (run == 8 && argc > 2) examples::save(belief, argv[2] + std::string("/growth_model_belief.html"));
  }
  std::cout << "RMSE over " << runs << " runs of " << steps << " steps, with 95 % confidence\n";
  study.print();
  if (argc > 2)
    examples::save(study.chart("Growth model", "step", "RMSE"), argv[2] + std::string("/growth_model.html"));
}
