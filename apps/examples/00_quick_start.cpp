#include <algorithm>
#include <iostream>
#include <tuple>

#include <sigmax/sigmax.hpp>

using namespace sigmax;

template <Uncertainty Kind>  // the mode's kind is the only difference between IMM and HIMM
void track(const Relation<Kind, Kind>& transition) {
  Gaussian<9> start{Vector<9>::Zero(), 100.0 * SquareMatrix<9>::Identity()};  // x, y, z, vx, …, az in SI units
  InteractingMultipleModel filter{std::tuple{dwna<3>(3.0), dwpa<3>(3.0)}, transition, start};
  for (int k = 1; k <= 40; ++k) {  // flies at 50 m/s, then accelerates by 30 m/s² from the 20th scan on
    const double t = 0.2 * k, turning = std::max(0.0, t - 4.0);
    filter.step(0.2, {Vector<3>(50.0 * t + 15.0 * turning * turning, 0.0, 0.0), 25.0 * SquareMatrix<3>::Identity()});
  }
  std::cout << Kind::name << " mode: " << most_likely(filter.belief()) << ", x = " << filter.estimate().mean(0)
            << " m\n";
}

int main() {
  const FuzzyVariable age{"age", {"young", "middle", "old"}}, mood{"mood", {"calm", "wild"}};
  const RandomVariable speed{"speed", {"slow", "fast"}};
  const Relation mood_given_age{mood, age, {{0.3, 1.0}, {1.0, 0.6}, {1.0, 0.2}}};  // a row per age; max = 1
  const Relation speed_given_mood{speed, mood, {{0.9, 0.1}, {0.3, 0.7}}};          // a row per mood; sum = 1
  const Induced speed_given_age = compose(speed_given_mood, mood_given_age);       // mood is fuzzy: by max
  const Distribution who = update(uninformative(age), speed_given_age.likelihood("fast"));
  std::cout << "seen fast: " << most_likely(who) << ", middle is possible to " << who["middle"] << "\n";

  const RandomVariable random_mode{"mode", {"steady", "manoeuvring"}};
  const FuzzyVariable fuzzy_mode{"mode", {"steady", "manoeuvring"}};
  track(Relation{random_mode, random_mode, {{0.95, 0.05}, {0.05, 0.95}}});  // IMM
  track(Relation{fuzzy_mode, fuzzy_mode, {{1.0, 0.5}, {0.5, 1.0}}});        // HIMM
}
