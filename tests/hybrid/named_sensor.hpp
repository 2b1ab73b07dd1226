#pragma once

#include "support/sigmax.hpp"

namespace sigmax::support {

/// Measures the components of these names, wherever a model has them.
template <int M>
struct NamedSensor {
  static constexpr int measurement_size = M;
  std::array<std::string, std::size_t{M}> names;

  template <StateModel Model>
  RectangularMatrix<M, Model::state_size, M, Model::max_state_size> measurement_matrix(const Model& model) const {
    const auto components = model.components();
    RectangularMatrix<M, Model::state_size, M, Model::max_state_size> H;
    H.setZero(M, model.size());
    for (Eigen::Index i = 0; i < M; ++i) {
      const auto at = std::find(components.begin(), components.end(), names[static_cast<std::size_t>(i)]);
      if (at == components.end()) throw std::invalid_argument("a model lacks a component that is measured");
      H(i, at - components.begin()) = 1.0;
    }
    return H;
  }
};

/// The same in the restatement's terms.
template <std::size_t M>
restatement::Matrix restated_matrix(const std::array<std::string, M>& names,
                                    const std::vector<std::string>& components) {
  restatement::Matrix H(M, components.size());
  for (std::size_t i = 0; i < M; ++i) H(i, restatement::position(components, names[i]).value()) = 1.0;
  return H;
}

}  // namespace sigmax::support
