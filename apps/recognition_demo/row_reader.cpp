#include "recognition_demo/row_reader.hpp"

namespace sigmax::apps {
namespace {

constexpr const char* remedy = "leave the cell empty, or have all such cells counted as missing by --unseen missing";

}  // namespace

RowReader::RowReader(const LearnedModel& model, const CsvReader& reader, bool unseen_is_missing)
    : model_(model),
      missing_(model.missing),
      unseen_is_missing_(unseen_is_missing),
      label_(reader.find(model.label)),
      classes_(labels_of(model.counts.pattern())) {
  for (const FeatureCode& feature : model.features)
    columns_.push_back(
        {.index = reader.column(feature.name), .binned = std::vector<double>(feature.bins ? feature.bins->size() : 0)});
}

Readings RowReader::readings(const CsvRow& row) {
  Readings result;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    result.push_back(reading(row, i));
  }
  return result;
}

std::optional<std::size_t> RowReader::truth(const CsvRow& row) {
  if (!label_ || missing_(row[*label_])) return std::nullopt;
  const std::size_t found = place(row, *label_, classes_, "a class of the model: ");
  return found == missing ? std::nullopt : std::optional(found);
}

bool RowReader::say_otherwise(Result& result) const {
  bool in_another_unit = false;
  constexpr double enough = 20.0, much = 0.6;
  if (unseen_cells_ > 0)
    result.say("\n{} as missing, since the model does not know {}: {}",
               unseen_cells_ == 1 ? "1 cell counts" : fmt::format("{} cells count", unseen_cells_),
               unseen_cells_ == 1 ? "it" : "them; the first", first_unseen_);
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const FeatureCode& feature = model_.features[i];
    const Column& column = columns_[i];
    const double all = sum_of(column.binned);
    std::vector<double> learned(column.binned.size());
    for (std::size_t c = 0; c < classes_.size(); ++c)
      for (std::size_t bin = 0; bin < learned.size(); ++bin) learned[bin] += model_.counts.of(i, c)[bin];
    std::size_t bin = 0;
    const auto share = [&](const std::vector<double>& counts) { return counts[bin] / sum_of(counts); };
    while (bin < learned.size() && !(all >= enough && share(column.binned) > share(learned) + much)) ++bin;
    const bool crowds = bin < learned.size();
    in_another_unit = in_another_unit || crowds;
    if (crowds)
      result.say(
          "\nColumn {}: {:.0f} % of {} numbers are {}, {:.0f} % of those learned from; write them in the same "
          "unit",
          in_quotes(feature.name), 100.0 * share(column.binned), all, feature.bins->labels()[bin],
          100.0 * share(learned));
  }
  return in_another_unit;
}

/// Counts what is to be taken as missing, or throws.
std::size_t RowReader::unseen(const CsvRow& row, std::size_t column, const std::string& expected,
                              const std::string& advice) {
  if (!unseen_is_missing_) throw row.error(column, expected, advice);
  if (unseen_cells_++ == 0) first_unseen_ = row.error(column, expected).what();
  return missing;
}

std::size_t RowReader::reading(const CsvRow& row, std::size_t i) {
  const FeatureCode& feature = model_.features[i];
  Column& column = columns_[i];
  const std::string_view cell = trimmed(row[column.index]);
  if (!feature.bins)
    return missing_(cell) ? feature.reading(nan)
                          : place(row, column.index, feature.values, "a value that the model knows: ");
  if (missing_.among_numbers(cell)) return feature.reading(nan);
  const auto number = parse_number(cell);
  if (!number)
    return unseen(row, column.index, "a finite number with a decimal point",
                  has_decimal_comma(cell) ? "write a decimal comma as a point" : remedy);
  const std::size_t bin = feature.bins->bin(*number);
  ++column.binned[bin];
  return bin;
}

/// Where a cell is among names.
std::size_t RowReader::place(const CsvRow& row, std::size_t column, const std::vector<std::string>& names,
                             const char* what) {
  const auto found = std::ranges::find(names, trimmed(row[column]));
  if (found == names.end() && unseen_is_missing_ && unseen_cells_ > 0) {  // the first one is told
    ++unseen_cells_;
    return missing;
  }
  if (found == names.end()) {
    const auto other = std::ranges::find_if(names, [&](const std::string& name) {
      return !alike({name, trimmed(row[column])}).empty();
    });
    return unseen(row, column, what + listed(names, 12),
                  other == names.end() ? remedy : fmt::format("if it is {}, write it as there", in_quotes(*other)));
  }
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace sigmax::apps
