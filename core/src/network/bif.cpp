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

#include "order.hpp"
#include "row_label.hpp"

namespace sigmax {
namespace {

struct Token {
  std::string text;
  std::size_t line;
  enum { word, quoted, sign, end } sort;
};

std::string shown(const Token& token) {
  return token.sort == Token::end ? "the end of the file" : "'" + token.text + "'";
}

/// The text of a file as tokens. Between tokens the format ignores "," and "|" as it does blanks and comments.
class Tokens {
 public:
  Tokens(std::istream& in, std::string_view file) : text_(contents(in)), file_(file), next_() {
    if (in.bad() || (text_.empty() && in.fail())) fail(1, "expected a network, found that nothing can be read");
    take();
  }

  const Token& peek() const { return next_; }
  bool is(std::string_view text) const {
    return (next_.sort == Token::word || next_.sort == Token::sign) && next_.text == text;
  }
  Token take() { return std::exchange(next_, scan()); }

  /// Takes a token that must be this one.
  void expect(std::string_view text) {
    if (!is(text)) fail("'" + std::string(text) + "'");
    take();
  }
  Token word(const std::string& meaning) {
    if (next_.sort != Token::word && next_.sort != Token::quoted) fail(meaning);
    return take();
  }

  /// Throws: `expected` is not what comes next.
  [[noreturn]] void fail(const std::string& expected) const {
    fail(next_.line, "expected " + expected + ", found " + shown(next_));
  }
  [[noreturn]] void fail(std::size_t line, const std::string& what) const {
    throw std::invalid_argument(file_ + ":" + std::to_string(line) + ": " + what);
  }

 private:
  static constexpr std::string_view signs = "{}()[];";
  static constexpr std::string_view ignored = " \t\r\n\v\f,|";

  static std::string contents(std::istream& in) {
    std::ostringstream text;
    text << in.rdbuf();
    std::string contents = text.str();
    if (contents.starts_with("\xEF\xBB\xBF")) contents.erase(0, 3);  // a byte-order mark
    return contents;
  }

  bool at(std::string_view text) const { return std::string_view(text_).substr(position_).starts_with(text); }

  /// Moves to `position`, counting lines.
  void move_to(std::size_t position) {
    for (position = std::min(position, text_.size()); position_ < position; ++position_)
      if (text_[position_] == '\n') ++line_;
  }

  void skip_ignored() {
    while (position_ < text_.size()) {
      if (at("//")) {
        move_to(text_.find('\n', position_));
      } else if (at("/*")) {
        const std::size_t close = text_.find("*/", position_ + 2);
        if (close == std::string::npos) fail(line_, "expected '*/' after '/*', found the end of the file");
        move_to(close + 2);
      } else if (ignored.find(text_[position_]) != std::string_view::npos) {
        move_to(position_ + 1);
      } else {
        return;
      }
    }
  }

  Token scan() {
    skip_ignored();
    const std::size_t line = line_, start = position_;
    if (start == text_.size()) return {"", line, Token::end};
    if (signs.find(text_[start]) != std::string_view::npos) {
      move_to(start + 1);
      return {text_.substr(start, 1), line, Token::sign};
    }
    if (text_[start] == '"') {
      const std::size_t close = text_.find('"', start + 1);
      if (close == std::string::npos) fail(line, "expected '\"' at the end of a name, found the end of the file");
      move_to(close + 1);
      return {text_.substr(start + 1, close - start - 1), line, Token::quoted};
    }
    while (position_ < text_.size() && (signs.find(text_[position_]) == std::string_view::npos) &&
           ignored.find(text_[position_]) == std::string_view::npos && !at("//") && !at("/*"))
      ++position_;
    return {text_.substr(start, position_ - start), line, Token::word};
  }

  std::string text_;
  std::string file_;
  std::size_t position_ = 0;
  std::size_t line_ = 1;
  Token next_;
};

struct Block {
  std::size_t line;
  RandomVariable variable;
  std::optional<std::size_t> table_line;  ///< of its probability block, once there is one
  std::vector<std::size_t> parents;
  std::vector<std::vector<double>> rows;
};

class Reader {
 public:
  Reader(std::istream& in, std::string_view file) : tokens_(in, file) {}

  RelationNetwork read() {
    tokens_.expect("network");
    tokens_.word("the name of the network");
    tokens_.expect("{");
    while (!tokens_.is("}")) property("'property' or '}'");
    tokens_.expect("}");
    while (tokens_.peek().sort != Token::end) {
      if (tokens_.is("variable")) {
        variable();
      } else if (tokens_.is("probability")) {
        probability();
      } else {
        tokens_.fail("'variable' or 'probability'");
      }
    }
    if (blocks_.empty()) tokens_.fail("'variable'");
    return network();
  }

 private:
  static constexpr std::size_t greatest_table = std::size_t{1} << 22;

  void property(const std::string& expected) {
    if (!tokens_.is("property")) tokens_.fail(expected);
    while (!tokens_.is(";")) {
      if (tokens_.peek().sort == Token::end) tokens_.fail("';' after a property");
      tokens_.take();
    }
    tokens_.take();
  }

  void variable() {
    tokens_.expect("variable");
    const Token name = tokens_.word("the name of a variable");
    if (index_.contains(name.text)) tokens_.fail(name.line, "variable '" + name.text + "' is declared twice");
    tokens_.expect("{");
    std::optional<std::vector<std::string>> labels;
    while (!tokens_.is("}")) {
      if (tokens_.is("type") && !labels) {
        labels = outcomes();
      } else {
        property(labels ? "'property' or '}'" : "'type' or 'property'");
      }
    }
    if (!labels) tokens_.fail("'type'");
    tokens_.expect("}");
    try {
      blocks_.push_back({name.line, RandomVariable{name.text, std::move(*labels)}, {}, {}, {}});
    } catch (const std::invalid_argument& error) {
      tokens_.fail(name.line, error.what());
    }
    index_.emplace(name.text, blocks_.size() - 1);
  }

  std::vector<std::string> outcomes() {
    tokens_.expect("type");
    tokens_.expect("discrete");
    tokens_.expect("[");
    const Token count = tokens_.word("the number of outcomes");
    tokens_.expect("]");
    tokens_.expect("{");
    std::vector<std::string> labels;
    while (!tokens_.is("}")) labels.push_back(tokens_.word("an outcome or '}'").text);
    if (std::to_string(labels.size()) != count.text)
      tokens_.fail(count.line, "expected as many outcomes as the number says, found '" + count.text + "' and " +
                                   std::to_string(labels.size()) + " outcomes");
    tokens_.expect("}");
    tokens_.expect(";");
    return labels;
  }

  std::size_t declared(const std::string& meaning) {
    const Token name = tokens_.word(meaning);
    const auto found = index_.find(name.text);
    if (found == index_.end()) tokens_.fail(name.line, "expected " + meaning + ", found '" + name.text + "'");
    return found->second;
  }

  void probability() {
    const std::size_t line = tokens_.take().line;
    tokens_.expect("(");
    Block& block = blocks_[declared("the name of a declared variable")];
    if (block.table_line)
      tokens_.fail(line, "variable '" + block.variable.name() + "' has a probability already, in line " +
                             std::to_string(*block.table_line));
    block.table_line = line;
    std::size_t rows = 1;
    while (!tokens_.is(")")) {
      block.parents.push_back(declared("the name of a declared variable or ')'"));
      rows *= blocks_[block.parents.back()].variable.size();
      if (rows * block.variable.size() > greatest_table)
        tokens_.fail(line, "the table of '" + block.variable.name() + "' has more than " +
                               std::to_string(greatest_table) + " numbers");
    }
    tokens_.expect(")");
    tokens_.expect("{");
    block.rows.resize(rows);
    std::vector<double> otherwise;
    while (!tokens_.is("}")) {
      if (tokens_.is("table")) {
        table(block);
      } else if (tokens_.is("default")) {
        tokens_.take();
        otherwise = row(block);
      } else if (tokens_.is("(")) {
        entry(block);
      } else {
        property("'table', 'default', '(', 'property' or '}'");
      }
    }
    for (std::size_t r = 0; r < rows; ++r) {
      if (block.rows[r].empty()) block.rows[r] = otherwise;
      if (block.rows[r].empty()) tokens_.fail("a row for " + condition(block, r) + " or 'default'");
    }
    tokens_.expect("}");
  }

  /// "(young, calm)": the outcomes of the parents in one row, the last fastest.
  std::string condition(const Block& block, std::size_t row) const {
    std::vector<Outcomes> parents;
    for (const std::size_t parent : block.parents) parents.push_back(blocks_[parent].variable);
    return "(" + labels_of_row(parents, row) + ")";
  }

  void entry(Block& block) {
    const std::size_t line = tokens_.peek().line;
    tokens_.expect("(");
    std::size_t index = 0;
    for (const std::size_t parent : block.parents) {
      const auto& variable = blocks_[parent].variable;
      const Token label = tokens_.word("an outcome of '" + variable.name() + "'");
      try {
        index = index * variable.size() + variable.index_of(label.text);
      } catch (const std::invalid_argument& error) {
        tokens_.fail(label.line, error.what());
      }
    }
    tokens_.expect(")");
    if (!block.rows[index].empty()) tokens_.fail(line, "the row for " + condition(block, index) + " is given twice");
    block.rows[index] = row(block);
  }

  double number() {
    const Token token = tokens_.word("a number");
    double value = 0.0;
    const char* const end = token.text.data() + token.text.size();
    const auto read = std::from_chars(token.text.data(), end, value);
    if (read.ec != std::errc{} || read.ptr != end || !(value >= 0.0 && value <= 1.0 + bif_tolerance))
      tokens_.fail(token.line, "expected a number between 0 and 1, found '" + token.text + "'");
    return value;
  }

  std::vector<double> row(const Block& block) {
    const std::size_t line = tokens_.peek().line;
    std::vector<double> values;
    while (!tokens_.is(";") && values.size() < block.variable.size()) values.push_back(number());
    if (values.size() < block.variable.size())
      tokens_.fail(std::to_string(block.variable.size()) + " numbers for '" + block.variable.name() + "'");
    tokens_.expect(";");
    normalize(values, line);
    return values;
  }

  /// The outcomes of the variable itself come slowest.
  void table(Block& block) {
    const std::size_t line = tokens_.take().line;
    const std::size_t outcomes = block.variable.size();
    for (auto& values : block.rows) {
      if (!values.empty()) tokens_.fail(line, "expected a 'table' or rows, found both or 'table' twice");
      values.resize(outcomes);
    }
    for (std::size_t i = 0; i < outcomes; ++i)
      for (auto& values : block.rows) {
        if (tokens_.is(";"))
          tokens_.fail(std::to_string(outcomes * block.rows.size()) + " numbers for '" + block.variable.name() + "'");
        values[i] = number();
      }
    tokens_.expect(";");
    for (auto& values : block.rows) normalize(values, line);
  }

  void normalize(std::vector<double>& values, std::size_t line) const {
    const double sum = total<Random>(values);
    if (!(std::abs(sum - 1.0) <= bif_tolerance))
      tokens_.fail(line, "expected probabilities of the sum 1, found the sum " + std::to_string(sum));
    if (std::abs(sum - 1.0) <= drift_tolerance) return;  // written with all digits
    for (double& value : values) value /= sum;
  }

  RelationNetwork network() const {
    std::vector<std::vector<std::size_t>> parents;
    for (const Block& block : blocks_) {
      if (!block.table_line)
        tokens_.fail(block.line, "expected a probability of variable '" + block.variable.name() + "', found none");
      parents.push_back(block.parents);
    }
    const auto order = elimination::parents_first(parents, [this](std::size_t child, std::size_t parent) {
      tokens_.fail(*blocks_[child].table_line, "expected parents that do not depend on '" +
                                                   blocks_[child].variable.name() + "', found '" +
                                                   blocks_[parent].variable.name() + "'");
    });
    RelationNetwork network;
    for (const std::size_t v : order) {
      const Block& block = blocks_[v];
      std::vector<NetworkVariable> conditions;
      for (const std::size_t parent : block.parents) conditions.emplace_back(blocks_[parent].variable);
      try {
        network.declare(block.variable, conditions, block.rows);
      } catch (const std::invalid_argument& error) {
        tokens_.fail(*block.table_line, error.what());
      }
    }
    return network;
  }

  Tokens tokens_;
  std::vector<Block> blocks_;
  std::map<std::string, std::size_t, std::less<>> index_;
};

/// A name as the format reads it again. Throws std::invalid_argument for one that it cannot.
std::string written(const std::string& name) {
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '.' || c == '+';
  };
  if (!name.empty() && std::all_of(name.begin(), name.end(), plain)) return name;
  if (name.find('"') != std::string::npos)
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
    std::size_t rows = 1;
    const char* separator = " | ";
    for (const std::size_t parent : vertex.parents) {
      text << std::exchange(separator, ", ") << written(network[parent].variable.name());
      rows *= network[parent].variable.size();
    }
    text << " ) {\n";
    for (std::size_t row = 0; row < rows; ++row) {
      std::string labels;
      for (std::size_t p = vertex.parents.size(), rest = row; p-- > 0;) {
        const NetworkVariable& parent = network[vertex.parents[p]].variable;
        labels = written(parent.label(rest % parent.size())) + (labels.empty() ? "" : ", ") + labels;
        rest /= parent.size();
      }
      text << (vertex.parents.empty() ? "  table" : "  (" + labels + ")");
      const auto value = [&](std::size_t i) {
        return std::visit([&](const auto& all) { return all.at(row, i); }, vertex.rows);
      };
      for (std::size_t i = 0; i < vertex.variable.size(); ++i) text << (i > 0 ? ", " : " ") << written(value(i));
      text << ";\n";
    }
    text << "}\n";
  }
  out << text.str();
}

}  // namespace sigmax
