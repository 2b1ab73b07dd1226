#pragma once

#include <rapidcheck.h>

#include <cstdlib>
#include <sstream>
#include <string>

#include "support/near.hpp"

namespace sigmax::support {

/// Fails the current test unless the property holds in 500 generated cases, the same in every run. The environment
/// variable RC_PARAMS ("seed=7 max_success=100000", or a failure's "reproduce=…") changes both.
template <class Property>
void holds(const Property& property) {
  const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
  const rc::detail::TestMetadata name{std::string(test->test_suite_name()) + "/" + test->name(), test->name()};
  const auto cases = rc::detail::toProperty(property);
  rc::detail::TestParams parameters;
  parameters.seed = 1;
  parameters.maxSuccess = 500;
  const auto result = std::getenv("RC_PARAMS") == nullptr ? rc::detail::checkProperty(cases, name, parameters)
                                                          : rc::detail::checkProperty(cases, name);
  if (result.template is<rc::detail::SuccessResult>()) return;
  std::ostringstream message;
  rc::detail::printResultMessage(result, message);
  FAIL() << message.str();
}

/// A test that `holds` for its body, which is a generated case; in a typed suite one for each TypeParam.
#define PROPERTY(suite, name)        \
  static void suite##_##name();      \
  TEST(suite, name) {                \
    holds([] { suite##_##name(); }); \
  }                                  \
  static void suite##_##name()
#define TYPED_PROPERTY(suite, name)             \
  template <class TypeParam>                    \
  static void suite##_##name();                 \
  TYPED_TEST(suite, name) {                     \
    holds([] { suite##_##name<TypeParam>(); }); \
  }                                             \
  template <class TypeParam>                    \
  static void suite##_##name()

/// Fails the current case of a property unless the numbers are near.
inline void require_near(double found, double expected, double tolerance = 1e-9) {
  if (const auto result = near("found", "expected", "", found, expected, tolerance); !result)
    RC_FAIL(std::string(result.message()));
}
inline void require_near(std::span<const double> found, std::span<const double> expected, double tolerance = 1e-9) {
  if (const auto result = near("found", "expected", "", found, expected, tolerance); !result)
    RC_FAIL(std::string(result.message()));
}

}  // namespace sigmax::support
