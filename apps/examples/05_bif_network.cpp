// What was that aircraft? A network read from BIF text is asked the same question by probability and by possibility.

#include <iostream>
#include <sstream>

#include <sigmax/core/network/bif.hpp>
#include <sigmax/core/network/explanation.hpp>
#include <sigmax/core/network/measure.hpp>
#include <sigmax/core/network/transform.hpp>

#include "print.hpp"

using namespace sigmax;

constexpr auto text = R"(
network aircraft { }
variable type     { type discrete [ 3 ] { airliner, bomber, fighter }; }
variable flight   { type discrete [ 2 ] { steady, turning }; }
variable emitter  { type discrete [ 2 ] { weather_radar, fire_control }; }
variable warning  { type discrete [ 2 ] { silent, alarm }; }
probability ( type )             { table 0.9, 0.04, 0.06; }
probability ( flight | type )    { (airliner) 0.98, 0.02; (bomber) 0.7, 0.3; (fighter) 0.4, 0.6; }
probability ( emitter | type )   { (airliner) 1.0, 0.0; (bomber) 0.5, 0.5; (fighter) 0.3, 0.7; }
probability ( warning | emitter, flight ) {
  (weather_radar, steady) 0.99, 0.01; (weather_radar, turning) 0.95, 0.05;
  (fire_control, steady)  0.30, 0.70; (fire_control, turning)  0.10, 0.90;
}
)";

template <Uncertainty Kind>
void ask(const RelationNetwork& network) {
  const auto print = [&](const char* title, const Evidence& evidence) {
    examples::print(title, query(network, {"type"}, evidence).template normalized<Kind>());
  };
  print("type", {});
  print("type | turning", {{"flight", "turning"}});
  print("type | turning, alarm", {{"flight", "turning"}, {"warning", "alarm"}});
  const Explanation best = most_likely_explanation(network, {{"warning", "alarm"}});
  std::cout << "  best explanation of an alarm:  " << best["type"] << ", " << best["flight"] << ", " << best["emitter"]
            << '\n';
}

int main() {
  std::istringstream in(text);
  const RelationNetwork random = read_bif(in, "aircraft.bif");
  std::cout << "Random: every way to the evidence adds up\n";
  ask<Random>(random);

  const RelationNetwork fuzzy = as_fuzzy(random, RatioScale{});
  std::cout << "\nFuzzy, each row on the ratio scale: the best way to the evidence counts\n";
  ask<Fuzzy>(fuzzy);
  const Event civil{FuzzyVariable{"type", {"airliner", "bomber", "fighter"}}, {"airliner"}};
  std::cout << "  civil after turning: possible to " << possibility(fuzzy, civil, {{"flight", "turning"}})
            << ", certain to " << necessity(fuzzy, civil, {{"flight", "turning"}}) << '\n';
}
