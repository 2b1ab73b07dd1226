#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace sigmax {

/// The name and the outcomes of a variable, whatever its kind: an immutable value that is cheap to copy.
class Outcomes {
 public:
  /// Labelled outcomes. Throws std::invalid_argument if there is none, or a label is empty or repeated.
  Outcomes(std::string name, std::vector<std::string> labels);
  Outcomes(std::string name, std::initializer_list<std::string_view> labels);

  /// `size` outcomes labelled "0", "1", …; nothing is stored for them.
  Outcomes(std::string name, std::size_t size);

  /// A view that lives as long as some copy of the variable; of a temporary, a copy.
  const std::string& name() const& { return table_->name; }
  std::string name() const&& { return table_->name; }
  std::size_t size() const { return table_->size; }
  std::string label(std::size_t index) const;

  /// Index of an outcome; throws std::invalid_argument that names the variable and its outcomes.
  std::size_t index_of(std::string_view label) const;

  /// Whether both have the same name and the same outcomes; numbered outcomes are not those labelled "0", "1", ….
  friend bool operator==(const Outcomes& a, const Outcomes& b) {
    return a.table_.get() == b.table_.get() || a.equals(b);
  }

  /// How the second differs from the first, for a message: "expected variable 'x' with 3 outcomes, found 'x' with 2
  /// outcomes". They must differ.
  friend std::string difference(const Outcomes& expected, const Outcomes& found);

 private:
  struct Table {
    std::string name;
    std::size_t size;
    std::vector<std::string> labels;
  };
  bool equals(const Outcomes& other) const;

  std::shared_ptr<const Table> table_;
};

}  // namespace sigmax
