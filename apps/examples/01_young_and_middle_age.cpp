// Is a man of 42 young or middle-aged? Concepts overlap, so the age group is a fuzzy variable: (1), (8).

#include <iostream>
#include <set>
#include <string>
#include <vector>

#include <sigmax/core/measure.hpp>
#include <sigmax/core/update.hpp>

#include "print.hpp"

using namespace sigmax;
using examples::print;

void print_measures(const std::string& title, const Distribution<Fuzzy>& belief, const Event<Fuzzy>& event) {
  std::cout << "  " << std::left << std::setw(30) << title << "possible " << possibility(belief, event)
            << "   necessary " << necessity(belief, event) << '\n';
}

int main() {
  const FuzzyVariable group{"age group", {"young", "middle-aged", "old"}};

  // Intensions: what the man shows, and what each concept means.
  using Features = std::set<std::string>;
  const Features man{"dark hair", "runs daily", "reading glasses", "two children"};
  const Features young{"dark hair", "runs daily", "student", "single"};
  const Features middle_aged{"dark hair", "reading glasses", "two children", "mortgage"};
  const Features old{"grey hair", "reading glasses", "retired"};

  std::cout << "What the man's features say\n";
  const std::vector degrees{compatibility(man, young), compatibility(man, middle_aged), compatibility(man, old)};
  print("compatibility, raw", group, degrees);
  const Distribution looks = normalized(group, degrees);
  print("possibility", looks);
  print_measures("is middle-aged", looks, Event{group, {"middle-aged"}});
  print_measures("is young", looks, Event{group, {"young"}});
  print_measures("is not old", looks, ~Event{group, {"old"}});

  const FuzzyVariable evening{"evening", {"stays in", "goes out"}};
  const Relation evening_given_group{evening, group, {{0.4, 1.0}, {1.0, 0.5}, {1.0, 0.1}}};

  std::cout << "\nHe goes out tonight\n";
  const Distribution posterior = update(looks, evening_given_group.likelihood("goes out"));
  print("possibility", posterior);
  print_measures("is young", posterior, Event{group, {"young"}});
  std::cout << "  most likely he is " << most_likely(posterior) << '\n';
}
