#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include <sigmax/core/measure.hpp>
#include <sigmax/core/network/query.hpp>

namespace sigmax {

/// An event of the variables of a query together: whether outcomes, given by their indices, belong to it.
using JointEvent = std::function<bool(std::span<const std::size_t>)>;

/// Measures of an event in the distribution reading of an answer, Definition 2.4. The probability is one of random
/// variables, possibility and necessity are of fuzzy ones; std::invalid_argument names a variable of the other kind.
double probability(const NetworkAnswer& answer, const JointEvent& event);
double possibility(const NetworkAnswer& answer, const JointEvent& event);
double necessity(const NetworkAnswer& answer, const JointEvent& event);

/// The same of an event of one variable of the network.
///
///     necessity(network, Event{age, {"middle", "old"}}, Evidence{{"speed", "fast"}})
double probability(const RelationNetwork& network, const Event<Random>& event, const Evidence& evidence = {});
double possibility(const RelationNetwork& network, const Event<Fuzzy>& event, const Evidence& evidence = {});
double necessity(const RelationNetwork& network, const Event<Fuzzy>& event, const Evidence& evidence = {});

}  // namespace sigmax
