#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <string>

namespace sigmax::support {

/// Names the instances of a typed suite by their types instead of numbers: Laws/Random, JointLaws/Fuzzy_Random.
struct TypeNames {
  template <class T>
  static std::string GetName(int) {
    std::string name, word;
    for (const char c : testing::internal::GetTypeName<T>() + ",") {
      if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
        word += c;
        continue;
      }
      if ((c == ',' || c == '>') && !word.empty()) name += (name.empty() ? "" : "_") + word;
      word.clear();
    }
    return name;
  }
};

/// A typed suite of these types, by which its instances are named.
#define TYPED_SUITE(suite, ...)                     \
  template <class T>                                \
  class suite : public testing::Test {};            \
  using suite##Types = testing::Types<__VA_ARGS__>; \
  TYPED_TEST_SUITE(suite, suite##Types, support::TypeNames)

}  // namespace sigmax::support
