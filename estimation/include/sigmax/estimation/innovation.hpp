#pragma once

#include <sigmax/estimation/gaussian.hpp>
#include <sigmax/estimation/sensing.hpp>

namespace sigmax {

/// What a measurement told beyond its prediction.
template <int M, int MaxM = M>
struct Innovation {
  Vector<M, MaxM> residual;          ///< ν = z − h(x)
  SquareMatrix<M, MaxM> covariance;  ///< S, (31)
  double squared_distance = 0.0;     ///< d² = νᵀ S⁻¹ ν, the NIS
  double log_likelihood = 0.0;       ///< log N(ν; 0, S)
};

/// The innovation of a sensor's measurement.
template <Sensing Sensor>
using InnovationOf = Innovation<Sensor::measurement_size, detail::max_measurement_size_of<Sensor>>;

}  // namespace sigmax
