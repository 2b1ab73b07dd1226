// A random sensor of a fuzzy feature of a fuzzy pattern: how fast does someone drive, how does he feel, how old is he?
// (17) fuses the two relations as they are, and (19) updates a possibility by a probability.

#include <iostream>

#include <sigmax/core/compose.hpp>
#include <sigmax/core/update.hpp>

#include "print.hpp"

using namespace sigmax;
using examples::print;
using examples::print_rows;

int main() {
  const FuzzyVariable age{"age", {"young", "middle", "old"}};
  const FuzzyVariable mood{"mood", {"calm", "wild"}};
  const RandomVariable speed{"speed", {"slow", "fast"}};
  const Relation mood_given_age{mood, age, {{0.3, 1.0}, {1.0, 0.6}, {1.0, 0.2}}};
  const Relation speed_given_mood{speed, mood, {{0.9, 0.1}, {0.3, 0.7}}};

  std::cout << "What is known: each row has maximum 1 (fuzzy) or sum 1 (random)\n";
  print_rows(mood_given_age);
  print_rows(speed_given_mood);

  // mood is eliminated, and mood is fuzzy: by max. Random given fuzzy is only induced.
  const Induced speed_given_age = compose(speed_given_mood, mood_given_age);
  std::cout << "\nInduced, (17): rows no longer sum to 1\n";
  print_rows(speed_given_age);
  print("beta, one for each age", age, speed_given_age.betas());

  std::cout << "\nRead as a distribution over speeds: divided by beta\n";
  print_rows(speed_given_age.normalized());

  std::cout << "\nRead as a likelihood of ages: not divided\n";
  print("age, if seen driving fast", update(uninformative(age), speed_given_age.likelihood("fast")));
  print("  with the bias of beta", update(uninformative(age), speed_given_age.normalized().likelihood("fast")));
  print("age, if seen driving slowly", update(uninformative(age), speed_given_age.likelihood("slow")));
}
