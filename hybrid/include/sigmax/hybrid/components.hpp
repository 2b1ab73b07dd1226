#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include <sigmax/hybrid/bank.hpp>
#include <sigmax/hybrid/lift.hpp>

namespace sigmax {

/// The components of all models of a bank, by name, and where each model has them.
template <class Models>
class Components {
 public:
  static constexpr int max_size = Bank<Models>::max_components;
  using Estimates = typename Bank<Models>::Estimates;
  using Estimate = Gaussian<Eigen::Dynamic, max_size>;

  /// Throws std::invalid_argument if the models have more different components than their type allows.
  explicit Components(const Models& models) {
    for_each_mode(models, [&](auto j) {
      const std::vector<std::string> own = mode(models, j).components();
      if (own.size() > names_.size()) names_ = own;
    });
    for_each_mode(models, [&](auto j) {
      for (const auto& component : mode(models, j).components())
        if (std::find(names_.begin(), names_.end(), component) == names_.end()) names_.push_back(component);
    });
    if (names_.size() > static_cast<std::size_t>(max_size))
      throw std::invalid_argument("the models have " + std::to_string(names_.size()) +
                                  " different components, but their type allows " + std::to_string(max_size));
    for_each_mode(models, [&](auto j) {
      output_.emplace_back(names_, mode(models, j).components());
      start_.emplace_back(mode(models, j).components(), names_);
      for_each_mode(models,
                    [&](auto l) { mixing_.emplace_back(mode(models, j).components(), mode(models, l).components()); });
    });
  }

  /// Those of the largest model (the first of them on a tie) lead.
  const std::vector<std::string>& names() const { return names_; }

  /// Where the components of model j stand in each model l.
  const Correspondence* of_model(std::size_t j) const { return mixing_.data() + j * output_.size(); }

  /// Where all components stand in each model.
  const Correspondence* of_all() const { return output_.data(); }

  /// Each component, with its covariances, from one of the models that have it: what a lift of the output borrows.
  /// `choose(has)` picks the model, where has(l) says whether model l has the component.
  template <class Choose>
  Estimate carried(const Estimates& estimates, const Choose& choose) const {
    const auto n = static_cast<Eigen::Index>(names_.size());
    Estimate result{Vector<Eigen::Dynamic, max_size>::Zero(n), SquareMatrix<Eigen::Dynamic, max_size>::Zero(n, n)};
    std::array<std::size_t, static_cast<std::size_t>(max_size)> carrier{};
    for (std::size_t i = 0; i < names_.size(); ++i)
      carrier[i] = choose([&](std::size_t l) { return output_[l].in_source[i] >= 0; });
    for_each_mode(estimates, [&](auto l) {
      const auto& estimate = mode(estimates, l);
      for (std::size_t i = 0; i < names_.size(); ++i) {
        if (carrier[i] != l) continue;
        const auto row = static_cast<Eigen::Index>(i);
        result.mean(row) = estimate.mean(output_[l].in_source[i]);
        for (std::size_t k = 0; k < names_.size(); ++k)
          if (carrier[k] == l)
            result.covariance(row, static_cast<Eigen::Index>(k)) =
                estimate.covariance(output_[l].in_source[i], output_[l].in_source[k]);
      }
    });
    return result;
  }

  /// What Lift::prior knows of every component of each model, written into estimates of the models' sizes.
  static void entries(const Models& models, const EntryPrior& prior, double scale, Estimates& entries) {
    for_each_mode(models, [&](auto j) {
      auto& entry = mode(entries, j);
      entry.mean.setZero();
      entry.covariance.setZero();
      const std::vector<std::string> names = mode(models, j).components();
      for (std::size_t i = 0; i < names.size(); ++i)
        entry.covariance.diagonal()(static_cast<Eigen::Index>(i)) = prior.variance(names[i], scale);
    });
  }

  /// What each model takes of one start, given in the order of `names()`, written into estimates of the models' sizes.
  /// Throws std::invalid_argument for another size.
  template <int N, int MaxN>
  void shares(const Gaussian<N, MaxN>& start, Estimates& shares) const {
    if (static_cast<std::size_t>(start.size()) != names_.size())
      throw std::invalid_argument("the start has " + std::to_string(start.size()) +
                                  " components, but the models have " + std::to_string(names_.size()));
    for_each_mode(shares, [&](auto j) {
      auto& own = mode(shares, j);
      const Lifted dropped(own, start, start_[j], Lift::zero);
      own.mean = dropped.mean();
      own.covariance.setZero();
      dropped.add_covariance(1.0, own.covariance);
    });
  }
  template <int N, int MaxN>
  Estimates shares(const Models& models, const Gaussian<N, MaxN>& start) const {
    Estimates result = detail::estimates_for(models);
    for_each_mode(models, [&](auto j) {
      const auto n = mode(models, j).size();
      mode(result, j).mean.setZero(n);
      mode(result, j).covariance.setZero(n, n);
    });
    shares(start, result);
    return result;
  }

 private:
  std::vector<std::string> names_;
  std::vector<Correspondence> mixing_;  ///< of source l in receiver j, at j · modes + l
  std::vector<Correspondence> output_;  ///< of source l in names_
  std::vector<Correspondence> start_;   ///< of names_ in receiver j
};

}  // namespace sigmax
