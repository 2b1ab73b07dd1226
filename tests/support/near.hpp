#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace sigmax::support {

/// Equality of the tests: |a − b| ≤ tolerance · max(1, |b|); infinities are near only themselves, NaN near nothing.
inline bool is_near(double a, double b, double tolerance) {
  return a == b || (std::isfinite(b) && std::abs(a - b) <= tolerance * std::max(1.0, std::abs(b)));
}

/// EXPECT_CLOSE(found, expected, tolerance) for numbers.
inline testing::AssertionResult near(const char* a_text, const char* b_text, const char* /*tolerance_text*/, double a,
                                     double b, double tolerance) {
  if (is_near(a, b, tolerance)) return testing::AssertionSuccess();
  return testing::AssertionFailure() << a_text << " is not near " << b_text
                                     << "\n  found:    " << testing::PrintToString(a)
                                     << "\n  expected: " << testing::PrintToString(b) << "\n  differ by "
                                     << std::abs(a - b) << ", tolerance " << tolerance;
}

/// The same for sequences: of one length, and near element by element.
inline testing::AssertionResult near(const char* a_text, const char* b_text, const char* tolerance_text,
                                     std::span<const double> a, std::span<const double> b, double tolerance) {
  if (a.size() != b.size())
    return testing::AssertionFailure() << a_text << " has " << a.size() << " values, " << b_text << " " << b.size();
  for (std::size_t i = 0; i < a.size(); ++i)
    if (auto result = near(a_text, b_text, tolerance_text, a[i], b[i], tolerance); !result)
      return result << "\n  at index " << i;
  return testing::AssertionSuccess();
}

#define EXPECT_CLOSE(found, expected, tolerance) EXPECT_PRED_FORMAT3(near, found, expected, tolerance)
#define ASSERT_CLOSE(found, expected, tolerance) ASSERT_PRED_FORMAT3(near, found, expected, tolerance)

}  // namespace sigmax::support
