#include "support/sigmax.hpp"

namespace motion_choice_test {

TEST(MotionChoice, EveryMotionHasANameOfItsOwn) {
  std::set<std::string_view> names;
  for (const KnownMotion& motion : known_motions()) {
    EXPECT_TRUE(names.insert(motion.name).second) << motion.name;
    EXPECT_EQ(known_motion(motion.name), &motion);
  }
  EXPECT_EQ(known_motions().size(), 9U);
  EXPECT_EQ(known_motion("teleport"), nullptr);
  EXPECT_INVALID(("'teleport'"), MotionChoice{"teleport"}.known());
}

TEST(MotionChoice, EveryParameterIsOfSomeMotionAndItsDefaultIsValid) {
  for (std::size_t p = 0; p < motion_parameters().size(); ++p) {
    const KnownParameter& parameter = motion_parameters()[p];
    bool of_some = false;
    for (const KnownMotion& motion : known_motions())
      of_some = of_some || motion.has_parameter(static_cast<MotionParameter>(p));
    EXPECT_TRUE(of_some) << parameter.key;
    EXPECT_TRUE(parameter.valid(parameter.otherwise)) << parameter.key;
    EXPECT_EQ(MotionChoice{}.parameters[p], parameter.otherwise) << parameter.key;
    EXPECT_EQ(parameter.valid(-1.0), static_cast<MotionParameter>(p) == MotionParameter::turn_rate) << parameter.key;
    EXPECT_EQ(parameter.valid(0.0), static_cast<MotionParameter>(p) != MotionParameter::tau) << parameter.key;
  }
  EXPECT_EQ(motion_parameters()[static_cast<std::size_t>(MotionParameter::tau)].key, "tau_s");
}

TEST(MotionChoice, IsWhatItsNameSays) {
  struct Row {
    const char* name;
    int derivatives, least_axes;
    bool linear, manoeuvres, remembers;
  };
  for (const Row& row : {Row{"dwna", 2, 1, true, false, false}, Row{"dwpa", 3, 1, true, true, false},
                         Row{"cwna", 2, 1, true, false, false}, Row{"cwpa", 3, 1, true, true, false},
                         Row{"singer", 3, 1, true, true, true}, Row{"ou_position", 1, 1, true, false, true},
                         Row{"ou_velocity", 2, 1, true, false, true}, Row{"known_turn", 2, 2, true, true, false},
                         Row{"ct", 2, 2, false, true, false}}) {
    const MotionChoice choice{row.name};
    EXPECT_EQ(choice.known().derivatives, row.derivatives) << row.name;
    EXPECT_EQ(choice.known().least_axes, row.least_axes) << row.name;
    EXPECT_EQ(choice.linear(), row.linear) << row.name;
    EXPECT_EQ(choice.manoeuvres(), row.manoeuvres) << row.name;
    EXPECT_EQ(choice.known().has_parameter(MotionParameter::tau), row.remembers) << row.name;
  }
  MotionChoice turn{"known_turn"};
  turn[MotionParameter::turn_rate] = -5.0;
  EXPECT_EQ(turn.parameters[2], -5.0);
}

}  // namespace motion_choice_test
