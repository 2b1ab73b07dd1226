#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include <sigmax/core/likelihood.hpp>
#include <sigmax/core/measure.hpp>
#include <sigmax/core/network/variable.hpp>

namespace sigmax {

/// What is known about the variables of a network: outcomes that were seen, and likelihoods.
///
///     query(network, {"age"}, Evidence{{"speed", "fast"}}.observe(Likelihood{mood, {0.2, 1.0}}))
///
/// Pieces of evidence about one variable multiply. Names and labels are looked up by the verb that takes the evidence.
class Evidence {
 public:
  struct Outcome {
    std::string variable;
    std::string label;
  };
  struct Weights {
    NetworkVariable variable;
    std::vector<ScaledNumber> numbers;  ///< one for every outcome
  };

  Evidence() = default;
  Evidence(std::initializer_list<std::pair<std::string, std::string>> outcomes);

  Evidence& observe(std::string variable, std::string label);

  template <NetworkKind Kind>
  Evidence& observe(const Likelihood<Kind>& likelihood) {
    return observe(likelihood.variable(), likelihood.evidence());
  }

  /// What was seen is only known to be one of the outcomes of an event.
  template <NetworkKind Kind>
  Evidence& observe(const Event<Kind>& event) {
    std::vector<double> members(event.variable().size());
    for (std::size_t i = 0; i < members.size(); ++i) members[i] = event.contains(i) ? 1.0 : 0.0;
    return observe(Likelihood<Kind>{event.variable(), members});
  }

  const std::vector<Outcome>& outcomes() const& { return outcomes_; }
  std::vector<Outcome> outcomes() const&& { return outcomes_; }
  const std::vector<Weights>& likelihoods() const& { return likelihoods_; }
  std::vector<Weights> likelihoods() const&& { return likelihoods_; }

 private:
  Evidence& observe(const NetworkVariable& variable, const kernels::Evidence& likelihood);

  std::vector<Outcome> outcomes_;
  std::vector<Weights> likelihoods_;
};

}  // namespace sigmax
