#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sigmax/estimation/nonlinear_model.hpp>

namespace sigmax {

/// What a non-linear filter shows of its model, so that it can stand where a model stands: in a multiple-model filter.
template <NonlinearModel Model>
class Member {
 public:
  using ModelType = Model;
  static constexpr int state_size = Model::state_size;
  static constexpr int max_state_size = Model::max_state_size;
  static constexpr int measurement_size = Model::measurement_size;

  explicit Member(Model model) : model_(std::move(model)) {}

  Eigen::Index size() const { return model_.size(); }
  std::string_view name() const { return model_.name(); }
  std::vector<std::string> components() const { return model_.components(); }
  const Model& model() const { return model_; }

 private:
  Model model_;
};

}  // namespace sigmax
