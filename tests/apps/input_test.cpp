#include "shell/files.hpp"

#include "apps/temporary_directory.hpp"
#include "shell/text.hpp"

namespace input_test {

class OpenInput : public InDirectory {};

TEST_F(OpenInput, ReadsBytesAsTheyAre) {
  std::ostringstream text;
  text << open_input(directory.write("a", "1\r\n2")).rdbuf();
  EXPECT_EQ(text.str(), "1\r\n2");
}

TEST(ReadText, ReadsTheWholeFile) {
  const TemporaryDirectory directory;
  const std::string text = "1\r\n" + std::string(40'000, 'x') + std::string{"\0y", 2};
  EXPECT_EQ(read_text(directory.write("a", text)), text);
  EXPECT_EQ(read_text(directory.write("b", "")), "");
}

TEST(ReadText, SaysThatReadingFailed) {
  // Every process may open its memory, but nothing is mapped at its beginning.
  EXPECT_EQ(message_of<InputError>([] { read_text("/proc/self/mem"); }),
            "/proc/self/mem: cannot be read: Input/output error");
}

TEST_F(OpenInput, SaysWhyAFileCannotBeRead) {
  const std::string missing = directory.path() / "missing.csv";
  EXPECT_EQ(message_of<InputError>([&] { open_input(missing); }),
            missing + ": cannot be read: No such file or directory; see whether its name and permissions are right");
  EXPECT_EQ(message_of<InputError>([&] { open_input(directory.path()); }),
            directory.path().string() + ": found a directory, expected a file; name one of the files in it");
}

TEST_F(OpenInput, SaysThatPermissionIsMissing) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may read every file";
  const auto secret = directory.write("secret", "1");
  std::filesystem::permissions(secret, std::filesystem::perms::none);
  EXPECT_EQ(message_of<InputError>([&] { open_input(secret); }),
            secret.string() + ": cannot be read: Permission denied; see whether its name and permissions are right");
}

}  // namespace input_test
