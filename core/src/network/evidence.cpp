#include <sigmax/core/network/evidence.hpp>

#include "kernels/unbounded_row.hpp"

namespace sigmax {

Evidence::Evidence(std::initializer_list<std::pair<std::string, std::string>> outcomes) {
  for (const auto& [variable, label] : outcomes) observe(variable, label);
}

Evidence& Evidence::observe(std::string variable, std::string label) {
  outcomes_.push_back({std::move(variable), std::move(label)});
  return *this;
}

Evidence& Evidence::observe(const NetworkVariable& variable, const kernels::Evidence& likelihood) {
  Weights weights{variable, {}};
  for (std::size_t i = 0; i < variable.size(); ++i) weights.numbers.push_back(number_of(likelihood, i));
  likelihoods_.push_back(std::move(weights));
  return *this;
}

}  // namespace sigmax
