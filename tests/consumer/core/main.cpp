#include <iostream>

#include <sigmax/core.hpp>

int main() {
  const sigmax::FuzzyVariable age{"age", {"young", "middle", "old"}}, mood{"mood", {"calm", "wild"}};
  const sigmax::Relation mood_given_age{mood, age, {{0.3, 1.0}, {1.0, 0.6}, {1.0, 0.2}}};
  const sigmax::Distribution who = update(uninformative(age), mood_given_age.likelihood("wild"));
  sigmax::RelationNetwork network;
  network.declare(who);
  std::cout << "wild: most likely " << most_likely(who) << ", " << network.size() << " variable\n";
}
