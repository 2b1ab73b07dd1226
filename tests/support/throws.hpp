#pragma once

#include <gtest/gtest.h>

#include <exception>
#include <initializer_list>
#include <string>
#include <string_view>

namespace sigmax::support {

/// Whether a text has all these words, in any order.
inline testing::AssertionResult says(std::string_view text, std::initializer_list<std::string_view> words) {
  for (const auto word : words)
    if (text.find(word) == std::string::npos)
      return testing::AssertionFailure() << "'" << word << "' is missing in: " << text;
  return testing::AssertionSuccess();
}

/// Whether the action throws `Exception` with a message that has all these words, in this order.
///
///     EXPECT_INVALID(("mood", "0.9"), Distribution{mood, {0.5, 0.9}});
template <class Exception, class Action>
testing::AssertionResult throws(const Action& action, std::initializer_list<std::string_view> words) {
  try {
    action();
  } catch (const Exception& exception) {
    const std::string message = exception.what();
    std::size_t from = 0;
    for (const auto word : words) {
      const std::size_t at = message.find(word, from);
      if (at == std::string::npos)
        return testing::AssertionFailure() << "'" << word << "' is missing, or out of order, in: " << message;
      from = at + word.size();
    }
    return testing::AssertionSuccess();
  } catch (const std::exception& exception) {
    return testing::AssertionFailure() << "another exception was thrown: " << exception.what();
  }
  return testing::AssertionFailure() << "nothing was thrown";
}
#define SIGMAX_WORDS(...) \
  { __VA_ARGS__ }
#define EXPECT_REFUSED(exception, words, ...) EXPECT_TRUE(throws<exception>([&] { __VA_ARGS__; }, SIGMAX_WORDS words))
#define EXPECT_INVALID(words, ...) EXPECT_REFUSED(std::invalid_argument, words, __VA_ARGS__)

}  // namespace sigmax::support
