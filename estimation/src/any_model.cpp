#include <sigmax/estimation/any_model.hpp>

#include <stdexcept>

namespace sigmax {

void AnyModel::require_size() const {
  if (size_ > max_state_size)
    throw std::invalid_argument("model '" + name_ + "' has " + std::to_string(size_) + " states; a bank takes " +
                                std::to_string(max_state_size) + " at most");
}

}  // namespace sigmax
