#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include <sigmax/core/network.hpp>
#include <sigmax/core/network/query.hpp>

namespace sigmax {

/// One outcome for each of some variables of a network, and what the network says of them all together.
struct Explanation {
  std::vector<NetworkVariable> variables;  ///< as they were asked for, or all as they were declared
  std::vector<std::size_t> outcomes;       ///< the index of the outcome of each
  double log_value;                        ///< logarithm of the product of all tables and the evidence there

  /// The label of a variable's outcome; throws std::invalid_argument if there is no such variable.
  std::string operator[](std::string_view variable) const;
};

/// "age young, mood wild: 0.7", with the digits that the stream shows.
std::ostream& operator<<(std::ostream& out, const Explanation& explanation);

/// The outcomes of all variables together that the tables and the evidence favour most. *Every* variable is eliminated
/// by the maximum, on the tables as they are, whatever its kind: the one exception to "the kind chooses ⊕", since what
/// is asked for is a single outcome of everything. On a tie it is one of the best, the same in every run.
///
/// Throws std::invalid_argument if the evidence is about what the network has not, std::domain_error, naming the
/// evidence, if that excludes every outcome.
Explanation most_likely_explanation(const RelationNetwork& network, const Evidence& evidence = {},
                                    std::size_t table_limit = default_table_limit);

/// The outcomes of some variables together that are favoured most, all others eliminated by their own kinds within
/// them: of random variables the marginal MAP. Throws as the others do, and std::invalid_argument for a variable that
/// the network has not, or that is there twice.
Explanation most_likely_outcomes(const RelationNetwork& network, const std::vector<std::string>& variables,
                                 const Evidence& evidence = {}, std::size_t table_limit = default_table_limit);

}  // namespace sigmax
