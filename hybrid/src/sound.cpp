#include <sigmax/hybrid/sound.hpp>

#include <cmath>
#include <stdexcept>
#include <string>

namespace sigmax::check {

void starts(const std::vector<AnyModel>& models, const Estimates& starts) {
  if (starts.size() != models.size())
    throw std::invalid_argument("there are " + std::to_string(models.size()) + " models, but " +
                                std::to_string(starts.size()) + " starts");
  for (std::size_t j = 0; j < models.size(); ++j) {
    const detail::ConstView start = starts.view(j);
    const auto refuse = [&](const std::string& what) {
      throw std::invalid_argument("the start of model '" + std::string(models[j].name()) + "' " + what);
    };
    if (start.n != models[j].size())
      refuse("has " + std::to_string(start.n) + " components; expected " + std::to_string(models[j].size()));
    if (!finite(start)) refuse("is not finite");
  }
}

void prior(const EntryPrior& prior) {
  if (prior.scales.empty()) throw std::invalid_argument("an entry prior has no scale; expected one or more");
  const auto positive = [](const char* what, double number) {
    if (!(number > 0.0 && std::isfinite(number)))
      throw std::invalid_argument("an entry prior has the " + std::string(what) + " " + std::to_string(number) +
                                  "; expected a positive one");
  };
  for (const double scale : prior.scales) positive("scale", scale);
  positive("vertical share", prior.vertical);
  positive("turn rate", prior.turn_rate);
}

void sound(const AnyModel& model, detail::ConstView estimate) {
  const EstimateAt<const double> at(estimate);
  const double sum = at.covariance.diagonal().cwiseAbs().sum();
  if (!std::isfinite(sum) || !at.mean.allFinite())
    throw std::domain_error("the estimate of model '" + std::string(model.name()) + "' is not finite");
  if (at.covariance.diagonal().minCoeff() < -1e-12 * sum)
    throw std::domain_error("the covariance of model '" + std::string(model.name()) +
                            "' is not positive semi-definite");
}

bool finite(detail::ConstView estimate, double greatest) {
  const EstimateAt<const double> at(estimate);
  return (at.mean.array().abs() <= greatest).all() && (at.covariance.array().abs() <= greatest).all();
}

}  // namespace sigmax::check
