#pragma once

#include <gtest/gtest.h>

#include <exception>
#include <initializer_list>
#include <string>
#include <string_view>

namespace sigmax::support {

/// Whether the action throws `Exception` with a message that has all these words, in this order.
///
///     EXPECT_TRUE(throws<std::invalid_argument>([&] { Distribution{mood, {0.5, 0.9}}; }, {"mood", "0.9"}));
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

}  // namespace sigmax::support
