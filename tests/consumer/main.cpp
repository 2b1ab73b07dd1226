#include <iostream>
#include <tuple>

#include <sigmax/sigmax.hpp>

using namespace sigmax;

int main() {
  const FuzzyVariable mode{"mode", {"steady", "manoeuvring"}};
  const Relation transition{mode, mode, {{1.0, 0.5}, {0.5, 1.0}}};
  const Gaussian<9> start{Vector<9>::Zero(), 100.0 * SquareMatrix<9>::Identity()};
  InteractingMultipleModel filter{std::tuple{dwna<3>(3.0), dwpa<3>(3.0)}, transition, start};
  for (int k = 1; k <= 40; ++k)
    filter.step(0.2, {Vector<3>(0.6 * k * k, 0.0, 0.0), 25.0 * SquareMatrix<3>::Identity()});

  RelationNetwork network;  // this and the quantile are compiled code of the library
  network.declare(uninformative(mode));
  std::cout << most_likely(filter.belief()) << " at " << filter.estimate().mean(0) << " m; 95 % of chi-square(3) below "
            << chi_square_quantile(0.95, 3.0) << "; " << network.size() << " variable\n";
}
