#include <iostream>
#include <tuple>
#include <vector>

#include <sigmax/sigmax.hpp>

using namespace sigmax;

int main() {
  const FuzzyVariable mode{"mode", {"steady", "manoeuvring"}};
  const Relation transition{mode, mode, {{1.0, 0.5}, {0.5, 1.0}}};
  const Gaussian<9> start{Vector<9>::Zero(), 100.0 * SquareMatrix<9>::Identity()};
  InteractingMultipleModel filter{std::tuple{dwna<3>(3.0), dwpa<3>(3.0)}, transition, start};
  InteractingMultipleModel at_run_time{std::vector<AnyModel>{dwna<3>(3.0), dwpa<3>(3.0)}, transition, start};
  const AnySensor sensor = LinearSensor<3, 3>(SquareMatrix<3>::Identity());
  for (int k = 1; k <= 40; ++k) {
    const Gaussian<3> z{Vector<3>(0.6 * k * k, 0.0, 0.0), 25.0 * SquareMatrix<3>::Identity()};
    filter.step(0.2, z);
    at_run_time.step(0.2, {z.mean, z.covariance}, sensor);
  }
  if (!at_run_time.estimate().mean.isApprox(filter.estimate().mean, 1e-9)) return 1;

  RelationNetwork network;  // this and the quantile are compiled code of the library
  network.declare(uninformative(mode));
  std::cout << most_likely(filter.belief()) << " at " << filter.estimate().mean(0) << " m; 95 % of chi-square(3) below "
            << chi_square_quantile(0.95, 3.0) << "; " << network.size() << " variable\n";
}
