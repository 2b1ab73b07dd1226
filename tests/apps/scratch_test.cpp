#include "support/scratch.hpp"
#include "apps/temporary_directory.hpp"
#include "support/error.hpp"

namespace scratch_test {

constexpr std::size_t more_than_is_held = 700'000;  // of five bytes each

struct Plain {
  std::uint8_t a, b, c, d, e;
  friend bool operator==(const Plain&, const Plain&) = default;
};

Plain numbered(std::size_t i) {
  const auto byte = [i](int shift) { return static_cast<std::uint8_t>(i >> shift); };
  return {byte(0), byte(8), byte(16), byte(3), byte(5)};
}

ScratchArray<Plain> filled(std::size_t count) {
  ScratchArray<Plain> array;
  for (std::size_t i = 0; i < count; ++i) array.push_back(numbered(i));
  return array;
}

TEST(Scratch, GivesBackWhatWasPutIntoIt) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{3}, more_than_is_held}) {
    ScratchArray<Plain> array = filled(count);
    ASSERT_EQ(array.size(), count);
    ScratchCursor<Plain> cursor(array);
    for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(cursor[i], numbered(i)) << i;
    std::mt19937_64 generator(1);
    for (int draw = 0; draw < 1000 && count > 0; ++draw) {
      const std::size_t i = generator() % count;
      ASSERT_EQ(cursor[i], numbered(i)) << i;
    }
  }
}

TEST(Scratch, OverwritesOnBothSidesOfWhatIsHeld) {
  ScratchArray<Plain> array = filled(more_than_is_held);
  for (std::size_t i = 0; i < array.size(); i += 1000) array.set(i, Plain{});
  ScratchCursor<Plain> cursor(array);
  for (std::size_t i = 0; i < array.size(); ++i) ASSERT_EQ(cursor[i], i % 1000 == 0 ? Plain{} : numbered(i)) << i;
  array.push_back({1, 2, 3, 4, 5});
  EXPECT_EQ(ScratchCursor<Plain>(array)[more_than_is_held], (Plain{1, 2, 3, 4, 5}));
}

TEST(Scratch, IsMovedWithItsFile) {
  ScratchArray<Plain> array = filled(more_than_is_held);
  ScratchArray<Plain> other = filled(2);
  other = std::move(array);
  const ScratchArray<Plain> moved = std::move(other);
  ASSERT_EQ(moved.size(), more_than_is_held);
  EXPECT_EQ(ScratchCursor<Plain>(moved)[1], numbered(1));
}

TEST(Scratch, LeavesNoFileBehindAndSaysWhereNoneCanBe) {
  const TemporaryDirectory directory;
  const char* const before = std::getenv("TMPDIR");
  const std::string old = before ? before : "";
  ::setenv("TMPDIR", directory.path().c_str(), 1);
  {
    const ScratchArray<Plain> array = filled(more_than_is_held);
    EXPECT_TRUE(std::filesystem::is_empty(directory.path()));
  }
  const std::string nowhere = (directory.path() / "nowhere").native();
  ::setenv("TMPDIR", nowhere.c_str(), 1);
  EXPECT_EQ(filled(2).size(), 2U) << "a little needs no file";
  const std::string message = message_of<InputError>([] { filled(more_than_is_held); });
  before ? ::setenv("TMPDIR", old.c_str(), 1) : ::unsetenv("TMPDIR");
  EXPECT_EQ(message,
            nowhere +
                ": a temporary file for the rows cannot be made: No such file or directory; make room there, or "
                "name another directory by the variable TMPDIR");
}

}  // namespace scratch_test
