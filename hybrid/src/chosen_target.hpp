#pragma once

#include <memory>
#include <vector>

#include <sigmax/hybrid/any_target.hpp>

namespace sigmax::detail {

/// What AnyTarget asks of the Target that it hides.
class ChosenTarget {
 public:
  virtual ~ChosenTarget() = default;
  virtual std::unique_ptr<ChosenTarget> clone() const = 0;
  virtual Verdict take(const AnyPlot& plot, const AnyTarget::Stepped& stepped) = 0;
  virtual bool running() const = 0;
  virtual std::size_t starts() const = 0;
  virtual std::size_t rejected() const = 0;
  virtual double time() const = 0;
  virtual double accepted_time() const = 0;
  virtual bool transform(std::span<const double> A, std::span<const double> b) = 0;
  virtual const std::vector<std::string>& components() const = 0;
  virtual void output(TargetPoint& result) const = 0;
  virtual void smoothed(const std::function<void(const TargetPoint&)>& visit,
                        const std::function<void(const ModePairs&)>& paired) const = 0;
  virtual std::vector<ModeStay> explained() const = 0;
};

/// The target of a choice that AnyTarget has checked.
std::unique_ptr<ChosenTarget> chosen_target(const TargetChoice& choice);

}  // namespace sigmax::detail
