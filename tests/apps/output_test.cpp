#include "shell/files.hpp"

#include <sys/stat.h>

#include "apps/temporary_directory.hpp"
#include "shell/text.hpp"

namespace output_test {

namespace fs = std::filesystem;

auto count_files(const fs::path& directory) { return std::distance(fs::directory_iterator{directory}, {}); }

class AtomicFiles : public InDirectory {};

TEST_F(AtomicFiles, AppearsWholeOnCommit) {
  const fs::path path = directory.path() / "a.csv";
  const std::string large(200'000, 'x');
  AtomicFile file{path};
  file.write("a,");
  file.write("0.1,5\n");
  file.write(large);
  EXPECT_FALSE(fs::exists(path));
  EXPECT_EQ(file.path(), path);
  file.commit();
  EXPECT_EQ(contents(path), "a,0.1,5\n" + large);
  EXPECT_EQ(count_files(directory.path()), 1);
}

TEST_F(AtomicFiles, LeavesNothingWithoutACommit) {
  {
    AtomicFile file{directory.path() / "a.csv"};
    file.write("half");
    EXPECT_EQ(count_files(directory.path()), 1);
  }
  EXPECT_EQ(count_files(directory.path()), 0);
}

TEST_F(AtomicFiles, ReplacesAnOlderFileOnlyOnCommit) {
  const fs::path path = directory.write("a.csv", "old");
  { AtomicFile{path}.write("half"); }
  EXPECT_EQ(contents(path), "old");
  AtomicFile file{path};
  file.write("new");
  file.commit();
  EXPECT_EQ(contents(path), "new");
}

TEST_F(AtomicFiles, TwoWritersOfOneFileDoNotMix) {
  const fs::path path = directory.path() / "a";
  AtomicFile first{path};
  AtomicFile second{path};
  first.write("first");
  second.write("second");
  first.commit();
  EXPECT_EQ(contents(path), "first");
  second.commit();
  EXPECT_EQ(contents(path), "second");
  EXPECT_EQ(count_files(directory.path()), 1);
}

TEST_F(AtomicFiles, HasThePermissionsOfAnyNewFile) {
  AtomicFile file{directory.path() / "a"};
  file.commit();
  directory.write("b", "");
  EXPECT_EQ(fs::status(directory.path() / "a").permissions(), fs::status(directory.path() / "b").permissions());
}

TEST_F(AtomicFiles, IsFinishedByItsCommit) {
  AtomicFile file{directory.path() / "a"};
  file.commit();
  EXPECT_THROW(file.write("more"), std::logic_error);
  EXPECT_THROW(file.commit(), std::logic_error);
}

TEST_F(AtomicFiles, NamesPathAndReasonOfAFailure) {
  const std::string lost = directory.path() / "none" / "a.csv";
  EXPECT_EQ(message_of<InputError>([&] { AtomicFile{lost}; }),
            lost + ": cannot be written: No such file or directory; choose another place");

  const fs::path taken = directory.path() / "taken";
  fs::create_directory(taken);
  AtomicFile file{taken};
  EXPECT_EQ(message_of<InputError>([&] { file.commit(); }),
            taken.string() + ": cannot be written: Is a directory; choose another place");
  EXPECT_EQ(count_files(directory.path()), 1);
}

TEST_F(AtomicFiles, ReportsAFullDevice) {
  std::string refusal;
  with_files_up_to(4096, [&] {
    AtomicFile file{directory.path() / "a"};
    refusal = message_of<InputError>([&] {
      file.write(std::string(100'000, 'x'));
      file.commit();
    });
  });
  EXPECT_EQ(refusal, (directory.path() / "a").string() +
                         ": cannot be written: File too large; make room there, or choose another place");
  EXPECT_EQ(count_files(directory.path()), 0);
}

TEST_F(AtomicFiles, ReportsMissingPermission) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  fs::permissions(directory.path(), fs::perms::owner_read | fs::perms::owner_exec);
  const std::string path = directory.path() / "a";
  EXPECT_EQ(message_of<InputError>([&] { AtomicFile{path}; }),
            path + ": cannot be written: Permission denied; choose another place");
  fs::permissions(directory.path(), fs::perms::owner_all);
}

TEST(RemoveUnfinishedFiles, RemovesWhatIsNotCommitted) {
  const TemporaryDirectory directory;
  AtomicFile committed{directory.path() / "committed"};
  AtomicFile first{directory.path() / "first"};
  committed.commit();
  EXPECT_EQ(count_files(directory.path()), 2);
  remove_unfinished_files();
  EXPECT_EQ(count_files(directory.path()), 1);
  EXPECT_TRUE(fs::exists(directory.path() / "committed"));
}

TEST_F(AtomicFiles, AtMost16AreWrittenAtATime) {
  for (int round = 0; round < 3; ++round) {
    std::list<AtomicFile> files;
    for (int i = 0; i < 16; ++i) files.emplace_back(directory.path() / std::to_string(i));
    EXPECT_THROW(AtomicFile{directory.path() / "more"}, std::logic_error);
  }
  EXPECT_EQ(count_files(directory.path()), 0);
}

class OutputDirectory : public InDirectory {};

TEST_F(OutputDirectory, IsCreatedWithItsParents) {
  const fs::path path = directory.path() / "a" / "b";
  EXPECT_EQ(output_directory(path), path);
  std::ofstream(path / "c.csv") << "1";
  EXPECT_EQ(output_directory(path), path);
  EXPECT_EQ(contents(path / "c.csv"), "1");
}

TEST_F(OutputDirectory, TakesATrailingSlash) {
  output_directory(directory.path() / "a" / "");
  EXPECT_TRUE(fs::is_directory(directory.path() / "a"));
}

TEST_F(OutputDirectory, SaysWhyItCannotBe) {
  const fs::path file = directory.write("file", "");
  for (const fs::path& path : {file, file / "below"})
    EXPECT_EQ(message_of<InputError>([&] { output_directory(path); }),
              path.string() + ": the directory cannot be created: Not a directory; choose another place");
}

}  // namespace output_test
