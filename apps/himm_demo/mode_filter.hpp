#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include <sigmax/hybrid/interacting_multiple_model.hpp>
#include <sigmax/hybrid/second_order_multiple_model.hpp>

#include "himm_demo/filter_settings.hpp"

namespace sigmax::apps {

/// The filter that the settings describe, over one bank of models: its scheme and its mode's kind are known when the
/// program runs. `Models` is a KinematicBank or an AnyBank.
template <class Models>
class ModeFilter {
 public:
  using Starts = typename Bank<Models>::Estimates;
  using Estimate = typename Components<Models>::Estimate;
  using Measurement = Gaussian<Bank<Models>::measurement_size>;

  ModeFilter(const FilterSettings& settings, const Models& models, const Starts& starts);

  /// A measurement whose NIS is above the gate counts as missed. Returns whether there was one that passed.
  bool step(double dt, const std::optional<Measurement>& z, double gate);

  /// The names of what `Output::estimate` estimates.
  const std::vector<std::string>& components() const;

  /// The output that the settings ask for, of one time.
  struct Output {
    Estimate estimate;
    std::vector<double> weights;
    std::size_t most_likely_mode;
  };
  Output output() const;

  /// The normalised innovation squared of the last step, if it had a measurement.
  std::optional<double> nis() const;

  /// Records the state as it is, `dt` after the one recorded before, for `smoothed`: an output for each record.
  void record(double dt);
  std::vector<Output> smoothed() const;

 private:
  using Filter = std::variant<InteractingMultipleModel<Models, Random>, InteractingMultipleModel<Models, Fuzzy>,
                              SecondOrderMultipleModel<Models, Random>, SecondOrderMultipleModel<Models, Fuzzy>>;

  template <class Kind>
  using Record = std::vector<RecordedStep<Models, Kind>>;

  static Filter made(const FilterSettings& settings, const Models& models, const Starts& starts);

  /// Of the filter's own state, or a smoothed one.
  template <class AnyFilter>
  Output output_of(const AnyFilter& filter, const typename AnyFilter::State& state) const;

  Filter filter_;
  std::optional<Measurement> z_;  ///< of the last step
  std::tuple<Record<Random>, Record<Fuzzy>> record_;
  bool most_likely_output_;
};

extern template class ModeFilter<KinematicBank<2>>;
extern template class ModeFilter<KinematicBank<3>>;
extern template class ModeFilter<AnyBank<2>>;
extern template class ModeFilter<AnyBank<3>>;

}  // namespace sigmax::apps
