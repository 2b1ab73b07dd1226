// From probability to possibility and back, and what each way keeps: order always, Π(A) ≥ P(A) not always.

#include <iostream>

#include <sigmax/core/measure.hpp>
#include <sigmax/core/transform.hpp>

#include "print.hpp"

using namespace sigmax;
using examples::print;

void print_event(const Distribution<Fuzzy>& possible, double probability) {
  const double possibility = sigmax::possibility(possible, ~Event{possible.variable(), {"dry"}});
  std::cout << "  " << std::left << std::setw(30) << "  possibility of not dry" << possibility
            << (possibility < probability ? ", less than probable" : "") << '\n';
}

int main() {
  const RandomVariable weather{"weather", {"dry", "wet", "snow", "hail"}};
  const Distribution forecast{weather, {0.6, 0.2, 0.15, 0.05}};
  const double not_dry = probability(forecast, ~Event{weather, {"dry"}});
  print("probability", forecast);
  std::cout << "  " << std::left << std::setw(30) << "  probability of not dry" << not_dry << "\n\n";

  const Distribution by_ratio = to_possibility(forecast, RatioScale{});
  print("ratio scale", by_ratio);
  print_event(by_ratio, not_dry);

  const Distribution by_root = to_possibility(forecast, RatioScale{.exponent = 0.5});
  print("ratio scale, exponent 1/2", by_root);
  print_event(by_root, not_dry);

  const Distribution optimal = to_possibility(forecast, DuboisPrade{});
  print("Dubois-Prade, optimal", optimal);
  print_event(optimal, not_dry);

  const Distribution symmetric = to_possibility(forecast, DuboisPradeSandri{});
  print("Dubois-Prade-Sandri", symmetric);
  print_event(symmetric, not_dry);

  std::cout << '\n';
  print("ratio scale, and back", to_probability(by_ratio, RatioScale{}));
  print("symmetric, and back", to_probability(symmetric, DuboisPradeSandri{}));
  print("optimal, pignistically back", to_probability(optimal, DuboisPradeSandri{}));
}
