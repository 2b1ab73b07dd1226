#pragma once

#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace sigmax::apps {

/// Puts values one after another as bytes, for the same program on the same kind of machine: plain memory, strings,
/// vectors, and whatever has a function `members(pack, value)` that calls `pack` with them.
class Packer {
 public:
  template <class... Values>
  void operator()(Values&... values) {
    (put(values), ...);
  }

  std::string bytes;

 private:
  template <class Value>
  void put(Value& value) {
    if constexpr (std::is_trivially_copyable_v<Value>)
      bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    else
      members(*this, value);
  }
  void put(std::string& text) {
    std::size_t size = text.size();
    put(size);
    bytes += text;
  }
  template <class Value>
  void put(std::vector<Value>& values) {
    std::size_t size = values.size();
    put(size);
    for (Value& value : values) put(value);
  }
};

/// Takes them again, in the same order. Throws std::out_of_range where there is less than that.
class Unpacker {
 public:
  explicit Unpacker(std::string bytes = {}) : bytes_(std::move(bytes)) {}

  template <class... Values>
  void operator()(Values&... values) {
    (get(values), ...);
  }

  bool empty() const { return at_ == bytes_.size(); }

 private:
  std::string_view next(std::size_t size) {
    if (size > bytes_.size() - at_) throw std::out_of_range("packed values end too early");
    at_ += size;
    return std::string_view(bytes_).substr(at_ - size, size);
  }
  template <class Value>
  void get(Value& value) {
    if constexpr (std::is_trivially_copyable_v<Value>)
      std::memcpy(&value, next(sizeof value).data(), sizeof value);
    else
      members(*this, value);
  }
  void get(std::string& text) {
    std::size_t size = 0;
    get(size);
    text = next(size);
  }
  template <class Value>
  void get(std::vector<Value>& values) {
    std::size_t size = 0;
    get(size);
    values.clear();
    for (std::size_t i = 0; i < size; ++i) get(values.emplace_back());
  }

  std::string bytes_;
  std::size_t at_ = 0;
};

}  // namespace sigmax::apps
