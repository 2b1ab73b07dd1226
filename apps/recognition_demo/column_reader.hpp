#pragma once

#include "recognition_demo/data_table.hpp"
#include "support/nines.hpp"

namespace sigmax::apps {

/// Among fewer rows it is no wonder that all values differ.
inline constexpr std::size_t few_rows = 20;

/// What to say of two words that are alike.
inline constexpr const char* alike_words =
    ": {} differ in case, blanks, Unicode forms or the writing of a number only, and count as two; write them alike, "
    "if they are the "
    "same";

/// Words beyond this many are names of things, not values of a feature.
inline constexpr std::size_t most_values = 4096;

/// Words numbered as they come.
struct Vocabulary {
  std::map<std::string, Code, std::less<>> codes;

  Code code(std::string_view word) {
    const auto found = codes.find(word);
    if (found != codes.end()) return found->second;
    return codes.emplace(std::string(word), static_cast<Code>(codes.size())).first->second;
  }
  std::size_t size() const { return codes.size(); }
  bool contains(std::string_view word) const { return codes.contains(word); }
  std::size_t numbers() const;

  /// Two words that differ in their writing only, see `apps::alike`.
  std::string alike() const;

  /// The words in order, numbers first and by their value, and for each code the place of its word.
  std::pair<std::vector<std::string>, std::vector<Code>> sorted() const;
};

/// A cell as a number, NaN if it is none, and as a word, `missing_code` if it is none or there are too many.
struct DataCell {
  double number = nan;
  Code code = missing_code;
};

/// A column while it is read: numeric until a cell is not, and then the words are what counts. It keeps what there is
/// to ask about the column in the end.
class ColumnReader {
 public:
  /// The column with this place and this name in the file.
  ColumnReader(std::size_t index, std::string name, bool categorical)
      : index_(index), name_(std::move(name)), categorical_(categorical) {}

  DataCell take(const CsvRow& row, MissingWords& missing, Code its_class);

  /// Throws if the column is neither numbers nor words.
  void refuse_slip(const std::string& file) const;

  const std::string& name() const { return name_; }
  bool is_numeric() const { return could_be_numeric() && numeric_cells_ > 0; }
  const Vocabulary& words() const { return words_; }

  /// How many cells have a number, or a word that does not stand for a missing one.
  std::size_t filled() const { return cells_; }

  /// Whether the name of the column looks like one of its cells.
  bool is_named_as_a_cell() const;

  /// What there is to see, if it is not two different values: "'red'", or "no value".
  std::string lone_value() const;

  /// Tells the table what the values of the column tell, and how they are written.
  void warn(DataTable& table) const;

 private:
  static constexpr std::size_t most_units = 8, few_words = 8, few_slips = 5, most_ranges = 30;

  /// Whether it seems to name the rows: by words most of which stand once, or by whole numbers that rise.
  bool names_rows() const;

  /// Whether most cells, of more than a few different ones, are a number and one of few words.
  bool holds_units() const;

  /// A cell of those without letters that are no plain number, if most are so and more than a few differ; or nothing.
  std::string notation() const;

  /// A word of those of which nine in ten are several numbers with the same between them, as 15x22 or 120/80, and that
  /// are no dates and no times; or nothing.
  std::string several_numbers() const;

  /// "3.1 and 3.10", which are one number and may be two versions, if there are such and not many others, or two of
  /// more digits than a number tells; or nothing.
  std::string one_number() const;

  /// What the classes are of the rows that have the same value.
  struct ByValue {
    std::size_t values = 0, rows = 0, others = 0;  ///< rows of another class than the first of their value
    std::size_t changes = 0;                       ///< of the class, in the order of the values
    double log_chance = 0.0;                       ///< that so many rows are of one class with theirs
    bool numeric = false, whole = false;

    bool tells_all(std::size_t classes) const;
    bool may_be_groups(std::size_t classes) const;
    /// Whether the class changes as often as where the order of the values tells nothing of it.
    bool changes_by_chance(const std::vector<std::size_t>& rows_of_class) const;
    static constexpr std::size_t fewest_groups = 8;
  };
  ByValue by_value(const std::vector<std::size_t>& rows_of_class) const;

  /// The same of words without what is behind their last separator, or without their last number: S07 of S07_3.
  ByValue by_stem(const std::vector<std::size_t>& rows_of_class) const;

  void see_whole(double number);
  bool is_run() const;
  void see_writing(std::string_view cell);
  bool could_be_numeric() const { return !categorical_ && !slip_; }
  bool nearly_all_numbers() const;

  /// A word among numbers, where it was found first.
  struct Slip {
    std::size_t line;
    std::string word;
  };
  struct ClassesOfValue {
    Code first;
    std::size_t same = 0, others = 0;  // rows of that class, and of others

    void add(Code its_class, std::size_t rows = 1) { (first == its_class ? same : others) += rows; }
  };
  ByValue summed(const std::vector<ClassesOfValue>& classes, const std::vector<std::size_t>& rows_of_class) const;

  std::size_t index_;
  std::string name_;
  bool categorical_;
  std::optional<Slip> slip_;
  std::set<std::string> slips_{};  // different ones with a digit, some
  std::size_t cells_ = 0, numeric_cells_ = 0, comma_cells_ = 0, unit_cells_ = 0, limit_cells_ = 0, notations_ = 0;
  bool whole_ = true;  // all numbers are
  double first_ = 0.0, low_ = 0.0, high_ = 0.0;
  double sum_ = 0.0, squares_ = 0.0;  // of the distances from the first
  Nines nines_{true};
  std::string three_digits_, with_zeros_, notation_, exponent_;  // the first of these
  std::size_t hundreds_ = 0, nothings_ = 0, exponents_ = 0;      // hundreds of three digits
  bool leading_zeros_ = false;                                   // of numbers with a unit, as in 055xx
  bool other_writing_ = false;
  std::set<std::size_t> lengths_;        // of whole numbers, 0 of others, up to two
  std::vector<ClassesOfValue> classes_;  // by code
  bool counts_ = true;                   // so far, in whole numbers upwards, or by even steps
  double step_ = nan;                    // the first one
  double last_ = -std::numeric_limits<double>::infinity();
  bool too_many_words_ = false;
  Vocabulary words_, units_;
  std::map<double, std::size_t> left_out_;  // numbers that count as missing, and how often
};

/// Whether it would be a number if its comma were a point.
bool has_decimal_comma(std::string_view word);

/// Whether a word says that a value is not known, as NA does.
bool says_unknown(std::string_view word);

}  // namespace sigmax::apps
