#pragma once

#include <cstddef>
#include <vector>

#include <sigmax/estimation/kalman.hpp>
#include <sigmax/hybrid/bank.hpp>
#include <sigmax/hybrid/lift.hpp>

namespace sigmax {

/// The models' estimates as the parts of a mixture, each read in the components of a receiver: what `collapse` and
/// `mix` take. A view.
template <class Receiver, class Estimates>
struct LiftedMixture {
  const Receiver& receiver;
  const Estimates& estimates;
  const Correspondence* maps;  ///< of the receiver's components in each model
  Lift lift;

  template <class Visit>
  void visit_all(const Visit& visit) const {
    for_each_mode(estimates,
                  [&](auto l) { visit(std::size_t{l}, Lifted(receiver, mode(estimates, l), maps[l], lift)); });
  }
  template <class Visit>
  void visit(std::size_t wanted, const Visit& visit) const {
    for_each_mode(estimates, [&](auto l) {
      if (l == wanted) visit(Lifted(receiver, mode(estimates, l), maps[l], lift));
    });
  }
};

/// Estimates of one model as the parts of a mixture. A view.
template <class Estimate>
struct EstimateMixture {
  struct Part {
    const Estimate& estimate;
    const auto& mean() const { return estimate.mean; }
    template <class Matrix>
    void add_covariance(double weight, Matrix& covariance) const {
      covariance += weight * estimate.covariance;
    }
  };
  const std::vector<Estimate>& estimates;

  template <class Visit>
  void visit_all(const Visit& visit) const {
    for (std::size_t l = 0; l < estimates.size(); ++l) visit(l, Part{estimates[l]});
  }
  template <class Visit>
  void visit(std::size_t wanted, const Visit& visit) const {
    visit(Part{estimates[wanted]});
  }
};

/// Innovations of any sensor, of six quantities at most: position and velocity in space.
inline constexpr int max_measurement_size = 6;
using AnyInnovation = Innovation<Eigen::Dynamic, max_measurement_size>;

/// A sensor that a multiple-model filter can take: one of all models' states, of not too many quantities.
template <class Sensor, class Models>
concept SensorOfBank =
    Bank<Models>::template seen_by<Sensor>&& detail::max_measurement_size_of<Sensor> <= max_measurement_size;

/// The models' innovations as the parts of a mixture: the predicted measurement, about the one that came.
struct InnovationMixture {
  struct Part {
    const AnyInnovation& innovation;
    const auto& mean() const { return innovation.residual; }
    template <class Matrix>
    void add_covariance(double weight, Matrix& covariance) const {
      covariance += weight * innovation.covariance;
    }
  };
  const std::vector<AnyInnovation>& innovations;

  template <class Visit>
  void visit_all(const Visit& visit) const {
    for (std::size_t l = 0; l < innovations.size(); ++l) visit(l, Part{innovations[l]});
  }
  template <class Visit>
  void visit(std::size_t wanted, const Visit& visit) const {
    visit(Part{innovations[wanted]});
  }
};

}  // namespace sigmax
