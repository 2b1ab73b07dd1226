#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <sigmax/estimation/kalman.hpp>

namespace sigmax {

/// A model of any type, chosen at run time: a linear motion, or any motion in a member of the Kalman family, also a
/// user's own. What a multiple-model filter has of each of its models, and a program whose user names them.
///
///     const std::vector<AnyModel> models{dwna<3>(3.0), Extended{CoordinatedTurn<3>{1.0, 0.01}}};
///
/// A cheap handle: copies share the model, which does not change.
class AnyModel {
 public:
  static constexpr int state_size = Eigen::Dynamic;
  static constexpr int max_state_size = 32;

  /// Throws std::invalid_argument, naming the model, if it has more than `max_state_size` states.
  template <FilterModel Model>
    requires(!std::is_same_v<Model, AnyModel>)
  AnyModel(const Model& model)
      : AnyModel(std::make_shared<const detail::AskedAs<Model>>(detail::asked(model)), detail::model_ref(model),
                 model.components()) {}

  Eigen::Index size() const { return size_; }
  std::string_view name() const { return name_; }
  const std::vector<std::string>& components() const { return components_; }

  /// Along how many axes its position leads the state, or none.
  int axes() const { return ref_.table->axes; }

  const detail::ModelRef& ref() const { return ref_; }

 private:
  /// Of a copy of the motion that `ref` sees.
  AnyModel(std::shared_ptr<const void> motion, const detail::ModelRef& ref, std::vector<std::string> components);

  std::shared_ptr<const void> motion_;
  detail::ModelRef ref_;
  int size_;
  std::string name_;
  std::vector<std::string> components_;
};

}  // namespace sigmax
