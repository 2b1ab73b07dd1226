#include <sigmax/core/network/bif.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <istream>
#include <map>
#include <optional>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "solve.hpp"

namespace sigmax {
namespace {

/// A view of its place in the text of the file, with its quotation marks if it has any; empty at the end of the file.
/// Between tokens the format ignores "," and "|" as it does blanks and comments.
using Token = std::string_view;

constexpr Token signs = "{}()[];", ignored = " \t\r\n\v\f,|";
bool has(Token characters, char c) { return characters.find(c) != Token::npos; }

Token text_of(Token token) { return token.starts_with('"') ? token.substr(1, token.size() - 2) : token; }
std::string in_quotes(Token text) { return "'" + std::string(text) + "'"; }

class Reader {
 public:
  Reader(std::istream& in, std::string_view file) : text_(contents(in)), file_(file), rest_(text_) {
    if (in.bad() || (text_.empty() && in.fail())) fail(rest_, "expected a network, found that nothing can be read");
    if (rest_.starts_with("\x1F\x8B")) fail(rest_, "expected text, found compressed data: unpack it by gunzip");
    if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);  // a byte-order mark
    take();
  }

  RelationNetwork read() {
    expect("network");
    word("the name of the network");
    expect("{");
    while (next_ != "}") property("'property' or '}'");
    expect("}");
    while (!next_.empty()) {
      if (next_ == "variable") {
        variable();
      } else if (next_ == "probability") {
        probability();
      } else {
        refuse("'variable' or 'probability'");
      }
    }
    if (blocks_.empty()) refuse("'variable'");
    return network();
  }

 private:
  struct Block {
    Token name;
    RandomVariable variable;
    std::optional<Token> table;  ///< of its probability block, once there is one
    std::vector<std::size_t> parents;
    std::vector<std::vector<double>> rows;
  };

  static constexpr std::size_t greatest_table = std::size_t{1} << 22;

  static std::string contents(std::istream& in) {
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }

  /// The number of the line where a token begins.
  std::string line_of(Token token) const { return std::to_string(1 + std::count(text_.data(), token.data(), '\n')); }

  /// Throws: something is wrong with a line.
  [[noreturn]] void fail(Token at, const std::string& what) const {
    throw std::invalid_argument(file_ + ":" + line_of(at) + ": " + what);
  }

  /// Throws: what comes next is not what is expected.
  [[noreturn]] void refuse(const std::string& expected) const {
    fail(next_,
         "expected " + expected + ", found " + (next_.empty() ? "the end of the file" : in_quotes(text_of(next_))));
  }

  void skip(std::size_t count) { rest_.remove_prefix(std::min(count, rest_.size())); }

  Token scan() {
    for (bool skipped = true; skipped && !rest_.empty();) {
      if (rest_.starts_with("//")) {
        skip(rest_.find('\n'));
      } else if (rest_.starts_with("/*")) {
        const std::size_t close = rest_.find("*/", 2);
        if (close == Token::npos) fail(rest_, "expected '*/' after '/*', found the end of the file");
        skip(close + 2);
      } else if ((skipped = has(ignored, rest_.front()))) {
        skip(1);
      }
    }
    std::size_t size = std::min<std::size_t>(rest_.size(), 1);
    if (rest_.starts_with('"')) {
      size = rest_.find('"', 1) + 1;
      if (size == 0) fail(rest_, "expected '\"' at the end of a name, found the end of the file");
    } else if (size > 0 && !has(signs, rest_.front())) {
      const auto goes_on = [](Token rest) {
        return !has(signs, rest.front()) && !has(ignored, rest.front()) && !rest.starts_with("//") &&
               !rest.starts_with("/*");
      };
      while (size < rest_.size() && goes_on(rest_.substr(size))) ++size;
    }
    const Token token = rest_.substr(0, size);
    skip(size);
    return token;
  }

  Token take() { return std::exchange(next_, scan()); }

  /// Takes a token that must be this one.
  void expect(Token text) {
    if (next_ != text) refuse(in_quotes(text));
    take();
  }
  Token word(const std::string& meaning) {
    if (next_.empty() || has(signs, next_.front())) refuse(meaning);
    return take();
  }

  void property(const std::string& expected) {
    if (next_ != "property") refuse(expected);
    while (next_ != ";") {
      if (next_.empty()) refuse("';' after a property");
      take();
    }
    take();
  }

  void variable() {
    take();
    const Token name = word("the name of a variable");
    const std::string text(text_of(name));
    if (index_.contains(text)) fail(name, "variable '" + text + "' is declared twice");
    expect("{");
    std::optional<std::vector<std::string>> labels;
    while (next_ != "}") {
      if (next_ == "type" && !labels) {
        labels = outcomes();
      } else {
        property(labels ? "'property' or '}'" : "'type' or 'property'");
      }
    }
    if (!labels) refuse("'type'");
    take();
    try {
      blocks_.push_back({name, RandomVariable{text, std::move(*labels)}, {}, {}, {}});
    } catch (const std::invalid_argument& error) {
      fail(name, error.what());
    }
    index_.emplace(text, blocks_.size() - 1);
  }

  std::vector<std::string> outcomes() {
    take();
    expect("discrete");
    expect("[");
    const Token count = word("the number of outcomes");
    expect("]");
    expect("{");
    std::vector<std::string> labels;
    while (next_ != "}") labels.emplace_back(text_of(word("an outcome or '}'")));
    const std::string found = std::to_string(labels.size());
    if (found != text_of(count))
      fail(count, "expected as many outcomes as the number says, found " + in_quotes(text_of(count)) + " and " + found +
                      " outcomes");
    take();
    expect(";");
    return labels;
  }

  std::size_t declared(const std::string& meaning) {
    const Token name = word(meaning);
    const auto found = index_.find(text_of(name));
    if (found == index_.end()) fail(name, "expected " + meaning + ", found " + in_quotes(text_of(name)));
    return found->second;
  }

  void probability() {
    const Token start = take();
    expect("(");
    Block& block = blocks_[declared("the name of a declared variable")];
    const std::string name = in_quotes(block.variable.name());
    if (block.table) fail(start, "variable " + name + " has a probability already, in line " + line_of(*block.table));
    block.table = start;
    std::size_t rows = 1;
    while (next_ != ")") {
      block.parents.push_back(declared("the name of a declared variable or ')'"));
      rows *= blocks_[block.parents.back()].variable.size();
      if (rows * block.variable.size() > greatest_table)
        fail(start, "the table of " + name + " has more than " + std::to_string(greatest_table) + " numbers");
    }
    take();
    expect("{");
    block.rows.resize(rows);
    std::vector<double> otherwise;
    while (next_ != "}") {
      if (next_ == "table") {
        table(block);
      } else if (next_ == "default") {
        take();
        otherwise = row(block);
      } else if (next_ == "(") {
        entry(block);
      } else {
        property("'table', 'default', '(', 'property' or '}'");
      }
    }
    for (std::size_t r = 0; r < rows; ++r) {
      if (block.rows[r].empty()) block.rows[r] = otherwise;
      if (block.rows[r].empty()) refuse("a row for " + condition(block, r) + " or 'default'");
    }
    take();
  }

  /// "(young, calm)": the outcomes of the parents in one row, the last fastest.
  std::string condition(const Block& block, std::size_t row) const {
    return "(" + labels_of_row(parents_of(block), row) + ")";
  }

  std::vector<NetworkVariable> parents_of(const Block& block) const {
    std::vector<NetworkVariable> parents;
    for (const std::size_t parent : block.parents) parents.emplace_back(blocks_[parent].variable);
    return parents;
  }

  void entry(Block& block) {
    const Token start = take();
    std::size_t index = 0;
    for (const std::size_t parent : block.parents) {
      const auto& variable = blocks_[parent].variable;
      const Token label = word("an outcome of " + in_quotes(variable.name()));
      try {
        index = index * variable.size() + variable.index_of(text_of(label));
      } catch (const std::invalid_argument& error) {
        fail(label, error.what());
      }
    }
    expect(")");
    if (!block.rows[index].empty()) fail(start, "the row for " + condition(block, index) + " is given twice");
    block.rows[index] = row(block);
  }

  double number() {
    const Token token = word("a number"), text = text_of(token);
    double value = 0.0;
    const auto read = std::from_chars(text.begin(), text.end(), value);
    if (read.ec != std::errc{} || read.ptr != text.end() || !(value >= 0.0 && value <= 1.0 + bif_tolerance))
      fail(token, "expected a number between 0 and 1, found " + in_quotes(text));
    return value;
  }

  /// So many numbers and ";".
  std::vector<double> numbers(const Block& block, std::size_t count) {
    std::vector<double> values;
    while (values.size() < count) {
      if (next_ == ";") refuse(std::to_string(count) + " numbers for " + in_quotes(block.variable.name()));
      values.push_back(number());
    }
    expect(";");
    return values;
  }

  std::vector<double> row(const Block& block) {
    const Token start = next_;
    std::vector<double> values = numbers(block, block.variable.size());
    normalize(values, start);
    return values;
  }

  /// The outcomes of the variable itself come slowest.
  void table(Block& block) {
    const Token start = take();
    for (const auto& values : block.rows)
      if (!values.empty()) fail(start, "expected a 'table' or rows, found both or 'table' twice");
    const std::size_t rows = block.rows.size();
    const std::vector<double> values = numbers(block, block.variable.size() * rows);
    for (std::size_t r = 0; r < rows; ++r) {
      for (std::size_t i = r; i < values.size(); i += rows) block.rows[r].push_back(values[i]);
      normalize(block.rows[r], start);
    }
  }

  void normalize(std::vector<double>& values, Token start) const {
    const double sum = total<Random>(values);
    if (!(std::abs(sum - 1.0) <= bif_tolerance))
      fail(start, "expected probabilities of the sum 1, found the sum " + std::to_string(sum));
    if (std::abs(sum - 1.0) <= drift_tolerance) return;  // written with all digits
    for (double& value : values) value /= sum;
  }

  /// Depth first: parents before children, as early as the file has them.
  RelationNetwork network() const {
    for (const Block& block : blocks_)
      if (!block.table)
        fail(block.name, "expected a probability of variable " + in_quotes(block.variable.name()) + ", found none");
    RelationNetwork network;
    std::vector<std::size_t> open, entered(blocks_.size(), 0);  // how many of the parents were, and one more
    std::vector<bool> done(blocks_.size(), false);
    for (std::size_t root = 0; root < blocks_.size(); ++root) {
      if (!done[root]) open.push_back(root);
      while (!open.empty()) {
        const std::size_t v = open.back();
        const Block& block = blocks_[v];
        if (entered[v]++ == block.parents.size()) {
          declare(network, block);
          done[v] = true;
          open.pop_back();
        } else if (const std::size_t parent = block.parents[entered[v] - 1]; entered[parent] == 0) {
          open.push_back(parent);
        } else if (!done[parent]) {
          fail(*block.table, "expected parents that do not depend on " + in_quotes(block.variable.name()) + ", found " +
                                 in_quotes(blocks_[parent].variable.name()));
        }
      }
    }
    return network;
  }

  void declare(RelationNetwork& network, const Block& block) const {
    try {
      network.declare(block.variable, parents_of(block), block.rows);
    } catch (const std::invalid_argument& error) {
      fail(*block.table, error.what());
    }
  }

  std::string text_;
  std::string file_;
  Token rest_, next_;
  std::vector<Block> blocks_;
  std::map<std::string, std::size_t, std::less<>> index_;
};

/// A name as the format reads it again. Throws std::invalid_argument for one that it cannot.
std::string written(const std::string& name) {
  const auto plain = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || has("_-.+", c); };
  if (!name.empty() && std::all_of(name.begin(), name.end(), plain)) return name;
  if (has(name, '"'))
    throw std::invalid_argument("BIF cannot hold the name '" + name + "', for it has a quotation mark");
  return '"' + name + '"';
}

/// The shortest digits that are read as the same number.
std::string written(double value) {
  std::array<char, 32> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

}  // namespace

RelationNetwork read_bif(std::istream& in, std::string_view name) { return Reader{in, name}.read(); }

void write_bif(std::ostream& out, const RelationNetwork& network, std::string_view name) {
  for (const auto& vertex : network.vertices()) vertex.variable.as<Random>();  // throws if it is not
  std::ostringstream text;
  text << "network " << written(std::string(name)) << " {\n}\n";
  for (const auto& vertex : network.vertices()) {
    const NetworkVariable& variable = vertex.variable;
    text << "variable " << written(variable.name()) << " {\n  type discrete [ " << variable.size() << " ] {";
    for (std::size_t i = 0; i < variable.size(); ++i) text << (i > 0 ? ", " : " ") << written(variable.label(i));
    text << " };\n}\n";
  }
  for (const auto& vertex : network.vertices()) {
    text << "probability ( " << written(vertex.variable.name());
    std::vector<NetworkVariable> parents;
    std::size_t rows = 1;
    for (const std::size_t parent : vertex.parents) {
      text << (parents.empty() ? " | " : ", ") << written(network[parent].variable.name());
      parents.push_back(network[parent].variable);
      rows *= parents.back().size();
    }
    text << " ) {\n";
    for (std::size_t row = 0; row < rows; ++row) {
      const auto labels = labels_of_row(parents, row, [](const std::string& label) { return written(label); });
      text << (parents.empty() ? "  table" : "  (" + labels + ")");
      const Table values = detail::dense_row(vertex.rows, row);
      for (std::size_t i = 0; i < values.size(); ++i) text << (i > 0 ? ", " : " ") << written(values(0, i));
      text << ";\n";
    }
    text << "}\n";
  }
  out << text.str();
}

}  // namespace sigmax
