#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include <sigmax/hybrid/fit.hpp>

namespace sigmax::apps {

/// Whether this build has an optimiser.
bool can_search();

/// Looks for the least value of a function from the search's start, by NLopt's BOBYQA (Powell 2009), or Sbplx for one
/// number alone; to 2 % of a logarithm, or until the function was asked `most` times. It draws no random numbers.
/// Throws what the function throws; std::logic_error in a build without NLopt.
void search(const std::function<double(const std::vector<double>&)>& function, const FitSearch& from, std::size_t most);

}  // namespace sigmax::apps
