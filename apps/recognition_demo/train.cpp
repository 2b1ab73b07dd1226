#include "recognition_demo/train.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "support/table.hpp"

namespace sigmax::apps {

std::string described(const DataTable& data) {
  const auto numeric = std::count_if(data.columns.begin(), data.columns.end(), [](const auto& c) { return c.numeric; });
  return fmt::format("{} rows, {} classes, {} features ({} categorical, {} numeric)", data.labels.size(),
                     data.classes.size(), data.columns.size(), static_cast<long>(data.columns.size()) - numeric,
                     numeric);
}

std::string described(const LearningOptions& options) {
  std::string text = options.smoothing == 1.0 ? std::string("counts smoothed by Laplace's rule")
                                              : fmt::format("{} added to every count", options.smoothing);
  text += options.equal_prior ? "; every class equally plausible before" : "; prior by the classes' shares of the rows";
  if (options.misread > 0.0) text += fmt::format("; a reading is wrong with probability {}", options.misread);
  return text;
}

void train_and_report(const TrainOptions& options) {
  const DataTable data = read_data(options.file, options.data);
  std::vector<std::size_t> rows(data.labels.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  const LearnedModel model = learn(data, rows, options.learning);
  const auto all = classifiers(model, options.kinds);
  write_model(model, options.kinds, options.model);

  fmt::print("{}: {}\n{}\n\n", data.file, described(data), described(options.learning));
  TextTable table({{"feature", Align::left}, {"values"}, {"what they are", Align::left}});
  for (const FeatureCode& feature : model.features) {
    const auto labels = feature.labels();
    constexpr std::size_t shown = 6;
    std::string list = fmt::format(
        "{}",
        fmt::join(labels.begin(), labels.begin() + static_cast<std::ptrdiff_t>(std::min(shown, labels.size())), ", "));
    if (labels.size() > shown) list += ", …";
    table.row({feature.name, fmt::format("{}", labels.size()), list});
  }
  table.print();
  for (const auto& warning : warnings(all)) fmt::print("warning: {}\n", warning);
  fmt::print("\nWrote {}\n", options.model);
}

}  // namespace sigmax::apps
