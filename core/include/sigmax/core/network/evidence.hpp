#pragma once

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
    std::vector<double> logs;
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
    likelihoods_.push_back({likelihood.variable(), likelihood.all_logs()});
    return *this;
  }

  std::span<const Outcome> outcomes() const { return outcomes_; }
  std::span<const Weights> likelihoods() const { return likelihoods_; }

 private:
  std::vector<Outcome> outcomes_;
  std::vector<Weights> likelihoods_;
};

}  // namespace sigmax
