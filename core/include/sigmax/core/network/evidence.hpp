#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <sigmax/core/likelihood.hpp>
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
  Evidence(std::initializer_list<std::pair<std::string, std::string>> outcomes) {
    for (const auto& [variable, label] : outcomes) observe(variable, label);
  }

  Evidence& observe(std::string variable, std::string label) {
    outcomes_.push_back({std::move(variable), std::move(label)});
    return *this;
  }

  template <NetworkKind Kind>
  Evidence& observe(const Likelihood<Kind>& likelihood) {
    Weights weights{likelihood.variable(), {}};
    for (std::size_t i = 0; i < likelihood.size(); ++i) weights.numbers.push_back(likelihood.number(i));
    likelihoods_.push_back(std::move(weights));
    return *this;
  }

  std::span<const Outcome> outcomes() const { return outcomes_; }
  std::span<const Weights> likelihoods() const { return likelihoods_; }

 private:
  std::vector<Outcome> outcomes_;
  std::vector<Weights> likelihoods_;
};

}  // namespace sigmax
