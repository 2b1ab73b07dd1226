#pragma once

#include <cstddef>
#include <iomanip>
#include <iostream>
#include <span>
#include <string_view>

#include <sigmax/core/variable.hpp>

namespace examples {

/// Prints "  title           young 0.67   middle 1.00".
inline void print(std::string_view title, const sigmax::Outcomes& outcomes, std::span<const double> values) {
  std::cout << "  " << std::left << std::setw(30) << title << std::fixed << std::setprecision(3);
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    std::cout << (i == 0 ? "" : "   ") << outcomes.label(i) << ' ' << values[i];
  std::cout << '\n';
}

/// Of a distribution, or what is induced of one.
template <class T>
void print(std::string_view title, const T& distribution) {
  print(title, distribution.variable(), distribution.values());
}

/// Of a relation, or what is induced of one: a line for each outcome of its condition.
template <class T>
void print_rows(const T& relation) {
  for (std::size_t i = 0; i < relation.from().size(); ++i)
    print(relation.to().name() + " | " + relation.from().label(i), relation.to(), relation.row(i));
}

}  // namespace examples
