#include "recognition_demo/folding.hpp"

#include <map>
#include <set>

#include <sigmax/recognition/decision.hpp>
#include <sigmax/recognition/folds.hpp>

#include "shell/parallel.hpp"

namespace sigmax::apps {

Groups groups_of(const DataTable& data, const std::string& column) {
  CsvReader reader = open_csv(data.file);
  const std::size_t place = reader.column(column);
  std::map<std::string, std::uint32_t, std::less<>> numbers;
  Groups groups;
  for (CsvRow row; reader.next(row);) {
    const std::string name(trimmed(row[place]));
    if (name.empty() || says_unknown(name)) throw row.error(place, "the name of the row's group", "fill the cell");
    groups.push_back(numbers.try_emplace(name, static_cast<std::uint32_t>(numbers.size())).first->second);
  }
  return groups;
}

Folds grouped_folds(const DataTable& data, const Groups& groups, std::size_t folds, std::mt19937_64& generator) {
  constexpr int most_tries = 100;
  std::vector<std::size_t> rows;                               // of each group
  std::vector<std::set<std::size_t>> of(data.classes.size());  // the groups of each class
  for (std::size_t row = 0; row < data.size(); ++row) {
    const std::size_t own = groups[row];
    rows.resize(std::max(rows.size(), own + 1));
    ++rows[own];
    of[data.labels[row]].insert(own);
  }
  if (rows.size() < folds)
    throw InputError("{}: found {} groups, expected at least as many as the {} folds; give fewer --folds", data.file,
                     rows.size(), folds);
  std::vector<std::size_t> order = each_below(rows.size(), std::identity{}), fold(rows.size());
  const auto is_parted = [&](const std::set<std::size_t>& its) {
    return std::ranges::any_of(its, [&](std::size_t one) { return fold[one] != fold[*its.begin()]; });
  };
  for (int tried = 0; tried == 0 || !std::ranges::all_of(of, is_parted); ++tried) {
    if (tried == most_tries) {
      const auto whole = std::ranges::find_if_not(of, is_parted);
      throw InputError(
          "{}: the rows of class {} are of {} groups, which came into one fold: expected two at least, one to learn "
          "from, one to classify",
          data.file, in_quotes(data.classes[static_cast<std::size_t>(whole - of.begin())]), whole->size());
    }
    for (std::size_t left = order.size(); left > 1; --left) std::swap(order[left - 1], order[generator() % left]);
    std::vector<std::size_t> sizes(folds);
    for (const std::size_t one : order) {
      fold[one] = static_cast<std::size_t>(std::ranges::min_element(sizes) - sizes.begin());
      sizes[fold[one]] += rows[one];
    }
  }
  return each(groups, [&](std::uint32_t group) { return fold[group]; });
}

TaughtFold taught(const DataTable& data, const Folds& folds, std::size_t fold, const LearningOptions& options,
                  std::span<const std::string> kinds) {
  LearnedModel model = learn(data, options, [&](std::size_t row) { return folds[row] != fold; });
  auto contestants = classifiers(model, kinds);
  std::vector<std::vector<bool>> known(model.features.size());
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (model.features[i].bins) continue;
    known[i].resize(model.features[i].size());
    for (std::size_t c = 0; c < data.classes.size(); ++c)
      for (std::size_t value = 0; value < known[i].size(); ++value)
        known[i][value] = known[i][value] || model.counts.of(i, c)[value] > 0.0;
  }
  return {fold, std::move(model), std::move(contestants), std::move(known)};
}

std::vector<double> right_when_left_out(const DataTable& data, const LearningOptions& options) {
  constexpr std::size_t long_table = 50000;
  const std::size_t number = data.size() > long_table ? 3 : std::min<std::size_t>(10, data.size());
  const bool any_part_teaches = options.smoothing > 0.0 && options.misread <= 0.5;
  if (!any_part_teaches || std::ranges::min(data.rows_of_class) < 2) return {};
  std::mt19937_64 generator(1);
  const Folds folds = stratified_folds(data.labels, number, generator);
  std::vector<std::uint8_t> right(data.size());
  in_parallel(number, threads_or_all(0), [&](std::size_t fold) {
    const TaughtFold by = taught(data, folds, fold, options, std::span(kind_names).first(1));
    classify_rows(data, folds, by, 0, 1, [&](std::size_t row, std::size_t, const Judged& judged) {
      right[row] = decide(std::get<Belief<Random>>(judged.belief)).pattern == data.labels[row] ? 1 : 0;
    });
  });
  std::vector<double> shares(data.classes.size());
  for (std::size_t row = 0; row < data.size(); ++row) shares[data.labels[row]] += right[row];
  for (std::size_t c = 0; c < shares.size(); ++c) shares[c] /= static_cast<double>(data.rows_of_class[c]);
  return shares;
}

}  // namespace sigmax::apps
