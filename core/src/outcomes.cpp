#include <sigmax/core/outcomes.hpp>

#include <charconv>
#include <stdexcept>
#include <unordered_set>

namespace sigmax {

namespace {

std::string listed(const Outcomes& outcomes) {
  constexpr std::size_t shown = 8;
  std::string list;
  for (std::size_t i = 0; i < outcomes.size() && i < shown; ++i) list += (i ? ", " : "") + outcomes.label(i);
  if (outcomes.size() > shown) list += ", … (" + std::to_string(outcomes.size()) + " in all)";
  return list;
}

}  // namespace

Outcomes::Outcomes(std::string name, std::vector<std::string> labels) {
  if (labels.empty()) throw std::invalid_argument("variable '" + name + "' needs at least one outcome");
  std::unordered_set<std::string_view> seen;
  for (const auto& label : labels) {
    if (label.empty()) throw std::invalid_argument("variable '" + name + "' has an outcome with an empty label");
    if (!seen.insert(label).second)
      throw std::invalid_argument("variable '" + name + "' has the outcome '" + label + "' twice");
  }
  const std::size_t size = labels.size();
  table_ = std::make_shared<const Table>(Table{std::move(name), size, std::move(labels)});
}

Outcomes::Outcomes(std::string name, std::initializer_list<std::string_view> labels)
    : Outcomes(std::move(name), std::vector<std::string>(labels.begin(), labels.end())) {}

Outcomes::Outcomes(std::string name, std::size_t size) {
  if (size == 0) throw std::invalid_argument("variable '" + name + "' needs at least one outcome");
  table_ = std::make_shared<const Table>(Table{std::move(name), size, {}});
}

std::string Outcomes::label(std::size_t index) const {
  if (index >= size())
    throw std::invalid_argument("variable '" + name() + "' has " + std::to_string(size()) + " outcomes, no number " +
                                std::to_string(index));
  return table_->labels.empty() ? std::to_string(index) : table_->labels[index];
}

std::size_t Outcomes::index_of(std::string_view label) const {
  if (table_->labels.empty()) {
    std::size_t index = 0;
    const auto error = std::from_chars(label.data(), label.data() + label.size(), index).ec;
    if (error == std::errc{} && index < size() && std::to_string(index) == label) return index;
  } else {
    for (std::size_t i = 0; i < size(); ++i)
      if (table_->labels[i] == label) return i;
  }
  throw std::invalid_argument("variable '" + name() + "' has no outcome '" + std::string(label) +
                              "'; its outcomes are " + listed(*this));
}

bool Outcomes::equals(const Outcomes& other) const {
  return size() == other.size() && name() == other.name() && table_->labels == other.table_->labels;
}

std::string difference(const Outcomes& expected, const Outcomes& found) {
  const auto both = [&](const std::string& of_expected, const std::string& of_found) {
    return "expected variable '" + expected.name() + "'" + of_expected + ", found '" + found.name() + "'" + of_found;
  };
  const auto count = [](const Outcomes& variable) { return " with " + std::to_string(variable.size()) + " outcomes"; };
  if (expected.name() != found.name()) return both("", "");
  if (expected.size() != found.size()) return both(count(expected), count(found));
  const auto sort = [&](const Outcomes& variable) {
    return variable.table_->labels.empty() ? count(variable) + " that are only numbered"
                                           : " with the outcomes " + listed(variable);
  };
  if (expected.table_->labels.empty() || found.table_->labels.empty()) return both(sort(expected), sort(found));
  std::size_t i = 0;
  while (i + 1 < found.size() && expected.table_->labels[i] == found.table_->labels[i]) ++i;
  const auto outcome = [i](const Outcomes& variable) {
    return " whose outcome " + std::to_string(i) + " is '" + variable.label(i) + "'";
  };
  return both(outcome(expected), outcome(found));
}

}  // namespace sigmax
