#pragma once

#include <span>

#include <sigmax/estimation/dense.hpp>
#include <sigmax/estimation/filtering.hpp>

/// The arithmetic of a step, without names and messages, compiled for each instruction set that is worth it.
namespace sigmax::detail {

/// Whether there is a result, or why there is none.
enum class Outcome { done, measurement_not_finite, estimate_not_finite, not_positive_definite };

struct Kernels {
  decltype(&multiply) product;
  /// Of a motion along independent axes, (27) and (28).
  void (*predict)(const AxisLaw&, int axes, const ConstView& prior, const View& result);
  /// Of any linear one: P = F P Fᵀ + Q.
  void (*predict_covariance)(const double* F, const double* Q, const double* P, int n, double* result);
  /// Fills in the squared distance and the log-likelihood of an innovation whose residual and covariance S are known,
  /// and gives S⁻¹. The measurement is looked at where the result is not finite.
  Outcome (*score)(const ConstView& z, InnovationView&, double* S_inverse);
  /// Of an innovation whose residual is known. H has m rows and a column for each of the leading components that are
  /// seen; without it, these are measured themselves.
  Outcome (*update)(const double* H, int seen, const ConstView& prior, const ConstView& z, const View& posterior,
                    InnovationView&);
};

const Kernels& baseline_kernels();
const Kernels& avx2_kernels();

/// Those that this processor can run, the best one last.
std::span<const Kernels* const> available_kernels();

/// Those that are used: the best.
const Kernels& kernels();

}  // namespace sigmax::detail
