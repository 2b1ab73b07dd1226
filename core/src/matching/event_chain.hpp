#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <boost/pending/disjoint_sets.hpp>

#include <sigmax/core/choices.hpp>

namespace sigmax::detail {

using Word = std::uint64_t;
using Key = std::vector<Word>;

inline void set(Key& key, std::size_t bit) { key[bit / 64] |= Word{1} << bit % 64; }
inline bool has(const Word* key, std::size_t bit) { return (key[bit / 64] >> bit % 64 & 1) != 0; }

/// Different keys of some words each, numbered as they come.
class KeySet {
 public:
  explicit KeySet(std::size_t words) : words_(words) { clear(); }

  void clear() {
    keys_.clear();
    slots_.assign(16, 0);
  }
  std::size_t size() const { return keys_.size() / words_; }
  const Word* operator[](std::size_t number) const { return keys_.data() + number * words_; }

  std::uint32_t add(const Key& key) {
    if (2 * size() >= slots_.size()) {
      slots_.assign(4 * slots_.size(), 0);
      for (std::uint32_t number = 0; number < size(); ++number) slot_of((*this)[number]) = number + 1;
    }
    std::uint32_t& slot = slot_of(key.data());
    if (slot == 0) {
      keys_.insert(keys_.end(), key.begin(), key.end());
      slot = static_cast<std::uint32_t>(size());
    }
    return slot - 1;
  }

 private:
  std::uint32_t& slot_of(const Word* key) {
    Word hash = 0;  // its highest bits depend on all of the key, its lowest on those as low
    for (std::size_t w = 0; w < words_; ++w) hash = (hash ^ hash >> 32 ^ key[w]) * 0x9e37'79b9'7f4a'7c15;
    for (Word at = hash >> std::countl_zero(slots_.size() - 1);; ++at)
      if (std::uint32_t& slot = slots_[at & (slots_.size() - 1)];
          slot == 0 || std::equal(key, key + words_, (*this)[slot - 1]))
        return slot;
  }

  std::size_t words_;
  std::vector<Word> keys_;
  std::vector<std::uint32_t> slots_;  // one more than a number, 0 where there is none
};

/// All events of one cluster as ways through a chain, a link for each row. A state says what later rows need to know of
/// the rows before: which columns are used that are wanted still. Where patterns count, it keeps the pattern too, but
/// only within open regions: a region is what stays connected without bridges, the edges (row, column) on no cycle, and
/// it is open until its last row. That suffices, because events of one pattern differ by cycles.
///
/// A link has two parts. Ways that lead to one *joint* are of one pattern so far, and the permutation is eliminated
/// there. Then closed regions are forgotten: joints that lead to one state are of different patterns for ever.
class EventChain {
 public:
  struct Way {
    std::uint32_t from, choice, joint;  // from a state; the number of an entry, or beyond them of no column for a row
  };
  struct Link {
    std::size_t ways, joints;  // the numbers of its first way and of its first joint
    std::size_t states;        // behind it
  };

  /// Returns false where it would take more than `max_states` joints, or sixteen times as many ways.
  bool build(const Choices& choices, bool keep_patterns, std::size_t max_states) {
    const std::size_t n = choices.rows(), m = choices.columns();
    order_rows(choices);
    if (keep_patterns) find_regions(choices);
    const auto within = [&](std::size_t row, std::size_t column) {
      return keep_patterns && region_[row] == region_[n + column];
    };

    // A key has a bit for each column that is used; and if patterns count, for those used within their region, for rows
    // detected there, and for the row of this link if it is detected across a bridge. They are kept up to a link.
    const std::size_t in_region = m, row_in_region = 2 * m, across = 2 * m + n;
    std::vector<std::size_t> last(keep_patterns ? across : m, 0), last_of_region(n + m, 0);
    for (std::size_t t = 0; t < n; ++t)
      for (const std::uint32_t column : choices.entries(rows_[t]).columns) {
        last[column] = t;
        if (within(rows_[t], column)) last_of_region[region_[rows_[t]]] = t;
      }
    if (keep_patterns) {
      for (std::size_t c = 0; c < m; ++c) last[in_region + c] = std::max(last[c], last_of_region[region_[n + c]]);
      for (std::size_t row = 0; row < n; ++row) last[row_in_region + row] = last_of_region[region_[row]];
    }

    links_.clear();
    ways_.clear();
    joints_.clear();
    const std::size_t words = last.size() / 64 + 1;
    KeySet states(words), joints(words);
    Key key(words), kept(words);
    states.add(key);
    for (std::size_t t = 0; t < n; ++t) {
      const std::size_t row = rows_[t], offset = choices.offset(row);
      const auto entries = choices.entries(row);
      links_.push_back({ways_.size(), joints_.size(), 0});
      std::fill(kept.begin(), kept.end(), ~Word{0});
      for (std::size_t bit = 0; bit < last.size(); ++bit)
        if (last[bit] == t) kept[bit / 64] &= ~(Word{1} << bit % 64);
      if (keep_patterns) kept[across / 64] &= ~(Word{1} << across % 64);
      const auto forget = [&] { std::ranges::transform(key, kept, key.begin(), std::bit_and()); };
      joints.clear();
      for (std::size_t state = 0; state < states.size(); ++state) {
        const Word* const from = states[state];
        const auto go = [&](std::size_t choice) {
          if (!keep_patterns) forget();
          ways_.push_back({static_cast<std::uint32_t>(state), static_cast<std::uint32_t>(choice), joints.add(key)});
        };
        for (std::size_t k = 0; k < entries.size(); ++k) {
          const std::size_t column = entries.index(k);
          if (has(from, column) || (keep_patterns && has(from, in_region + column))) continue;
          std::copy_n(from, words, key.begin());
          const bool inside = within(row, column);
          set(key, inside ? in_region + column : column);
          if (keep_patterns) set(key, inside ? row_in_region + row : across);
          go(offset + k);
        }
        std::copy_n(from, words, key.begin());
        if (std::isfinite(choices.none(row))) go(choices.size() + row);
        if (joints_.size() + joints.size() > max_states || ways_.size() > 16 * max_states) return false;
      }
      if (keep_patterns) states.clear();
      for (std::uint32_t joint = 0; joint < joints.size(); ++joint) {
        std::copy_n(joints[joint], words, key.begin());
        forget();
        joints_.push_back(keep_patterns ? states.add(key) : joint);
      }
      if (!keep_patterns) std::swap(states, joints);
      links_.back().states = states.size();
    }
    links_.push_back({ways_.size(), joints_.size(), 0});
    return true;
  }

  /// Links in their order, and one behind the last.
  const std::vector<Link>& links() const { return links_; }
  std::span<const Way> ways(std::size_t link) const {
    return {ways_.data() + links_[link].ways, links_[link + 1].ways - links_[link].ways};
  }
  /// The state behind each joint of a link.
  std::span<const std::uint32_t> joints(std::size_t link) const {
    return {joints_.data() + links_[link].joints, links_[link + 1].joints - links_[link].joints};
  }

 private:
  /// The next row shares a column with those before, and adds the fewest columns that are wanted still.
  void order_rows(const Choices& choices) {
    std::vector<std::size_t> wanted(choices.columns(), 0);
    std::vector<bool> open(choices.columns(), false);
    rows_.resize(choices.rows());
    std::iota(rows_.begin(), rows_.end(), std::size_t{0});
    for (const std::size_t row : rows_)
      for (const std::uint32_t column : choices.entries(row).columns) ++wanted[column];
    for (auto next = rows_.begin(); next != rows_.end(); ++next) {
      const auto added = [&](std::size_t row) {
        std::ptrdiff_t sum = 0;
        bool shares = false;
        for (const std::uint32_t column : choices.entries(row).columns) {
          shares |= open[column];
          sum += open[column] ? -static_cast<std::ptrdiff_t>(wanted[column] == 1) : (wanted[column] > 1);
        }
        return sum + (shares ? 0 : static_cast<std::ptrdiff_t>(choices.columns()));
      };
      const auto best = std::ranges::min_element(next, rows_.end(), {}, added);
      std::rotate(next, best, best + 1);
      for (const std::uint32_t column : choices.entries(*next).columns) {
        --wanted[column];
        open[column] = true;
      }
    }
  }

  /// Rows and columns that cycles link, by the fundamental cycles of a spanning tree.
  void find_regions(const Choices& choices) {
    const std::size_t n = choices.rows(), nodes = n + choices.columns();
    std::vector<std::vector<std::size_t>> next(nodes);
    for (std::size_t row = 0; row < n; ++row)
      for (const std::uint32_t column : choices.entries(row).columns) {
        next[row].push_back(n + column);
        next[n + column].push_back(row);
      }
    std::vector<std::size_t> depth(nodes, nodes), parent(nodes, 0), queue{0};
    depth[0] = 0;
    for (std::size_t at = 0; at < queue.size(); ++at)
      for (const std::size_t node : next[queue[at]])
        if (depth[node] == nodes) {
          depth[node] = depth[queue[at]] + 1;
          parent[node] = queue[at];
          queue.push_back(node);
        }
    boost::disjoint_sets_with_storage<> sets(nodes);
    for (std::size_t row = 0; row < n; ++row)
      for (const std::size_t column : next[row]) {
        if (parent[column] == row || parent[row] == column) continue;
        for (std::size_t a = row, b = column; a != b; a = parent[a]) {
          if (depth[a] < depth[b]) std::swap(a, b);
          sets.union_set(a, parent[a]);
        }
      }
    region_.resize(nodes);
    for (std::size_t node = 0; node < nodes; ++node) region_[node] = sets.find_set(node);
  }

  std::vector<Link> links_;
  std::vector<Way> ways_;
  std::vector<std::uint32_t> joints_;
  std::vector<std::size_t> rows_, region_;  // rows in the order of links; the region of each row, then of each column
};

}  // namespace sigmax::detail
