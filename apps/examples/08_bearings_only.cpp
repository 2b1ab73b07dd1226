// A drifting boat, seen from a ship by its bearing alone, by sums and by maxima. Arguments: runs, a folder for a page.

#include <sigmax/estimation/grid_filter.hpp>

#include "runs.hpp"
#include "shell/random.hpp"

using namespace sigmax;
using examples::Study;

const double drift = 40.0, bearing_deviation = 4.0 * std::numbers::pi / 180.0;  // m a scan, rad

/// Where the ship is: it goes north for eight scans, then east, 100 m a scan.
Vector<2> ship(int k) { return {-800.0 + 100.0 * std::max(0, k - 8), -1000.0 + 100.0 * std::min(k, 8)}; }
double bearing(const Vector<2>& boat, int k) { return std::atan2(boat(0) - ship(k)(0), boat(1) - ship(k)(1)); }

template <Uncertainty Kind>  // nothing else tells sums from maxima
Study::Estimates follow(const std::vector<double>& measurements) {
  GridFilter<Kind, 2> filter{Grid<2>{{-1000.0, -1000.0}, {1000.0, 1000.0}, {40.0, 40.0}},
                             [](const Vector<2>& x) { return -0.5 * x.squaredNorm() / (400.0 * 400.0); },
                             {.negligible = 1e-6, .cells = 12}};
  Study::Estimates estimates;
  for (int k = 1; const double z : measurements) {
    filter.predict([](const Vector<2>& x) { return x; }, drift * drift * SquareMatrix<2>::Identity());
    filter.update([&](const Vector<2>& x) {
      const double error = std::remainder(z - bearing(x, k), 2.0 * std::numbers::pi);
      return -0.5 * std::pow(error / bearing_deviation, 2.0);
    });
    for (const double x : filter.moments().mean) estimates.mean.push_back(x);
    for (const double x : filter.most_likely()) estimates.most_likely.push_back(x);
    ++k;
  }
  return estimates;
}

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::stoi(argv[1]) : 10, scans = 20;
  Study study(2);
  for (int run = 0; run < runs; ++run) {
    apps::RandomStream noise{1, static_cast<std::uint64_t>(run)};
    std::vector<double> truth, measurements;
    Vector<2> boat{400.0 * noise.normal(), 400.0 * noise.normal()};
    for (int k = 1; k <= scans; ++k) {
      for (double& x : boat) truth.push_back(x += drift * noise.normal());
      measurements.push_back(bearing(boat, k) + bearing_deviation * noise.normal());
    }
    study.add(truth, follow<Random>(measurements), follow<Fuzzy>(measurements));
  }
  std::cout << "RMSE of position over " << runs << " runs of " << scans << " scans in m, with 95 % confidence\n";
  study.print();
  if (argc > 2)
    examples::save(study.chart("Bearings only", "scan", "RMSE, m"), argv[2] + std::string("/bearings_only.html"));
}
