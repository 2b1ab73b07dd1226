#include <sigmax/hybrid/components.hpp>

#include <algorithm>
#include <stdexcept>

#include <sigmax/hybrid/mixture.hpp>

namespace sigmax::detail {

Components::Components(const std::vector<AnyModel>& models) {
  for (const AnyModel& model : models)
    if (model.components().size() > names_.size()) names_ = model.components();
  for (const AnyModel& model : models)
    for (const auto& component : model.components())
      if (std::find(names_.begin(), names_.end(), component) == names_.end()) names_.push_back(component);
  for (const AnyModel& receiver : models) {
    output_.emplace_back(names_, receiver.components());
    start_.emplace_back(receiver.components(), names_);
    for (const AnyModel& source : models) mixing_.emplace_back(receiver.components(), source.components());
  }
}

void Components::carry(const Estimates& estimates, const std::size_t* carriers, View result) const {
  const auto n = names_.size();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t l = carriers[k];
    const ConstView estimate = estimates.view(l);
    const auto& in_source = output_[l].in_source;
    result.mean[k] = estimate.mean[in_source[k]];
    for (std::size_t i = 0; i < n; ++i)
      result.covariance[i + k * n] =
          carriers[i] == l ? estimate.covariance[in_source[i] + in_source[k] * estimate.n] : 0.0;
  }
}

Estimates Components::shares(ConstView start) const {
  if (start.n != size())
    throw std::invalid_argument("the start has " + std::to_string(start.n) + " components, but the models have " +
                                std::to_string(size()));
  Estimates shares;
  for (const Correspondence& of_model : start_) {
    shares.add(static_cast<int>(of_model.in_source.size()));
    const View own = shares.view(shares.size() - 1);
    const Mixture::Part part{start, &of_model};
    Mixture{own, {&part, 1}}.read(part, own);
  }
  return shares;
}

Estimates estimates_of(const std::vector<AnyModel>& models) {
  Estimates result;
  for (const AnyModel& model : models) result.add(static_cast<int>(model.size()));
  return result;
}

Estimates anywhere(const std::vector<AnyModel>& models) {
  Estimates result = estimates_of(models);
  for (std::size_t j = 0; j < models.size(); ++j) result[j].covariance.setIdentity();
  return result;
}

Estimates pairs_of(const Estimates& estimates) {
  Estimates pairs;
  for (std::size_t i = 0; i < estimates.size(); ++i)
    for (std::size_t j = 0; j < estimates.size(); ++j) pairs.add(estimates.view(i).n);
  return pairs;
}

void write_entries(const std::vector<AnyModel>& models, const EntryPrior& prior, double scale, Estimates& entries) {
  for (std::size_t j = 0; j < models.size(); ++j) {
    const View entry = entries.view(j);
    std::fill_n(entry.mean, entry.n, 0.0);
    std::fill_n(entry.covariance, entry.n * entry.n, 0.0);
    for (int i = 0; i < entry.n; ++i)
      entry.covariance[i + i * entry.n] = prior.variance(models[j].components()[static_cast<std::size_t>(i)], scale);
  }
}

}  // namespace sigmax::detail
