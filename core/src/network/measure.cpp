#include <sigmax/core/network/measure.hpp>

#include <vector>

namespace sigmax {
namespace {

/// ⊕ over the outcomes in the event, divided by the total; all variables of the answer are of `Kind`.
template <NetworkKind Kind>
double measure(const NetworkAnswer& answer, const JointEvent& event) {
  const auto variables = answer.variables();
  for (const auto& variable : variables) variable.as<Kind>();  // throws if one is of the other kind
  std::vector<std::size_t> outcomes(variables.size(), 0);
  ScaledNumber sum{AlgebraOf<Kind>::zero()};
  for (const ScaledNumber value : answer.values()) {
    if (event(outcomes)) sum = ScaledNumber::plus<AlgebraOf<Kind>>(sum, value);
    for (std::size_t v = variables.size(); v-- > 0;) {
      if (++outcomes[v] < variables[v].size()) break;
      outcomes[v] = 0;
    }
  }
  return sum.over(answer.total());
}

}  // namespace

double probability(const NetworkAnswer& answer, const JointEvent& event) { return measure<Random>(answer, event); }

double possibility(const NetworkAnswer& answer, const JointEvent& event) { return measure<Fuzzy>(answer, event); }

double necessity(const NetworkAnswer& answer, const JointEvent& event) {
  return 1.0 - measure<Fuzzy>(answer, [&event](std::span<const std::size_t> outcomes) { return !event(outcomes); });
}

double probability(const RelationNetwork& network, const Event<Random>& event, const Evidence& evidence) {
  return probability(query(network, {event.variable().name()}, evidence).normalized<Random>(), event);
}

double possibility(const RelationNetwork& network, const Event<Fuzzy>& event, const Evidence& evidence) {
  return possibility(query(network, {event.variable().name()}, evidence).normalized<Fuzzy>(), event);
}

double necessity(const RelationNetwork& network, const Event<Fuzzy>& event, const Evidence& evidence) {
  return necessity(query(network, {event.variable().name()}, evidence).normalized<Fuzzy>(), event);
}

}  // namespace sigmax
