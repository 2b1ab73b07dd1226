// One good route against two mediocre ones: sigma adds the routes up, max takes the best. The kind of the variable in
// the middle chooses, (6) or (7); the code is the same.

#include <iostream>

#include <sigmax/core/compose.hpp>
#include <sigmax/core/transform.hpp>

#include "print.hpp"

using namespace sigmax;

template <Uncertainty Kind>
void print_arrival(const Relation<Kind, Kind>& gate_given_way, const Distribution<Kind>& way) {
  const Distribution gate = compose(gate_given_way, way);
  examples::print(std::string(Kind::measure) + " of the way", way);
  examples::print_rows(gate_given_way);
  examples::print(std::string(Kind::measure) + " of the gate", gate);
  std::cout << "  expect the courier at the " << most_likely(gate) << " gate\n";
}

int main() {
  const RandomVariable way{"way", {"bridge", "tunnel", "ferry"}};
  const RandomVariable gate{"gate", {"north", "south"}};
  const Distribution usual{way, {0.4, 0.3, 0.3}};
  const Relation gate_given_way{gate, way, {{0.9, 0.1}, {0.2, 0.8}, {0.2, 0.8}}};

  std::cout << "Random: alternatives add up\n";
  print_arrival(gate_given_way, usual);

  std::cout << "\nFuzzy: the best alternative counts\n";
  print_arrival(with_fuzzy_condition(to_possibility(gate_given_way, RatioScale{})),
                to_possibility(usual, RatioScale{}));
}
