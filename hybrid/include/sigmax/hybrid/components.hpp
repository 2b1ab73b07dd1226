#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <sigmax/estimation/any_model.hpp>
#include <sigmax/hybrid/estimates.hpp>
#include <sigmax/hybrid/state_augmentation.hpp>

namespace sigmax::detail {

/// The components of all models of a bank, by name, and where each model has them.
class Components {
 public:
  explicit Components(const std::vector<AnyModel>& models);

  /// Components of the largest model lead; of equally large models the first.
  const std::vector<std::string>& names() const { return names_; }
  int size() const { return static_cast<int>(names_.size()); }

  /// Where the components of model j stand in each model l.
  const Correspondence* of_model(std::size_t j) const { return mixing_.data() + j * output_.size(); }

  /// Where all components stand in each model.
  const Correspondence* of_all() const { return output_.data(); }

  /// Each component, with its covariances, from one of the models that have it: what an augmentation of the output
  /// borrows. `carriers[i]` is the model that lends component i.
  void carry(const Estimates& estimates, const std::size_t* carriers, View result) const;

  /// What each model takes of one start, given in the order of `names()`. Throws std::invalid_argument for another
  /// size.
  Estimates shares(ConstView start) const;

 private:
  std::vector<std::string> names_;
  std::vector<Correspondence> mixing_;  ///< of source l in receiver j, at j · modes + l
  std::vector<Correspondence> output_;  ///< of source l in names_
  std::vector<Correspondence> start_;   ///< of names_ in receiver j
};

/// Estimates of the models' sizes, all zero.
Estimates estimates_of(const std::vector<AnyModel>& models);

/// Estimates without meaning, which a filter may hold before it starts.
Estimates anywhere(const std::vector<AnyModel>& models);

/// Zeros of the size of each estimate i, as many as there are estimates, at i · modes + j.
Estimates pairs_of(const Estimates& estimates);

/// What StateAugmentation::prior knows of every component of each model, with this scale.
void write_entries(const std::vector<AnyModel>& models, const EntryPrior& prior, double scale, Estimates& entries);

}  // namespace sigmax::detail
