#include <sigmax/hybrid/any_target.hpp>

#include <stdexcept>
#include <string>
#include <utility>

#include "chosen_target.hpp"

namespace sigmax {
namespace {

std::unique_ptr<detail::ChosenTarget> chosen(const TargetChoice& choice) {
  if (choice.axes < 1 || choice.axes > 3)
    throw std::invalid_argument("a target along " + std::to_string(choice.axes) + " axes; expected 1, 2 or 3");
  if (choice.motions.empty() || choice.motions.size() != choice.models.size())
    throw std::invalid_argument("a target with " + std::to_string(choice.motions.size()) + " motions and " +
                                std::to_string(choice.models.size()) + " names of them");
  if (choice.start == StartRule::given &&
      (choice.start_mean.size() != 9 || choice.start_covariance_diagonal.size() != 9))
    throw std::invalid_argument("a given start has nine numbers and nine variances: x, y, z, vx, vy, vz, ax, ay, az");
  return detail::chosen_target(choice);
}

}  // namespace

AnyTarget::AnyTarget(const TargetChoice& choice) : target_(chosen(choice)) {}
AnyTarget::AnyTarget(const AnyTarget& other) : target_(other.target_->clone()) {}
AnyTarget::AnyTarget(AnyTarget&&) noexcept = default;
AnyTarget& AnyTarget::operator=(AnyTarget other) noexcept {
  target_ = std::move(other.target_);
  return *this;
}
AnyTarget::~AnyTarget() = default;

Verdict AnyTarget::take(const AnyPlot& plot, const Stepped& stepped) { return target_->take(plot, stepped); }
bool AnyTarget::running() const { return target_->running(); }
std::size_t AnyTarget::starts() const { return target_->starts(); }
std::size_t AnyTarget::rejected() const { return target_->rejected(); }
double AnyTarget::time() const { return target_->time(); }
double AnyTarget::accepted_time() const { return target_->accepted_time(); }
bool AnyTarget::transform(std::span<const double> A, std::span<const double> b) { return target_->transform(A, b); }
const std::vector<std::string>& AnyTarget::components() const { return target_->components(); }
TargetPoint AnyTarget::output() const {
  TargetPoint result;
  output(result);
  return result;
}
void AnyTarget::output(TargetPoint& result) const { target_->output(result); }
std::vector<ModeStay> AnyTarget::explained() const { return target_->explained(); }
void AnyTarget::smoothed(const std::function<void(const TargetPoint&)>& visit,
                         const std::function<void(const ModePairs&)>& paired) const {
  target_->smoothed(visit, paired);
}

void AnyTarget::follow(std::span<const AnyPlot> plots, const std::function<void(const TargetPoint&)>& visit) {
  TargetPoint point;
  const auto stepped = [&](std::size_t tag, bool is_start) {
    output(point);
    point.tag = tag;
    point.is_start = is_start;
    visit(point);
  };
  for (const AnyPlot& plot : plots) take(plot, stepped);
}

}  // namespace sigmax
