// Where was the watchman, hour by hour? A chain of relations with evidence at every step, and its winning route.

#include <iostream>

#include <sigmax/core/chain.hpp>
#include <sigmax/core/route.hpp>
#include <sigmax/core/transform.hpp>

#include "print.hpp"

using namespace sigmax;

const std::vector<std::string> rooms{"gate", "hall", "vault"};
const std::vector<const char*> heard{"nothing", "footsteps", "footsteps", "a creak", "nothing", "footsteps"};

/// How well each room explains what was heard.
template <Uncertainty Kind>
Likelihood<Kind> report(const Variable<Kind>& room, const std::string& sound) {
  if (sound == "nothing") return {room, {0.8, 0.2, 0.6}};
  return {room, sound == "footsteps" ? std::vector{0.15, 0.7, 0.1} : std::vector{0.05, 0.1, 0.3}};
}

int main() {
  const RandomVariable random_room{"room", rooms};
  const Relation walk{random_room, random_room, {{0.6, 0.4, 0.0}, {0.3, 0.4, 0.3}, {0.0, 0.5, 0.5}}};
  Chain sum{Distribution{random_room, {1.0, 0.0, 0.0}}};
  for (const auto* sound : heard) sum = update(compose(walk, std::move(sum)), report(random_room, sound));
  std::cout << "Random: all routes add up\n";
  examples::print("now in", sum.normalized());
  std::cout << "  log evidence                  " << sum.log_total() << '\n';

  const FuzzyVariable fuzzy_room = as_fuzzy(random_room);
  const Relation fuzzy_walk = with_fuzzy_condition(to_possibility(walk, RatioScale{}));
  Routes best{Distribution{fuzzy_room, {1.0, 0.0, 0.0}}};
  for (const auto* sound : heard) best = update(compose(fuzzy_walk, std::move(best)), report(fuzzy_room, sound));
  std::cout << "\nFuzzy: the best route counts\n";
  examples::print("now in", best.chain().normalized());
  const Route route = best_route(best);
  std::cout << "  route                        ";
  for (const std::size_t outcome : route.outcomes) std::cout << ' ' << rooms[outcome];
  std::cout << "\n  log of its possibility        " << route.log_value << '\n';

  Chain long_chain{uninformative(random_room)};
  for (int hour = 0; hour < 1000000; ++hour)
    long_chain = update(compose(walk, std::move(long_chain)), report(random_room, "nothing"));
  std::cout << "\nAfter a million silent hours: log evidence " << long_chain.log_total() << ", most likely at the "
            << most_likely(long_chain) << '\n';
}
