#include "recognition_demo/column_reader.hpp"

#include <array>
#include <cctype>
#include <cmath>
#include <numeric>

#include "support/text.hpp"

namespace sigmax::apps {

bool has_decimal_comma(std::string_view word) {
  std::string number(word);
  const auto comma = number.find(',');
  if (comma != std::string::npos) number[comma] = '.';
  return comma != std::string::npos && parse_number(number);
}

namespace {

/// The word behind a number, as in "23.93 kg", or before it, as in "$12.50" or "<0.1"; or nothing.
std::string_view unit_of(std::string_view cell) {
  constexpr std::string_view of_numbers = "+-.,0123456789";
  const auto begin = std::min(cell.find_first_of(of_numbers), cell.size());
  const auto end = std::min(cell.find_first_not_of(of_numbers, begin), cell.size());
  const std::string_view before = trimmed(cell.substr(0, begin)), after = trimmed(cell.substr(end));
  const bool is_sign = std::ranges::none_of(before, [](unsigned char letter) { return std::isalpha(letter) != 0; });
  const std::string_view number = cell.substr(begin, end - begin);
  const auto point = number.find_first_of(".,");  // S12, v1.2 and I21.4 are names, and EUR 12.50 is none
  const bool is_letter = begin == 1 && before.size() == 1;
  const bool is_amount = is_sign || (!is_letter && point != number.npos && point > 0 && point + 1 < number.size());
  const bool alone = (before.empty() || after.empty()) && is_amount && after.find_first_of("0123456789") == after.npos;
  constexpr std::array no_units = {"'", "=", "~", "*", "−", "\u00A0", "\u202F"};
  if (std::ranges::find(no_units, before.empty() ? after : before) != no_units.end()) return "";
  return alone && (parse_number(number) || has_decimal_comma(number)) ? (before.empty() ? after : before) : "";
}

/// Whether a word has digits and no letters, as 1,000.00 or 12.03.2024, or is a number as 1.5D+01 or 0x1F.
bool is_notation(std::string_view word) {
  std::string other(word);
  if (const auto exponent = other.find_first_of("Dd"); exponent != other.npos) other[exponent] = 'E';
  if (parse_number(other) ||
      (word.starts_with("0x") && word.find_first_not_of("0123456789abcdefABCDEF", 2) == word.npos))
    return true;
  const auto has = [&](auto kind) { return std::ranges::any_of(word, [&](unsigned char c) { return kind(c) != 0; }); };
  return has([](int c) { return std::isdigit(c); }) && !has([](int c) { return std::isalpha(c); });
}

/// Whether it is one number up to a greater one, as 55-59.
bool is_range(std::string_view word) {
  const auto dash = word.find('-');
  const auto from = parse_number(word.substr(0, dash));
  const auto to = dash == word.npos ? std::nullopt : parse_number(word.substr(dash + 1));
  return from && to && *from < *to;
}

/// Whether points part thousands, as in 1.543.180.
bool has_thousands(std::string_view word) {
  bool whole = std::ranges::count(word, '.') > 1 && is_notation(word);
  for (std::size_t at = word.rfind('.'), k = 0; whole && at != word.npos && at > 0; at = word.rfind('.', at - 1), ++k)
    whole = word.size() - at == 4 * (k + 1);
  return whole;
}

/// Whether it says that a value is beyond what could be measured.
bool is_limit(std::string_view unit) { return unit == "<" || unit == ">" || unit == "≤" || unit == "≥"; }

}  // namespace

bool says_unknown(std::string_view word) {
  constexpr std::array words = {"na", "n/a", "n.a.", "#n/a", "<na>", "nan", "nat", "null", "(null)", "\\n", "#div/0!"};
  return std::ranges::find(words, lower_case(word)) != words.end();
}

std::size_t Vocabulary::numbers() const {
  const auto is_number = [](const auto& word) { return parse_number(word.first).has_value(); };
  return static_cast<std::size_t>(std::ranges::count_if(codes, is_number));
}

std::string Vocabulary::alike() const {
  return apps::alike(each(codes, [](const auto& word) { return std::string_view(word.first); }));
}

std::pair<std::vector<std::string>, std::vector<Code>> Vocabulary::sorted() const {
  std::vector<std::tuple<double, std::string, Code>> order;  // by value, words behind all numbers
  for (const auto& [word, code] : codes)
    order.emplace_back(parse_number(word).value_or(std::numeric_limits<double>::infinity()), word, code);
  std::ranges::sort(order);
  std::vector<std::string> words;
  std::vector<Code> places(order.size());
  for (const auto& [number, word, code] : order) {
    places[code] = static_cast<Code>(words.size());
    words.push_back(word);
  }
  return {std::move(words), std::move(places)};
}

DataCell ColumnReader::take(const CsvRow& row, MissingWords& missing, Code its_class) {
  const std::string_view cell = trimmed(row[index_]);
  const bool empty = missing(cell);
  const auto number = empty ? std::nullopt : parse_number(cell);
  if (const auto none = empty ? parse_number(cell) : std::nullopt) ++left_out_[*none];
  const bool is_word = !empty && !number && !missing.among_numbers(cell);
  if (number || is_word) ++cells_;
  if (number) {
    ++numeric_cells_;
    nines_.see(cell, *number);
    see_whole(*number);
    see_writing(cell);
  } else if (lower_case(cell) == "none" && !is_word) {
    ++nothings_;
  }
  if (std::isnan(step_) && std::isfinite(last_) && number) step_ = *number - last_;
  const bool even = std::isnan(step_) || (number && std::abs(*number - last_ - step_) <= 1e-6 * step_);
  counts_ = counts_ && number && (*number == std::floor(*number) || even) && *number > last_;
  last_ = number.value_or(last_);
  if (is_word && !slip_) slip_ = Slip{row.line(), std::string(cell)};
  if (is_word && slips_.size() <= few_slips && cell.find_first_of("0123456789") != cell.npos) slips_.emplace(cell);
  if (is_word && has_decimal_comma(cell)) ++comma_cells_;
  if (const auto unit = is_word ? unit_of(cell) : ""; !unit.empty()) {
    ++(is_limit(unit) ? limit_cells_ : unit_cells_);
    leading_zeros_ |= cell.size() > 1 && cell[0] == '0' && std::isdigit(static_cast<unsigned char>(cell[1])) != 0;
    if (!is_limit(unit) && units_.size() <= most_units) units_.code(unit);
  } else if (is_word && is_notation(cell) && notations_++ == 0) {
    notation_ = cell;
  }
  DataCell result{number.value_or(nan)};
  if (too_many_words_) return result;
  if (!empty) {
    result.code = words_.code(cell);
    if (result.code == classes_.size()) classes_.push_back({its_class});
    classes_[result.code].add(its_class);
  }
  if (words_.size() <= most_values) return result;
  too_many_words_ = true;
  if (!could_be_numeric() && !nearly_all_numbers())
    throw row.error(index_, fmt::format("one of at most {} different values", most_values),
                    holds_units() ? "write the numbers without their unit" : "leave the column out by --ignore");
  return result;
}

void ColumnReader::refuse_slip(const std::string& file) const {
  if (categorical_ || !slip_ || !(too_many_words_ || nearly_all_numbers())) return;
  const auto refuse = [&](std::string_view expected, std::size_t cells, std::string_view remedy) {
    throw InputError({.where = fmt::format("{}:{}", file, slip_->line),
                      .what = fmt::format("column {}", in_quotes(name_)),
                      .found = in_quotes(slip_->word),
                      .expected = fmt::format("{}, as {} of {} cells have", expected, cells, cells_),
                      .remedy = std::string(remedy)});
  };
  if (comma_cells_ > numeric_cells_)
    refuse("no comma in a number", comma_cells_,
           "write a decimal comma as a point, and leave out one between thousands");
  if (is_limit(unit_of(slip_->word)) || slip_->word.starts_with('<'))
    refuse("a number", numeric_cells_,
           "write one for what is beyond a limit, as the limit itself; as a missing value it would tell nothing");
  if (has_thousands(slip_->word) || (is_notation(slip_->word) && !has_decimal_comma(slip_->word) &&
                                     slip_->word.find_first_of(",' ") != std::string::npos))
    refuse("a plain number", numeric_cells_, "leave out what parts thousands, and write a decimal comma as a point");
  if (!unit_of(slip_->word).empty())
    refuse("a number", numeric_cells_,
           "write the numbers alone, all in one unit, and the unit into the name of the column");
  if (slips_.size() > few_slips)  // what stands for no value comes again
    refuse("a plain number", numeric_cells_,
           fmt::format(
               "write it, and all others that are written so, as plain numbers: -0.05 for (0.05) or 0.05-, and one "
               "for a range; names, as of tickets, go by --categorical {0}, or --ignore {0}",
               typed(name_)));
  refuse("a number with a decimal point", numeric_cells_,
         fmt::format("correct it, drop the line if it is none of data, name it by --missing={}, or take the column as "
                     "words by --categorical {}",
                     typed(slip_->word), typed(name_)));
}

bool ColumnReader::is_named_as_a_cell() const {
  return is_numeric() ? parse_number(name_).has_value() : words_.contains(trimmed(name_));
}

std::string ColumnReader::lone_value() const {
  if (too_many_words_ || words_.size() > 1) return "";
  return words_.size() == 0 ? "no value" : in_quotes(words_.codes.begin()->first);
}

bool ColumnReader::names_rows() const {
  if (cells_ < few_rows) return false;
  return is_numeric() ? counts_ || is_run()
                      : !too_many_words_ && !holds_units() && notation().empty() && several_numbers().empty() &&
                            limit_cells_ == 0 && 2 * words_.size() > cells_;
}

std::string ColumnReader::notation() const {
  const bool are_most = !categorical_ && words_.size() > few_words && 2 * notations_ > cells_;
  const bool are_few_ranges = words_.size() <= most_ranges &&
                              std::ranges::all_of(words_.codes, [](const auto& word) { return is_range(word.first); });
  return are_most && !are_few_ranges && !holds_units() && several_numbers().empty() ? notation_ : "";
}

std::string ColumnReader::several_numbers() const {
  if (categorical_ || too_many_words_ || words_.size() <= few_words) return "";
  std::map<std::string, std::pair<std::size_t, std::string>> forms;  // # is a number
  std::set<std::string_view> tails;                                  // behind the first number: of a unit they are few
  for (const auto& [word, code] : words_.codes) {
    std::string form;
    for (const char c : word)
      if (std::isdigit(static_cast<unsigned char>(c)) == 0)
        form += c;
      else if (!form.ends_with('#'))
        form.ends_with("#.") ? form.pop_back() : form.push_back('#');
    tails.insert(std::string_view(word).substr(std::min(word.find_first_not_of("0123456789."), word.size())));
    auto& [count, first] = forms[form];
    if (count++ == 0) first = word;
  }
  const auto& [form, found] = *std::ranges::max_element(forms, {}, [](const auto& one) { return one.second.first; });
  const bool is_one = form.find_first_not_of("#: '") == form.npos || form == "#/#/#" || tails.size() <= few_words;
  const bool is_name = !form.starts_with('#') || form.find_first_of("-_.,+") != form.npos;
  const bool are_most = 10 * found.first >= 9 * words_.size();
  return are_most && !is_one && !is_name && std::ranges::count(form, '#') > 1 ? found.second : "";
}

std::string ColumnReader::one_number() const {
  constexpr std::size_t most = 100;
  if (!is_numeric() || too_many_words_) return "";
  std::string_view before;
  for (const auto& [word, code] : words_.codes) {
    const std::string_view last = std::exchange(before, word);
    constexpr std::size_t all_told = 15;  // digits, of a number in double precision
    const auto point = word.find('.');
    if (point == word.npos && word.size() > all_told && parse_number(word) == parse_number(last))
      return fmt::format("{} and {}", last, word);
    if (words_.size() > most) continue;
    const auto without = word.find_last_not_of('0');
    if (point == word.npos || without == word.npos || without <= point || without + 1 == word.size()) continue;
    if (const std::string other = word.substr(0, without + 1); words_.contains(other))
      return fmt::format("{} and {}", other, word);
  }
  return "";
}

bool ColumnReader::holds_units() const {
  // Seats and diagnoses have letters, too: 12A, C50.
  const auto units = units_.sorted().first;
  const bool are_letters = units.size() > 2 && std::ranges::all_of(units, [](const std::string& unit) {
                             return unit.size() == 1 && unit[0] >= 'A' && unit[0] <= 'Z';
                           });
  return !are_letters && !categorical_ && !leading_zeros_ && words_.size() > few_words && 2 * unit_cells_ > cells_ &&
         units_.size() <= most_units;
}

bool ColumnReader::ByValue::tells_all(std::size_t classes) const {
  const bool few = values < fewest_groups && rows >= 2 * values;
  return others == 0 && rows >= few_rows && values >= classes && (few || (numeric && changes + 1 == classes));
}

bool ColumnReader::ByValue::may_be_groups(std::size_t classes) const {
  constexpr double by_no_chance = -14.0;
  if (values < fewest_groups || values < 2 * classes || rows < 2 * values || log_chance > by_no_chance) return false;
  if (numeric && 4 * changes < values) return false;
  if (numeric && !whole && (others > 0 || rows < 5 * values)) return false;  // as coarse ones of a quantity may be
  return others == 0 || (20 * others < rows && rows < 30 * values);
}

bool ColumnReader::ByValue::changes_by_chance(const std::vector<std::size_t>& rows_of_class) const {
  const double all = std::accumulate(rows_of_class.begin(), rows_of_class.end(), 0.0), n = static_cast<double>(values);
  double other = 1.0;
  for (const std::size_t of_class : rows_of_class) other -= std::pow(static_cast<double>(of_class) / all, 2);
  return static_cast<double>(changes) >= n * other - 2.5 * std::sqrt(n * other * (1.0 - other));
}

ColumnReader::ByValue ColumnReader::by_value(const std::vector<std::size_t>& rows_of_class) const {
  if (too_many_words_) return {};
  ByValue result = summed(classes_, rows_of_class);
  const auto places = words_.sorted().second;
  std::vector<Code> in_order(classes_.size());
  for (std::size_t code = 0; code < classes_.size(); ++code) in_order[places[code]] = classes_[code].first;
  for (std::size_t k = 1; k < in_order.size(); ++k) result.changes += in_order[k] != in_order[k - 1] ? 1U : 0U;
  return result;
}

ColumnReader::ByValue ColumnReader::by_stem(const std::vector<std::size_t>& rows_of_class) const {
  if (too_many_words_ || is_numeric()) return {};
  std::map<std::string_view, ClassesOfValue> stems;
  for (const auto& [word, code] : words_.codes) {
    auto end = word.find_last_of("_-. ");
    if (end == word.npos || end == 0) end = word.find_last_not_of("0123456789") + 1;
    if (end == 0 || code >= classes_.size()) return {};
    const auto& [first, same, others] = classes_[code];
    auto& own = stems.try_emplace(std::string_view(word).substr(0, end), ClassesOfValue{first}).first->second;
    own.add(first, same);
    own.others += others;
  }
  return summed(each(stems, [](const auto& stem) { return stem.second; }), rows_of_class);
}

ColumnReader::ByValue ColumnReader::summed(const std::vector<ClassesOfValue>& classes,
                                           const std::vector<std::size_t>& rows_of_class) const {
  ByValue result{.values = classes.size(), .numeric = is_numeric(), .whole = whole_};
  const double all = std::accumulate(rows_of_class.begin(), rows_of_class.end(), 0.0);
  for (const auto& [first, same, others] : classes) {
    result.rows += same + others;
    result.others += others;
    double alike = 0.0;
    for (const std::size_t rows : rows_of_class)
      alike += std::pow(static_cast<double>(rows) / all, static_cast<double>(same));
    result.log_chance += std::log(alike);
  }
  return result;
}

void ColumnReader::warn(DataTable& table) const {
  const auto say = [&](bool holds, const std::string& format, const auto&... words) {
    table.warn_of(name_, holds, format, words...);
  };
  const std::string for_typing = typed(name_);
  const ByValue values = by_value(table.rows_of_class);
  const bool tells_all = values.tells_all(table.classes.size());
  say(tells_all,
      " alone tells the class of each row{}: if it is not known before the class is, leave it out by --ignore {}",
      cells_ < table.size() ? " that has a value" : "", for_typing);
  const bool is_name = names_rows(), are_numbers = categorical_ && numeric_cells_ == cells_;
  const ByValue groups = is_name ? by_stem(table.rows_of_class) : values;
  table.warn(!tells_all && !table.has_copies && groups.may_be_groups(table.classes.size()),
             "each of {} values of column {}, of {:.2g} rows on the average, is of one class only{}: if it names what "
             "rows are of, as a patient or a session, these are parted by the folds, and the shares of right answers "
             "are too good for others, also without it (--ignore {}): keep the rows of each together by {}",
             groups.values, in_quotes(name_) + (is_name ? ", without their last part" : ""),
             static_cast<double>(groups.rows) / static_cast<double>(groups.values),
             groups.others == 0 ? "" : fmt::format(", but for {} of them", groups.others), for_typing,
             is_name ? "a column without that part, and evaluate --groups" : "evaluate --groups " + for_typing);
  say(is_name && are_numbers,
      " holds numbers, most of which stand once, so that --categorical {} leaves little to learn: take them as numbers",
      for_typing);
  say(is_name && !are_numbers && (!is_numeric() || counts_ || values.changes_by_chance(table.rows_of_class)),
      " seems to name the rows, or to count them, and tells nothing of others, unless they are in its order; leave it "
      "out by --ignore {}",
      for_typing);
  say(name_.starts_with("Unnamed: "),
      " is called as pandas calls the numbers of rows that it wrote: if it is these, leave it out by --ignore {}",
      for_typing);
  if (is_numeric()) {
    const std::string nines = nines_.doubt(name_), two = one_number();
    const bool are_powers = exponents_ == numeric_cells_;
    table.warn(!nines.empty() && !are_powers, "{}; where it says something, as never, that is lost so", nines);
    say(are_powers && numeric_cells_ >= few_rows,
        " holds numbers times powers of ten, as {}: if they are names, as of places, give --categorical {}", exponent_,
        for_typing);
    say(!three_digits_.empty() && hundreds_ > 0 && numeric_cells_ >= few_rows && !other_writing_,
        ": every number with a point has three digits behind it, as {}, and all others are below a thousand: if the "
        "point parts thousands, leave it out",
        three_digits_);
    say(lengths_.size() == 1 && !with_zeros_.empty(),
        " holds codes, as {}, that are read as numbers: if their order tells nothing, give --categorical {}",
        with_zeros_, for_typing);
    say(!two.empty(), ": {} are read as one number: if they are names, as of versions or things, give --categorical {}",
        two, for_typing);
    const auto inside =
        std::ranges::find_if(left_out_, [&](const auto& one) { return low_ < one.first && one.first < high_; });
    if (inside != left_out_.end())
      say(true,
          ": {} cells count as missing by --missing, as {}, which is among its other numbers: where it is one of "
          "these, leave out --missing and empty the cells of the column that it was meant for",
          inside->second, shortest(inside->first));
    say(nothings_ > 0 && 20 * nothings_ >= cells_,
        ": {} cells are 'none', which counts as missing among numbers: if it says zero, write 0", nothings_);
    return;
  }
  const std::string alike = words_.alike(), notation = this->notation(), several = several_numbers();
  say(!alike.empty(), alike_words, alike);
  const std::string units = fmt::format("{}", fmt::join(units_.sorted().first, ", "));
  say(holds_units(),
      " holds numbers with a unit ({}), which count as words: write the numbers alone, all in one unit, and the unit "
      "into the name of the column{}",
      units, units == "E, W" || units == "N, S" ? ", those of S and W with a minus sign" : "");
  say(!several.empty(), " holds several numbers in a cell, as {}: give each a column, or write one number for all",
      in_quotes(several));
  say(!notation.empty(),
      " holds no plain numbers, as {}, which count as words: where they are numbers, times or dates, write them as {}, "
      "in seconds or days",
      in_quotes(notation), notation.starts_with("−") ? "-1234.5, with the minus of a keyboard" : "1234.5");
  say(limit_cells_ > 0 && words_.numbers() > 1,
      " holds numbers and {} limits, as <0.1, and all count as words: write a number for what is beyond a limit, as "
      "the limit itself",
      limit_cells_);
  const std::string slip = slip_ ? slip_->word : "";
  const bool are_some = !categorical_ && slip_ && words_.numbers() > few_words && 10 * numeric_cells_ > cells_;
  say(are_some && !holds_units() && notation.empty() && limit_cells_ == 0,
      ": {} of {} cells are numbers, and count as words, since others are none, as {}: where such stand for no number, "
      "give --missing={}; where they say that it is below a limit, write the limit",
      numeric_cells_, cells_, in_quotes(slip), typed(slip));
  std::size_t unknowns = 0;
  std::string unknown;  // the first such word
  for (const auto& [word, code] : words_.codes)
    if (code < classes_.size() && says_unknown(word)) {
      unknowns += classes_[code].same + classes_[code].others;
      if (unknown.empty()) unknown = word;
    }
  say(unknowns > 0,
      ": {} of {} rows hold {}, which counts as a value among words: if it stands for no value, give --missing={}",
      unknowns, table.size(), in_quotes(unknown), typed(unknown));
}

void ColumnReader::see_whole(double number) {
  if (numeric_cells_ == 1) first_ = low_ = high_ = number;
  low_ = std::min(low_, number);
  high_ = std::max(high_, number);
  sum_ += number - first_;
  squares_ += (number - first_) * (number - first_);
  whole_ = whole_ && number == std::floor(number);
}

/// Whether the cells are whole numbers one after another, each once, in any order, by their sum and squares.
bool ColumnReader::is_run() const {
  const auto n = static_cast<double>(cells_);
  const double a = low_ - first_, sum = n * a + n * (n - 1) / 2;
  const double squares = n * a * a + a * n * (n - 1) + (n - 1) * n * (2 * n - 1) / 6;
  return whole_ && numeric_cells_ == cells_ && high_ - low_ + 1 == n && std::abs(sum_ - sum) <= 1e-9 * std::abs(sum) &&
         std::abs(squares_ - squares) <= 1e-9 * squares;
}

void ColumnReader::see_writing(std::string_view cell) {
  const bool is_signed = cell.starts_with('-');
  const std::string_view bare = cell.substr(is_signed ? 1 : 0);
  const auto point = bare.find('.');
  const std::size_t digits = point == bare.npos ? bare.size() : point;
  const bool is_plain = bare.find_first_not_of(".0123456789") == bare.npos;
  const bool parts = point != bare.npos && bare.size() - point == 4 && digits <= 3 && bare[0] != '0';
  if (parts && three_digits_.empty()) three_digits_ = cell;
  if (point == bare.npos && digits == 3) ++hundreds_;
  const auto letter = bare.find_first_of("Ee");
  if (letter < bare.size() - 1 && point == bare.npos && std::isdigit(static_cast<unsigned char>(bare[letter + 1])) != 0)
    if (++exponents_ == 1) exponent_ = cell;
  other_writing_ = other_writing_ || !is_plain || !(parts || (point == bare.npos && digits <= 3));
  if (lengths_.size() < 2) lengths_.insert(is_plain && !is_signed && point == bare.npos ? bare.size() : 0);
  if (with_zeros_.empty() && digits >= 3 && bare[0] == '0') with_zeros_ = cell;
}

/// Nine of ten cells, be it with a decimal comma, or half of them where there are more numbers than words would have.
bool ColumnReader::nearly_all_numbers() const {
  constexpr std::size_t most_words = 20;
  if (10 * (numeric_cells_ + comma_cells_) >= 9 * cells_) return true;
  return 2 * numeric_cells_ >= cells_ && words_.numbers() > most_words;
}

}  // namespace sigmax::apps
