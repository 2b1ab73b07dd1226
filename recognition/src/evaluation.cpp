#include <sigmax/recognition/evaluation.hpp>

#include <stdexcept>
#include <string>

namespace sigmax {

void ConfusionMatrix::add(const ConfusionMatrix& other) {
  if (other.size() != size())
    throw std::invalid_argument("a confusion matrix of " + std::to_string(other.size()) +
                                " patterns does not add to one of " + std::to_string(size()));
  for (std::size_t i = 0; i < counts_.values().size(); ++i) counts_.values()[i] += other.counts_.values()[i];
}

double ConfusionMatrix::accuracy() const {
  double right = 0.0, all = 0.0;
  for (std::size_t truth = 0; truth < size(); ++truth) {
    right += counts_(truth, truth);
    for (const double count : counts_.row(truth)) all += count;
  }
  if (all == 0.0) throw std::domain_error("the accuracy of no case is not defined");
  return right / all;
}

double ConfusionMatrix::f1(std::size_t pattern) const {
  double either = 0.0;  // 2 TP + FP + FN
  for (std::size_t other = 0; other < size(); ++other) either += counts_(pattern, other) + counts_(other, pattern);
  return either == 0.0 ? 0.0 : 2.0 * counts_(pattern, pattern) / either;
}

double ConfusionMatrix::macro_f1() const {
  double sum = 0.0, patterns = 0.0;
  for (std::size_t pattern = 0; pattern < size(); ++pattern) {
    bool occurs = false;
    for (std::size_t other = 0; other < size(); ++other)
      occurs = occurs || counts_(pattern, other) > 0.0 || counts_(other, pattern) > 0.0;
    if (!occurs) continue;
    sum += f1(pattern);
    patterns += 1.0;
  }
  if (patterns == 0.0) throw std::domain_error("the F1 of no case is not defined");
  return sum / patterns;
}

}  // namespace sigmax
