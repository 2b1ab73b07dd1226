#include <array>
#include <cmath>
#include <tuple>

#include "recognition_demo/column_reader.hpp"
#include "support/progress.hpp"
#include "support/text.hpp"

namespace sigmax::apps {
namespace {

/// Columns with their lone values, all at once: throws if there is such a one.
void refuse_useless(const std::vector<ColumnReader>& columns, const DataTable& table) {
  std::vector<std::string> found, names;
  bool gaps = false;
  for (const ColumnReader& column : columns) {
    const std::string value = column.lone_value();
    if (value.empty()) continue;
    const std::size_t empty = table.size() - column.filled();
    const bool has_gaps = 0 < empty && empty < table.size();
    gaps |= has_gaps;
    names.push_back(typed(column.name()));
    found.push_back(fmt::format("{} in column {}{}", value, in_quotes(column.name()),
                                has_gaps ? fmt::format(" (and no value in {} rows)", empty) : ""));
  }
  if (names.empty()) return;
  throw InputError(
      {.where = table.file,
       .found = fmt::format("{}, in all of {} rows", fmt::join(found, ", "), table.size()),
       .expected = "at least two different values",
       .remedy = fmt::format("{}leave out what never changes by --ignore {}",
                             gaps ? "if an empty cell says no, write no; else " : "", fmt::join(names, ","))});
}

/// Whether a class is a number of nines, as 99 or -9, beyond all others by more than there are classes.
bool is_nines(std::string_view name, const std::vector<std::string>& classes) {
  const double side = name.starts_with('-') ? -1.0 : 1.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& other : classes) {
    if (!parse_number(other)) return false;
    if (other != name) nearest = std::min(nearest, side * (*parse_number(name) - *parse_number(other)));
  }
  return name.find_first_not_of("-9") == name.npos && nearest > static_cast<double>(classes.size());
}

void warn_of_classes(const Vocabulary& classes, DataTable& table) {
  const std::size_t rows = table.size(), number = table.classes.size();
  const std::string alike = classes.alike();
  table.warn_of(table.label, !alike.empty(), alike_words, alike);
  const bool most_are_lone = 2 * number > rows;
  table.warn_of(table.label, most_are_lone && rows >= few_rows,
                " has {} classes in {} rows: of most there is a single row, from which nothing can be learned; is it "
                "the right --label?",
                number, rows);
  std::vector<std::string> lone;
  for (std::size_t k = 0; k < number; ++k)
    if (table.rows_of_class[k] == 1) lone.push_back(table.classes[k]);
  table.warn_of(table.label, !lone.empty() && rows >= few_rows && !most_are_lone,
                ": a single row is of {}: is it a slip of writing? From one row nothing can be learned",
                listed(lone, 12));
  for (std::size_t k = 0; k < number; ++k) {
    const std::string name = lower_case(table.classes[k]);
    table.warn_of(table.label,
                  says_unknown(name) || (name == "-" && !classes.contains("+")) || name == "--" || name == "unknown" ||
                      is_nines(name, table.classes),
                  ": {} of {} rows hold {}, which counts as a class: if their class is not known, remove them",
                  table.rows_of_class[k], rows, in_quotes(table.classes[k]));
  }
}

void warn_of_names(const CsvReader& reader, const std::vector<ColumnReader>& columns, const Vocabulary& classes,
                   DataTable& table) {
  std::vector<std::string> like_cells;
  std::size_t words = 0;
  for (const ColumnReader& column : columns)
    if (column.is_named_as_a_cell())
      words += column.is_numeric() ? 0U : 1U, like_cells.push_back(in_quotes(column.name()));
  table.warn(2 * like_cells.size() > columns.size() &&
                 (classes.contains(table.label) || (words > 1 && like_cells.size() == columns.size())),
             "the first row looks like data ({}): it was taken for the names of the columns, and is not counted; put a "
             "row of names above it",
             fmt::join(like_cells, ", "));
  for (std::size_t i = 0; i < reader.names().size(); ++i)
    table.warn(reader.names()[i].empty(), "column {} has no name and is left out", i + 1);
}

/// The rows that differ, of long tables some chosen by hash, and how many rows they are with their copies.
struct DistinctRows {
  std::vector<std::vector<double>> columns;  ///< of each row the number or the code, NaN where it is missing
  std::vector<double> classes;               ///< of each row
  std::size_t with_copies = 0;
  std::map<double, std::pair<std::size_t, std::size_t>> of_class;  ///< how many differ, and with their copies

  explicit DistinctRows(const DataTable& table) {
    constexpr std::size_t most = 1024;
    std::map<std::size_t, std::pair<std::vector<double>, std::size_t>> found;  // by hash, the least, and how often
    std::vector<double> row_cells;
    table.for_each([&](const DataRow& row) {
      row_cells.clear();
      for (std::size_t i = 0; i < table.columns.size(); ++i) row_cells.push_back(row.value(i));
      row_cells.push_back(static_cast<double>(row.label()));
      const auto hash = std::hash<std::string_view>{}(
          {reinterpret_cast<const char*>(row_cells.data()), row_cells.size() * sizeof(double)});
      if (found.size() == most && hash > found.rbegin()->first) return;
      ++found.try_emplace(hash, row_cells, 0).first->second.second;
      if (found.size() > most) found.erase(std::prev(found.end()));
    });
    columns.resize(table.columns.size());
    for (const auto& [hash, row] : found) {
      const auto& [cells, times] = row;
      for (std::size_t i = 0; i < columns.size(); ++i) columns[i].push_back(cells[i]);
      classes.push_back(cells.back());
      auto& [differ, all] = of_class[cells.back()];
      ++differ, all += times;
      with_copies += times;
    }
  }
};

/// Whether each value of one column stands beside one of another only, and the other way.
bool one_to_one(const std::vector<double>& a, const std::vector<double>& b) {
  std::map<double, double> to, from;
  std::size_t known = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (std::isnan(a[k]) || std::isnan(b[k])) continue;
    ++known;
    if (to.emplace(a[k], b[k]).first->second != b[k] || from.emplace(b[k], a[k]).first->second != a[k]) return false;
  }
  return known >= few_rows && to.size() > 1 && 3 * to.size() < 2 * known;
}

/// Whether two columns put the rows in the same order, or the opposite one, but for what rounding does.
bool same_order(const std::vector<double>& a, const std::vector<double>& b) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] >= 0.0 && b[i] >= 0.0) {
      ++n, x += a[i], y += b[i];
      xx += a[i] * a[i], yy += b[i] * b[i], xy += a[i] * b[i];
    }
  constexpr double nearly_one = 0.999;
  const double both = n * xy - x * y;
  return n >= few_rows && both * both > nearly_one * (n * xx - x * x) * (n * yy - y * y);
}

/// How many times the smaller numbers of a column the greater ones are, where both lie close together, far apart, by
/// ten or a power of it, as in two units; and how many are the rarer ones. Nothing if it is otherwise.
std::optional<std::pair<double, std::size_t>> two_units(std::vector<double> numbers) {
  constexpr double far = 8.0, close = 4.0, near = 1.2;
  std::erase_if(numbers, [](double number) { return std::isnan(number); });
  std::ranges::sort(numbers);
  if (numbers.size() < few_rows || numbers.front() <= 0.0) return {};
  auto gap = numbers.begin() + 1;  // the widest
  for (auto next = gap; next != numbers.end(); ++next)
    if (*next / *(next - 1) > *gap / *(gap - 1)) gap = next;
  const auto middle = [](auto first, auto last) { return *(first + (last - first) / 2); };
  const double times = middle(gap, numbers.end()) / middle(numbers.begin(), gap);
  const double power = std::pow(10.0, std::round(std::log10(times)));
  const auto below = gap - numbers.begin(), above = numbers.end() - gap;
  const bool are_close = *(gap - 1) < close * numbers.front() && numbers.back() < close * *gap;
  const bool is_code = numbers.front() == *(gap - 1) || *gap == numbers.back();
  if (*gap < far * *(gap - 1) || !are_close || is_code || std::min(below, above) < 5 || power < 10.0) return {};
  if (times > near * power || power > near * times) return {};
  return std::pair(power, static_cast<std::size_t>(std::min(below, above)));
}

/// How often two rows have the same in a column.
double chance_of_two(std::vector<double> cells) {
  std::ranges::sort(cells, [](double a, double b) { return std::isnan(b) ? !std::isnan(a) : a < b; });
  const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
  double squares = 0.0;
  for (auto first = cells.begin(); first != cells.end();) {
    const auto last = std::find_if_not(first, cells.end(), [&](double cell) { return same(cell, *first); });
    squares += std::pow(static_cast<double>(last - first), 2);
    first = last;
  }
  return squares / std::pow(static_cast<double>(cells.size()), 2);
}

/// What the rows and the columns tell twice.
void warn_of_repeats(DataTable& table) {
  constexpr std::size_t most_facts = 16;  // of a column
  const DistinctRows rows(table);
  const std::size_t size = rows.classes.size();
  if (size < few_rows) return;
  std::vector<std::vector<double>> ranks;
  std::vector<bool> comparable;  // by their order
  // How many of the rows of a class would be the same by chance, where half of the columns hang on the others.
  double alike = 1.0;
  std::size_t fine = 0;  // columns that most of these rows differ in, as they would not by chance
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    ranks.push_back(ranks_of(rows.columns[i]));
    const std::size_t different = std::set(ranks[i].begin(), ranks[i].end()).size();
    fine += 2 * different > size ? 1U : 0U;
    alike *= std::sqrt(chance_of_two(rows.columns[i]));
    comparable.push_back(table.columns[i].numeric && different >= 4);
    if (const auto units = table.columns[i].numeric ? two_units(rows.columns[i]) : std::nullopt)
      table.warn_of(table.columns[i].name, true,
                    ": {} of {} numbers are about {:.0f} times greater, or smaller, than the others, as if in another "
                    "unit: write all in one",
                    units->second, size, units->first);
  }
  const auto warn_of_copies = [&](const std::string& which, std::size_t differ, std::size_t all) {
    table.has_copies = true;
    table.warn(true,
               "{:.0f} % of {} repeat another, label included: if they are copies, what is learned from one is asked "
               "of the other, and the shares of right answers are too good: drop them; what coincides by chance, as "
               "values below a limit do, is to stay",
               100.0 - 100.0 * static_cast<double>(differ) / static_cast<double>(all), which);
  };
  // Columns of 0 and 1, or of two words, each of which is 1, or the second, in rows of one class only.
  std::vector<std::string> one_hot;
  std::vector<std::size_t> ones(size);
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const std::vector<double>& column = rows.columns[i];
    std::set<double> classes;
    for (std::size_t k = 0; k < size; ++k)
      if (column[k] == 1.0) classes.insert(rows.classes[k]);
    const bool binary = std::ranges::all_of(column, [](double cell) { return cell == 0.0 || cell == 1.0; });
    if (!binary || classes.size() != 1) continue;
    one_hot.push_back(typed(table.columns[i].name));
    for (std::size_t k = 0; k < size; ++k) ones[k] += column[k] == 1.0 ? 1U : 0U;
  }
  std::map<double, std::set<std::size_t>> sums;  // by class
  for (std::size_t k = 0; k < size; ++k) sums[rows.classes[k]].insert(ones[k]);
  const auto without = std::ranges::count_if(sums, [](const auto& sum) { return sum.second == std::set{0UL}; });
  const auto with = std::ranges::count_if(sums, [](const auto& sum) { return !sum.second.contains(0); });
  // Of two classes a column that is 1 in all rows of one alone tells both.
  table.warn(one_hot.size() > 1 && with + without == std::ssize(sums) && (without == 1 || (without == 0 && with > 2)),
             "of {} columns ({}) each is 1 in rows of one class only, and one is in each row of {}: they are the class "
             "itself; leave them out by --ignore {}",
             one_hot.size(), listed(one_hot, 3), without == 0 ? "all classes" : "all classes but one",
             fmt::join(one_hot, ","));
  // One fact that several columns tell in the same word, as of what a customer does not have.
  std::map<std::pair<std::string, std::vector<bool>>, std::vector<std::string>> facts;  // columns by word and rows
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    for (std::size_t code = 0; code < table.columns[i].values.size() && code < most_facts; ++code) {
      const auto stands = each(rows.columns[i], [&](double cell) { return cell == static_cast<double>(code); });
      if (20 * std::ranges::count(stands, true) >= std::ssize(stands))
        facts[{table.columns[i].values[code], stands}].push_back(table.columns[i].name);
    }
  for (const auto& [fact, names] : facts)
    table.warn(names.size() > 2,
               "{} stands in the same rows in {} columns ({}), and counts {} times: if it says that there is none, "
               "give --missing={}",
               in_quotes(fact.first), names.size(), listed(names, 3), names.size(), typed(fact.first));
  // As a statistics program writes them: each combination of words and class once, and how often.
  std::size_t combinations = table.classes.size(), numbers = 0;
  std::string of_counts;
  for (const DataColumn& column : table.columns)
    if (column.numeric)
      ++numbers, of_counts = column.name;
    else
      combinations *= column.values.size();
  table.warn(size == table.size() && size == rows.with_copies && combinations == size && numbers <= 1,
             "each combination of words and classes stands once, as in a table of counts{}: each row counts once here; "
             "write one row for each that was counted",
             of_counts.empty() ? "" : fmt::format(" (column {})", in_quotes(of_counts)));
  // Whether one in so many repeats another, and not by chance.
  const auto repeat = [&](std::size_t differ, std::size_t all, std::size_t one_in) {
    const auto pairs = static_cast<double>(all) * static_cast<double>(all) / 2.0;
    const bool few_would = fine >= 2 || 10.0 * pairs * alike < static_cast<double>(all - differ);
    return few_would && all >= few_rows && one_in * (all - differ) >= all;
  };
  if (!repeat(size, rows.with_copies, 2))
    for (const auto& [label, counts] : rows.of_class)
      if (const auto [differ, all] = counts; repeat(differ, all, 2))
        warn_of_copies(fmt::format("the rows of class {}", in_quotes(table.classes[static_cast<std::size_t>(label)])),
                       differ, all);
  if (!table.has_copies && repeat(size, rows.with_copies, 10))
    warn_of_copies(fmt::format("{} rows", table.size()), size, rows.with_copies);
  std::vector<bool> repeated(ranks.size());  // an earlier column
  const auto says_the_same = [&](std::size_t i, std::size_t j) {
    if (repeated[i] || repeated[j]) return false;
    return comparable[i] && comparable[j] ? same_order(ranks[i], ranks[j])
                                          : one_to_one(rows.columns[i], rows.columns[j]);
  };
  std::vector<std::pair<std::string, std::vector<std::string>>> families;  // that say the same
  std::vector<std::string> all_others;
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    std::vector<std::string> others;
    for (std::size_t j = i + 1; j < ranks.size(); ++j)
      if (says_the_same(i, j)) {
        repeated[j] = true;
        others.push_back(typed(table.columns[j].name));
        all_others.push_back(others.back());
      }
    if (!others.empty()) families.emplace_back(table.columns[i].name, std::move(others));
  }
  constexpr std::size_t most_families = 3;
  for (const auto& [name, others] : families)
    table.warn_of(name, families.size() <= most_families,
                  " says the same as {}, as if in another unit or in other words: it counts {} times; leave the others "
                  "out by --ignore {}",
                  fmt::join(others, ","), others.size() + 1, fmt::join(others, ","));
  if (families.size() <= most_families) return;
  table.warn(true,
             "{} columns say the same as others, the first {} as {}, as if in another unit or in other words, and "
             "count several times; leave the others out by --ignore {}",
             families.size(), in_quotes(families[0].first), fmt::join(families[0].second, ","),
             fmt::join(all_others, ","));
}

/// Where a missing value would tell the class, and does not.
void warn_of_gaps(DataTable& table) {
  const std::size_t classes = table.classes.size();
  std::vector<std::size_t> gaps(table.columns.size() * classes);
  table.for_each([&](const DataRow& row) {
    for (std::size_t i = 0; i < table.columns.size(); ++i)
      if (std::isnan(row.value(i))) ++gaps[i * classes + row.label()];
  });
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const auto share = [&](std::size_t k) {
      return static_cast<double>(gaps[i * classes + k]) / static_cast<double>(table.rows_of_class[k]);
    };
    std::vector<std::size_t> known;  // classes of which one can tell
    for (std::size_t k = 0; k < classes; ++k)
      if (table.rows_of_class[k] >= few_rows) known.push_back(k);
    if (known.empty()) return;
    const auto [least, most] = std::ranges::minmax(known, {}, share);
    table.warn_of(
        table.columns[i].name, share(most) - share(least) >= 0.5,
        ": {:.0f} % of the cells of class {} are missing, and {:.0f} % of {}, which counts for nothing: where an empty "
        "cell says something, as no or less than a limit, and does so before the class is known, write it",
        100.0 * share(most), in_quotes(table.classes[most]), 100.0 * share(least), in_quotes(table.classes[least]));
  }
}

/// Rows of a class that are much as the row before, as those of a recording: by the ratio of von Neumann (1941) of most
/// columns of numbers, which is 2 of what comes in no order.
void warn_of_order(DataTable& table) {
  constexpr double lasting = 0.3;
  struct Sums {
    double n = 0.0, first = 0.0, sum = 0.0, squares = 0.0, last = nan;  // sums about the first
  };
  const std::size_t columns = table.columns.size(), classes = table.classes.size();
  // What the rows were sorted by, first by one column, then by the next: how often it comes again, or falls.
  struct Order {
    double last = nan;
    std::size_t again = 0, falls = 0, steps = 0, same = 0;
    bool class_rises = false, class_falls = false;  // from one row to the next with the same value
  };
  std::vector<Sums> of(columns * classes);
  std::vector<Order> orders(columns);
  std::vector<double> steps(columns), pairs(columns);
  std::size_t runs = 0, last = classes;
  table.for_each([&](const DataRow& row) {
    const std::size_t before_it = std::exchange(last, row.label());
    runs += before_it != row.label() ? 1U : 0U;
    bool are_same = true;  // the columns before
    for (std::size_t i = 0; i < columns; ++i) {
      const double number = row.value(i);
      const bool numeric = table.columns[i].numeric;
      const double now = std::isnan(number) && !numeric ? missing_code : number;  // a word, too
      Order& order = orders[i];
      const double before = std::exchange(order.last, now);
      order.same += now == before ? 1U : 0U;
      order.class_rises |= now == before && row.label() > before_it;
      order.class_falls |= now == before && row.label() < before_it;
      if (are_same) {
        ++order.steps;
        order.again += now == before ? 1U : 0U;
        order.falls += now < before ? 1U : 0U;
        are_same = now == before;
      }
      if (!numeric || std::isnan(number)) continue;
      Sums& own = of[i * classes + row.label()];
      if (own.n == 0.0) {
        own.first = number;
      } else {
        steps[i] += (number - own.last) * (number - own.last);
        ++pairs[i];
      }
      const double off = number - own.first;
      ++own.n, own.sum += off, own.squares += off * off, own.last = number;
    }
  });
  std::size_t numbers = 0, smooth = 0;
  for (std::size_t i = 0; i < columns; ++i) {
    double squares = 0.0;
    for (std::size_t c = 0; c < classes; ++c)
      if (const Sums& own = of[i * classes + c]; own.n > 0.0) squares += own.squares - own.sum * own.sum / own.n;
    const Order& order = orders[i];
    const bool is_key = 20 * order.falls < order.steps && 2 * order.again > order.steps && order.steps > few_rows;
    if (pairs[i] < 10.0 * few_rows || !(squares > 0.0) || is_key) continue;
    ++numbers;
    smooth += steps[i] < lasting * squares ? 1U : 0U;
  }
  double expected = 1.0;  // runs of rows in no order
  const auto all = static_cast<double>(table.size());
  for (const std::size_t rows : table.rows_of_class)
    expected += static_cast<double>(rows) * (1.0 - static_cast<double>(rows) / all);
  // Sorted by a column, then by the class, unless all rows differ in it.
  const bool is_sorted = std::ranges::any_of(
      orders, [&](const Order& own) { return own.class_rises != own.class_falls && 2 * own.same > table.size(); });
  const bool in_runs = !is_sorted && runs > classes && 10.0 * static_cast<double>(runs) < expected;
  constexpr std::string_view too_good =
      "as in a recording: the folds part what belongs together, and the shares of right answers are too good for "
      "others; train on one part of it, and ask of another by classify, or keep its parts whole by evaluate --groups, "
      "if a column names them";
  const bool is_smooth = smooth > 1 && 2 * smooth > numbers;
  table.warn(is_smooth, "{} of {} columns of numbers change little from one row of a class to the next, {}", smooth,
             numbers, too_good);
  table.warn(in_runs && !is_smooth, "the classes of {} rows stand in {} runs only, {}", table.size(), runs, too_good);
}

/// Whether a row holds the names of the columns, the first one perhaps behind a byte order mark, as where files were
/// joined.
bool is_header(const CsvRow& row, const CsvReader& reader) {
  for (std::size_t i = 1; i < row.size(); ++i)
    if (trimmed(row[i]) != reader.names()[i]) return false;
  return trimmed(row[0]).ends_with(reader.names()[0]);
}

std::vector<ColumnReader> columns_of(const CsvReader& reader, const DataOptions& options, std::size_t label) {
  std::set<std::size_t> left_out = {label}, categorical;
  for (const auto& name : options.ignore) left_out.insert(reader.column(name));
  const bool all_categorical = options.categorical == std::vector<std::string>{"all"};
  if (!all_categorical)
    for (const auto& name : options.categorical) categorical.insert(reader.column(name));
  std::vector<ColumnReader> columns;
  for (std::size_t i = 0; i < reader.names().size(); ++i)
    if (!left_out.contains(i) && !reader.names()[i].empty())
      columns.emplace_back(i, reader.names()[i], all_categorical || categorical.contains(i));
  if (columns.empty())
    throw InputError("{}: there is no column beside {}: expected one with a feature", reader.file(),
                     in_quotes(options.label));
  return columns;
}

}  // namespace

MissingWords::MissingWords(const std::vector<std::string>& more) {
  for (const auto& text : more) more_.push_back({text, parse_number(text)});
}

bool MissingWords::operator()(std::string_view cell) {
  const std::string_view text = trimmed(cell);
  if (text.empty() || text == "?") return true;
  for (Word& word : more_)
    if (word.text == text || (word.number && word.number == parse_number(text))) return word.met = true;
  return false;
}

std::vector<std::string> MissingWords::unmet() const {
  if (std::ranges::any_of(more_, &Word::met)) return {};
  return each(more_, [](const Word& word) { return in_quotes(word.text); });
}

bool MissingWords::among_numbers(std::string_view cell) {
  constexpr std::array words = {"-", "--", ".", "none", "nil", "inf", "-inf", "+inf", "infinity", "-infinity"};
  if (operator()(cell) || says_unknown(trimmed(cell))) return true;
  return std::ranges::find(words, lower_case(trimmed(cell))) != words.end();
}

std::vector<double> ranks_of(const std::vector<double>& numbers) {
  std::vector<double> sorted;
  std::ranges::copy_if(numbers, std::back_inserter(sorted), [](double number) { return !std::isnan(number); });
  std::ranges::sort(sorted);
  return each(numbers, [&](double number) {
    const auto [first, last] = std::equal_range(sorted.begin(), sorted.end(), number);
    return std::isnan(number) ? -1.0 : static_cast<double>((first - sorted.begin()) + (last - sorted.begin()));
  });
}

DataTable read_data(const std::string& file, const DataOptions& options, bool quiet) {
  CsvReader reader = open_csv(file);
  const std::size_t label = reader.column(options.label);
  MissingWords missing(options.missing);
  auto columns = columns_of(reader, options, label);

  DataTable table;
  table.file = reader.file();
  table.label = options.label;
  Vocabulary classes;
  std::vector<std::size_t> rows_of;  // by class, as they come
  std::size_t first_line = 0, commented = 0;
  for (const auto& column : columns) table.columns.push_back({.name = column.name()});
  Progress progress("reading", reader.bytes_total().value_or(0), quiet || !reader.bytes_total());
  for (CsvRow row; reader.next(row);) {
    progress.advance(reader.bytes_read() - progress.done());
    if (trimmed(row[label]) == options.label && is_header(row, reader))
      throw row.error(label, "the name of a class, and not the header again", "drop the line");
    if (missing(row[label]))
      throw row.error(label, "the name of a class",
                      row.blank(label) ? "fill the cell or remove the row"
                                       : "which --missing says to be none: fill the cell, remove the row, or leave out "
                                         "--missing and empty the cells of other columns");
    commented += row[0].starts_with('#') ? 1U : 0U;
    const Code code = classes.code(trimmed(row[label]));
    if (classes.size() > most_values)
      throw row.error(label, fmt::format("one of at most {} classes", most_values), "choose another --label");
    rows_of.resize(classes.size());
    ++rows_of[code];
    if (first_line == 0) first_line = row.line();
    table.cells_.push_back(code);
    table.cells_.push_back(static_cast<double>(row.line()));
    for (ColumnReader& column : columns) {
      const DataCell cell = column.take(row, missing, code);
      table.cells_.push_back(cell.number);
      table.cells_.push_back(cell.code);
    }
  }
  progress.finish();
  if (table.size() == 0) throw InputError("{}: there is no row below the header", reader.file());
  std::tie(table.classes, table.class_order_) = classes.sorted();
  if (table.classes.size() == 1)
    throw InputError({.where = fmt::format("{}:{}", reader.file(), first_line),
                      .what = fmt::format("column {}", in_quotes(options.label)),
                      .found = fmt::format("{} in all of {} rows", in_quotes(table.classes.front()), table.size()),
                      .expected = "at least two classes"});
  table.rows_of_class.resize(rows_of.size());
  for (std::size_t code = 0; code < rows_of.size(); ++code)
    table.rows_of_class[table.class_order_[code]] = rows_of[code];
  for (const auto& column : columns) column.refuse_slip(table.file);
  refuse_useless(columns, table);
  table.value_order_.resize(columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    table.columns[i].numeric = columns[i].is_numeric();
    if (!columns[i].is_numeric())
      std::tie(table.columns[i].values, table.value_order_[i]) = columns[i].words().sorted();
  }
  warn_of_classes(classes, table);
  warn_of_names(reader, columns, classes, table);
  const auto unmet = missing.unmet();
  table.warn(!unmet.empty(), "no cell is {}, as --missing says: see how it is written, capitals count",
             fmt::join(unmet, " or "));
  const auto swallowed = reader.swallowed();
  table.warn(swallowed.is_doubtful(), swallowed_words, swallowed.line, swallowed.rows);
  table.warn(commented > 0 && 2 * commented < table.size(),
             "{} of {} rows begin with #: if they are to be left out, drop them", commented, table.size());
  std::vector<std::string> mostly_empty;
  for (const ColumnReader& column : columns)
    if (5 * column.filled() < table.size()) mostly_empty.push_back(in_quotes(column.name()));
  table.warn(!mostly_empty.empty(),
             "four of five cells of {} of {} columns are missing ({}): where a cell stands for those below it, too, as "
             "a merged one of a spreadsheet, fill them",
             mostly_empty.size(), columns.size(), listed(mostly_empty, 3));
  warn_of_gaps(table);
  if (!options.grouped) warn_of_order(table);
  warn_of_repeats(table);
  for (const ColumnReader& column : columns) column.warn(table);
  return table;
}

}  // namespace sigmax::apps
