#include "study/study.hpp"

#include "apps/temporary_directory.hpp"
#include "report/result.hpp"

namespace journal_test {

class AJournal : public InDirectory {
 protected:
  void run_study() const {
    run(study, {.threads = 1}, {.out = directory.path(), .quiet = true}, [](std::size_t, const Study::Row&) {});
  }

  /// What the study prints to standard error.
  std::string done() const {
    testing::internal::CaptureStderr();
    run_study();
    return testing::internal::GetCapturedStderr();
  }

  const std::filesystem::path path = directory.path() / journal_name;
  const Study study{"cells", 3,
                    [](std::size_t cell) {
                      return Study::Row{1.0 / static_cast<double>(cell), -0.5};
                    },
                    "a study --runs 3"};
};

TEST_F(AJournal, HasTheCrc32OfEachLine) {
  EXPECT_EQ(sealed("123456789"), "123456789 #cbf43926\n");  // the check value of the catalogues
  EXPECT_EQ(done(), "");
  EXPECT_EQ(contents(path),
            sealed("a study --runs 3") + sealed("0,inf,-0.5") + sealed("1,1,-0.5") + sealed("2,0.5,-0.5"));
}

TEST_F(AJournal, WithAnyOneCharacterChangedIsRefusedAndItsCellDoneAgain) {
  done();
  const std::string whole = contents(path);
  const std::size_t first = whole.find('\n');
  for (std::size_t at = 0; at < whole.size(); ++at)
    for (const char other : {'7', '\n'}) {
      if (whole[at] == other) continue;
      std::string changed = whole;
      changed[at] = other;
      directory.write(journal_name, changed);
      const auto line = 1 + std::count(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(at), '\n');
      const std::string where = path.string() + ":" + std::to_string(line) + ": the line";
      if (at <= first) {
        EXPECT_REFUSED(InputError, (where), read_journal(path));
        EXPECT_REFUSED(InputError, (where), run_study());
      } else if (at + 1 == whole.size()) {
        EXPECT_EQ(read_journal(path).rows.size(), 2U) << "a line without an end does not count";
        EXPECT_EQ(done(), "");
      } else {
        EXPECT_REFUSED(InputError, (where + " is damaged"), read_journal(path));
        EXPECT_TRUE(says(done(), {"warning: " + where + " is damaged", "; what it said is computed again\n"}));
      }
      if (at > first) ASSERT_EQ(contents(path), whole) << at << " was " << other;
    }
}

TEST_F(AJournal, KeepsWhatIsSoundBehindDamagedLines) {
  directory.write(journal_name,
                  sealed("a study --runs 3") + "0,1 #00000000\n" + sealed("1,7") + "torn, #00000000\n0,1");
  testing::internal::CaptureStderr();
  const Journal journal(path, "a study --runs 3");
  EXPECT_TRUE(says(testing::internal::GetCapturedStderr(),
                   {":2: the line is damaged: its checksum is another, and 1 below it; "}));
  EXPECT_EQ(journal.rows(), (CellRows{{1, {7.0}}}));
  EXPECT_EQ(contents(path), sealed("a study --runs 3") + sealed("1,7")) << "a program that is killed now loses nothing";
}

TEST_F(AJournal, OfAnOlderVersionIsRefused) {
  directory.write(journal_name, "a study --runs 3\n0,1.5\n");
  for (const bool resumed : {false, true})
    EXPECT_REFUSED(InputError,
                   (":1: the line has no checksum, so an older version wrote this journal; go on and merge by that "
                    "version, or delete the file and give its command again"),
                   resumed ? run_study() : (void)read_journal(path));
}

TEST_F(AJournal, OfAnotherStudyIsRefusedWithTheOptionThatDiffersAndLeftAsItWas) {
  const std::string list(200, '7');
  const std::string of_another = sealed("a study --runs " + list + " --cross") + sealed("0,1.5") + "1,2";
  directory.write(journal_name, of_another);
  EXPECT_REFUSED(InputError,
                 (":1: the directory holds another campaign: found '--runs " + list + "', expected '--runs 3'; "),
                 run_study());
  EXPECT_EQ(contents(path), of_another);
  directory.write(journal_name, sealed("a study --runs 3 --cross"));
  EXPECT_REFUSED(InputError, ("found '--cross', expected no further option"), run_study());
}

}  // namespace journal_test
