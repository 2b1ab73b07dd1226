#include "recognition_demo/folding.hpp"

#include <sigmax/recognition/decision.hpp>
#include <sigmax/recognition/folds.hpp>

#include "recognition_demo/column_reader.hpp"
#include "support/parallel.hpp"

namespace sigmax::apps {
namespace {

/// Whether any part of the rows can be learned from that has some of each class, however few values a column has there.
bool any_part_teaches(const LearningOptions& options) { return options.smoothing > 0.0 && options.misread <= 0.5; }

/// Of each row that has a fold whether sigma is right about it, by what the rows of other folds teach.
Right right_of_sigma(const DataTable& data, const Folds& folds, std::size_t number, const LearningOptions& options,
                     int threads, const std::vector<std::size_t>& hidden = {}) {
  Right right;
  for (std::size_t row = 0; row < data.size(); ++row) right.push_back(0);
  in_parallel(number, threads_or_all(threads), [&](std::size_t fold) {
    const TaughtFold by = taught(data, folds, fold, options, std::span(kind_names).first(1));
    const auto note = [&](const DataRow& row, std::size_t, const Judged& judged) {
      right.set(row.index, decide(std::get<Belief<Random>>(judged.belief)).pattern == row.label() ? 1 : 0);
    };
    classify_rows(data, folds, by, 0, 1, note, hidden);
  });
  return right;
}

/// Some rows, and the clump that each is in: of those of one clump each is among the three nearest of another one, as
/// are rows of one person or place, or such as were made of one another. Nearness is by ranks, and by words.
struct Clumps {
  static constexpr std::size_t most_rows = 1024;
  std::vector<std::size_t> rows, labels, clump;
  bool are_apart = false;  ///< whether somewhere among the nearest rows the next ones are much farther off
};

/// Of each of some rows the ranks of its numbers, as shares of the rows, and its words. What is missing is a value,
/// too.
std::vector<std::vector<double>> places_of(const std::vector<std::size_t>& rows, const DataTable& data) {
  std::vector<std::vector<double>> cells;
  std::size_t next = 0;
  data.for_each([&](const DataRow& row) {
    if (next == rows.size() || rows[next] != row.index) return;
    ++next;
    auto& own = cells.emplace_back();
    for (std::size_t i = 0; i < data.columns.size(); ++i) {
      const double value = row.value(i);
      own.push_back(std::isnan(value) ? -std::numeric_limits<double>::infinity() : value);
    }
  });
  for (std::size_t i = 0; i < data.columns.size(); ++i) {
    if (!data.columns[i].numeric) continue;
    const auto ranks = ranks_of(each(cells, [&](const auto& own) { return own[i]; }));
    for (std::size_t k = 0; k < ranks.size(); ++k) cells[k][i] = ranks[k] / (2.0 * static_cast<double>(ranks.size()));
  }
  return cells;
}

Clumps clumps_of(const DataTable& data, std::size_t most_alike, std::mt19937_64& generator) {
  constexpr std::size_t neighbours = 3;
  Clumps result;
  std::vector<std::size_t>&rows = result.rows, &clump = result.clump;
  data.for_each([&](const DataRow& row) {
    if (generator() % (data.size() - row.index) >= Clumps::most_rows - rows.size()) return;
    rows.push_back(row.index);
    result.labels.push_back(row.label());
  });
  const auto cells = places_of(rows, data);
  const std::size_t n = rows.size();
  constexpr std::size_t most_words = 24;  // those of more, as of towns, are themselves what rows are of
  const auto distance = [&](std::size_t a, std::size_t b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < data.columns.size(); ++i)
      if (data.columns[i].values.size() <= most_words)
        sum += data.columns[i].numeric ? std::abs(cells[a][i] - cells[b][i]) : cells[a][i] == cells[b][i] ? 0.0 : 0.5;
    return sum;
  };
  using Near = std::pair<double, std::size_t>;
  std::vector<std::vector<Near>> nearest(n);
  // How much farther the 2k-th row is than the k-th, as a logarithm: of rows in no clumps it falls slowly with k.
  constexpr std::array<std::size_t, 12> steps = {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64};
  std::array<RunningMean, steps.size()> farther;
  for (std::size_t a = 0; a < n; ++a) {
    auto& all = nearest[a];
    for (std::size_t b = 0; b < n; ++b)
      if (a != b) all.emplace_back(distance(a, b), b);
    std::ranges::sort(all);
    const auto same = static_cast<std::size_t>(std::ranges::count(all, 0.0, &Near::first));
    for (std::size_t i = 0; i < steps.size() && same + 2 * steps[i] <= all.size(); ++i)
      farther[i].add(std::log(all[same + 2 * steps[i] - 1].first / all[same + steps[i] - 1].first));
    all.resize(std::min(neighbours, all.size()));
  }
  constexpr double much = 2.0, some = 0.01;  // where distances are few, many rows are as far as the next
  for (std::size_t i = 0; i < steps.size(); ++i)
    for (std::size_t j = i + 1; j < steps.size() && farther[j].count() > 0; ++j)
      result.are_apart |= farther[j].mean() > some && farther[i].mean() > much * farther[j].mean();
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
  for (std::size_t a = 0; a < n; ++a)
    for (const auto& [apart, b] : nearest[a])
      if (a < b && std::ranges::find(nearest[b], a, &Near::second) != nearest[b].end()) pairs.emplace_back(apart, a, b);
  std::ranges::sort(pairs);
  clump = each_below(n, std::identity{});
  for (const auto& [apart, a, b] : pairs) {
    const std::size_t one = clump[a], other = clump[b];
    const auto in = [&](std::size_t which) { return static_cast<std::size_t>(std::ranges::count(clump, which)); };
    if (one != other && in(one) + in(other) <= most_alike) std::ranges::replace(clump, other, one);
  }
  return result;
}

/// Columns of which each word stands beside one value of another column only, as a town beside its region.
std::vector<std::size_t> nested_in(const DataTable& data, std::size_t column) {
  std::vector<std::map<double, double>> beside(data.columns.size());
  std::vector<bool> is_nested(data.columns.size());
  for (std::size_t i = 0; i < is_nested.size(); ++i) is_nested[i] = i != column && !data.columns[i].numeric;
  data.for_each([&](const DataRow& row) {
    const double value = row.value(column);
    for (std::size_t i = 0; i < is_nested.size(); ++i)
      if (is_nested[i] && !std::isnan(row.value(i)))
        is_nested[i] = beside[i].try_emplace(row.value(i), value).first->second == value;
  });
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < is_nested.size(); ++i)
    if (is_nested[i]) columns.push_back(i);
  return columns;
}

/// The number of bins by which rows that are left out are right more often than by chance, in any class, and not less
/// often in all; nothing if there is none.
std::optional<std::size_t> better_bins(const DataTable& data, const LearningOptions& options) {
  constexpr double by_no_chance = 3.0;  // standard errors
  constexpr std::size_t most = 1000;
  const auto before = right_when_left_out(data, options, 1, 0);
  LearningOptions other = options;
  other.equal_width = false;
  for (const std::size_t times : {2U, 4U, 8U}) {
    other.bins = std::min(times * options.bins, most);
    const auto now = right_when_left_out(data, other, 1, 0);
    bool any = false;
    double more = 0.0, variance = 0.0;
    for (std::size_t c = 0; c < now.size() && c < before.size(); ++c) {
      const auto rows = static_cast<double>(data.rows_of_class[c]);
      const double mean = (now[c] + before[c]) / 2.0, own = 2.0 * mean * (1.0 - mean) * rows;
      any |= rows * (now[c] - before[c]) > by_no_chance * std::sqrt(own);
      more += rows * (now[c] - before[c]), variance += own;
    }
    if (any && more > -std::sqrt(variance)) return other.bins;
  }
  return std::nullopt;
}

}  // namespace

Folds folds_of(const DataTable& data, std::size_t folds, std::mt19937_64& generator) {
  constexpr std::size_t part = std::size_t{1} << 17;
  FoldDealer dealer(data.rows_of_class, folds);
  Folds result;
  std::vector<std::size_t> labels;
  const auto deal = [&] {
    for (const std::size_t fold : dealer.deal(labels, generator)) result.push_back(static_cast<std::uint32_t>(fold));
    labels.clear();
  };
  data.for_each([&](const DataRow& row) {
    labels.push_back(row.label());
    if (labels.size() == part) deal();
  });
  deal();
  return result;
}

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
  if (const std::string two = alike(each(numbers, [](const auto& one) { return std::string_view(one.first); }));
      !two.empty())
    complain(fmt::format(
        "recognition_demo: warning: {}: column {}: {} differ in case, blanks, Unicode forms or the writing of a number "
        "only, and count as two groups",
        data.file, in_quotes(column), two));
  return groups;
}

Folds folds_of(const DataTable& data, const Groups& groups, std::size_t folds, std::mt19937_64& generator) {
  constexpr int most_tries = 100;
  std::vector<std::size_t> rows;                               // of each group
  std::vector<std::set<std::size_t>> of(data.classes.size());  // the groups of each class
  ScratchCursor<std::uint32_t> group(groups);
  data.for_each([&](const DataRow& row) {
    const std::size_t own = group[row.index];
    rows.resize(std::max(rows.size(), own + 1));
    ++rows[own];
    of[row.label()].insert(own);
  });
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
  Folds result;
  for (std::size_t row = 0; row < data.size(); ++row) result.push_back(static_cast<std::uint32_t>(fold[group[row]]));
  return result;
}

TaughtFold taught(const DataTable& data, const Folds& folds, std::size_t fold, const LearningOptions& options,
                  std::span<const std::string> kinds) {
  ScratchCursor<std::uint32_t> fold_of(folds);
  LearnedModel model = learn(
      data, options, [&](const DataRow& row) { return fold_of[row.index] != fold && fold_of[row.index] != no_fold; });
  auto contestants = classifiers(model, kinds);
  std::vector<std::vector<bool>> known(model.features.size());
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (model.features[i].bins) continue;
    known[i].resize(model.features[i].values.size());
    for (std::size_t c = 0; c < data.classes.size(); ++c)
      for (std::size_t value = 0; value < known[i].size(); ++value)
        known[i][value] = known[i][value] || model.counts.of(i, c)[value] > 0.0;
  }
  return {fold, std::move(model), std::move(contestants), std::move(known)};
}

std::vector<double> right_when_left_out(const DataTable& data, const LearningOptions& options, std::uint64_t seed,
                                        int threads, const std::vector<std::size_t>& hidden) {
  constexpr std::size_t long_table = 50000;
  const std::size_t number = data.size() > long_table ? 3 : std::min<std::size_t>(10, data.size());
  if (!any_part_teaches(options) || std::ranges::min(data.rows_of_class) < 2) return {};
  std::mt19937_64 generator(seed);
  const Right right = right_of_sigma(data, folds_of(data, number, generator), number, options, threads, hidden);
  ScratchCursor<std::uint8_t> is_right(right);
  std::vector<double> shares(data.classes.size());
  data.for_each([&](const DataRow& row) { shares[row.label()] += is_right[row.index]; });
  for (std::size_t c = 0; c < shares.size(); ++c) shares[c] /= static_cast<double>(data.rows_of_class[c]);
  return shares;
}

std::vector<std::size_t> columns_of_groups(const DataTable& data, const LearningOptions& options) {
  constexpr std::size_t fewest_words = 6, fewest_numbers = 11, most_columns = 8, most_rows = 50000;
  constexpr double little = 0.05;
  if (data.size() > most_rows || std::ranges::count_if(data.columns, &DataColumn::numeric) < 2) return {};
  std::vector<std::map<double, std::size_t>> values(data.columns.size());  // and their rows
  std::vector<bool> whole(data.columns.size(), true);
  data.for_each([&](const DataRow& row) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double cell = row.value(i);
      whole[i] = whole[i] && cell == std::floor(cell);
      if (whole[i] && 2 * values[i].size() <= data.size()) ++values[i][cell];
    }
  });
  const LearnedModel model = learn(data, options);
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < values.size() && columns.size() < most_columns; ++i) {
    const std::map<double, std::size_t>& own = values[i];
    if (!whole[i] || own.empty() || 2 * own.size() > data.size()) continue;
    // Numbers that are no quantity have about as many rows each; few of them are grades, bands or answers.
    const auto [fewest_rows, most_of_one] = std::ranges::minmax(each(own, [](const auto& one) { return one.second; }));
    const bool counts = static_cast<double>(own.size() - 1) == own.rbegin()->first - own.begin()->first;
    const bool are_numbers = std::ranges::all_of(
        data.columns[i].values, [](const std::string& word) { return parse_number(word).has_value(); });
    if (own.size() < (are_numbers ? fewest_numbers : fewest_words) || 3 * most_of_one > data.size()) continue;
    if (are_numbers && (!counts || most_of_one > 3 * fewest_rows)) continue;
    if (told_of_class(model, i) < little) columns.push_back(i);
  }
  return columns;
}

/// Of each row the shares of dealings in which sigma is right about it: in any folds, once for each of some sets of
/// hidden columns, and at last in folds of whole groups, without the last set; nothing where these cannot part a class.
std::optional<std::vector<std::vector<double>>> shares_right(const DataTable& data, const LearningOptions& options,
                                                             const Groups& groups, std::size_t number_of_groups,
                                                             const std::vector<std::vector<std::size_t>>& hidden,
                                                             std::uint64_t seed, int threads) {
  constexpr std::size_t most_folds = 10, most_asked = 10000, most_dealings = 8;
  if (!any_part_teaches(options) || std::ranges::min(data.rows_of_class) < 2) return std::nullopt;
  std::mt19937_64 generator(seed);
  const std::size_t number = std::min({most_folds, number_of_groups, data.size()});
  const std::size_t dealings = std::clamp<std::size_t>(most_asked / data.size(), 1, most_dealings);
  std::vector<std::vector<double>> shares(data.size(), std::vector<double>(hidden.size() + 1));
  try {
    for (std::size_t dealing = 0; dealing < dealings; ++dealing) {
      const Folds any = folds_of(data, number, generator), whole = folds_of(data, groups, number, generator);
      for (std::size_t way = 0; way <= hidden.size(); ++way) {
        const bool is_any = way < hidden.size();
        const Right right =
            right_of_sigma(data, is_any ? any : whole, number, options, threads, is_any ? hidden[way] : hidden.back());
        ScratchCursor<std::uint8_t> is_right(right);
        for (std::size_t row = 0; row < data.size(); ++row)
          shares[row][way] += is_right[row] / static_cast<double>(dealings);
      }
    }
  } catch (const InputError&) {
    return std::nullopt;
  }
  return shares;
}

std::optional<ByColumn> by_column(const DataTable& data, const LearningOptions& options, std::size_t column,
                                  std::uint64_t seed, int threads) {
  std::map<double, std::uint32_t> numbers;
  Groups groups;
  data.for_each([&](const DataRow& row) {
    groups.push_back(numbers.try_emplace(row.value(column), static_cast<std::uint32_t>(numbers.size())).first->second);
  });
  ByColumn result{.hidden = nested_in(data, column), .values = numbers.size()};
  result.hidden.insert(result.hidden.begin(), column);
  const auto shares = shares_right(data, options, groups, numbers.size(), {{}, {column}, result.hidden}, seed, threads);
  if (!shares) return std::nullopt;
  result.without = mean_interval(each(*shares, [](const auto& row) { return row[1]; })).mean;
  result.more = mean_interval(each(*shares, [](const auto& row) { return row[1] - row[0]; }));
  result.less = mean_interval(each(*shares, [](const auto& row) { return row[2] - row[3]; }));
  result.without_all = mean_interval(each(*shares, [](const auto& row) { return row[2]; })).mean;
  return result;
}

std::optional<Interval> less_in_any_folds(const DataTable& data, const LearningOptions& options, std::uint64_t seed,
                                          int threads) {
  Groups rows;
  for (std::size_t row = 0; row < data.size(); ++row) rows.push_back(static_cast<std::uint32_t>(row));
  const auto shares = shares_right(data, options, rows, data.size(), {{}}, seed, threads);
  if (!shares) return std::nullopt;
  return mean_interval(each(*shares, [](const auto& row) { return row[0] - row[1]; }));
}

std::optional<ByClumps> by_clumps(const DataTable& data, const LearningOptions& options, std::uint64_t seed,
                                  int threads) {
  constexpr int dealings = 2;
  constexpr std::uint32_t number = 10;  // of folds
  // Of a class without a clump enough is left, else it is the class itself that is missed.
  constexpr std::size_t few_alike = 4, most_of_them = 24;
  const std::size_t alike =
      std::min(most_of_them, std::min(Clumps::most_rows, data.size()) / (16 * data.classes.size()));
  if (!any_part_teaches(options) || alike < few_alike) return std::nullopt;
  std::mt19937_64 generator(seed);
  const Clumps clumps = clumps_of(data, alike, generator);
  if (!clumps.are_apart) return std::nullopt;
  const std::size_t n = clumps.rows.size();
  const auto alone = each_below(n, std::identity{});
  // Whether each row is recognised when, of each class, that of the first row, clumps go to one fold after the other.
  const auto right_by = [&](const std::vector<std::size_t>& clump) -> std::optional<std::vector<double>> {
    std::vector<std::vector<std::size_t>> of_class(data.classes.size());
    for (std::size_t k = 0; k < n; ++k)
      if (clump[k] == k) of_class[clumps.labels[k]].push_back(k);
    std::vector<std::uint32_t> fold(n);
    std::uint32_t next = 0;
    for (auto& own : of_class) {
      if (own.size() < 2) return std::nullopt;
      for (std::size_t left = own.size(); left > 1; --left) std::swap(own[left - 1], own[generator() % left]);
      for (const std::size_t k : own) fold[k] = next++ % number;
    }
    Folds folds;
    for (std::size_t row = 0, k = 0; row < data.size(); ++row)
      folds.push_back(k < n && clumps.rows[k] == row ? fold[clump[k++]] : no_fold);
    const Right right = right_of_sigma(data, folds, number, options, threads);
    ScratchCursor<std::uint8_t> is_right(right);
    return each(clumps.rows, [&](std::size_t row) { return static_cast<double>(is_right[row]); });
  };
  std::vector<double> right(n), less(n);
  for (int dealing = 0; dealing < dealings; ++dealing) {
    const auto apart = right_by(alone), together = apart ? right_by(clumps.clump) : std::nullopt;
    if (!together) return std::nullopt;
    for (std::size_t k = 0; k < n; ++k) {
      right[k] += (*apart)[k] / dealings;
      less[k] += ((*apart)[k] - (*together)[k]) / dealings;
    }
  }
  return ByClumps{n, mean_interval(right).mean, mean_interval(less)};
}

void print_warnings(const DataTable& data, const LearningOptions& options, bool grouped) {
  for (const auto& warning : data.warnings) complain("recognition_demo: warning: " + warning);
  const auto coarse = warn_of_bins(data, options);
  // Of copies, or of rows of one thing, the other one would be found again.
  const auto bins = coarse.empty() || data.has_copies || grouped ? std::nullopt : better_bins(data, options);
  if (bins && !are_in_clumps(by_clumps(data, options, 1, 0)))
    complain(fmt::format(
        "recognition_demo: warning: {}: {} bins put together numbers of {} that tell different classes: "
        "give --bins {}{}, or take what is codes or hours by --categorical",
        data.file, options.bins, listed(coarse, 12), *bins, options.equal_width ? "" : ", or --equal-width"));
}

}  // namespace sigmax::apps
