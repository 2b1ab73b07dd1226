#include <sigmax/hybrid/motion_choice.hpp>

#include <gtest/gtest.h>

#include <set>

#include "support/throws.hpp"

namespace sigmax {
namespace {

using support::throws;

TEST(MotionChoice, EveryMotionHasANameOfItsOwn) {
  std::set<std::string_view> names;
  for (const KnownMotion& motion : known_motions()) {
    EXPECT_TRUE(names.insert(motion.name).second) << motion.name;
    EXPECT_EQ(known_motion(motion.name), &motion);
    EXPECT_GE(motion.derivatives, 1);
    EXPECT_LE(motion.derivatives, 3);
  }
  EXPECT_TRUE(names.contains("dwna"));
  EXPECT_TRUE(names.contains("dwpa"));
  EXPECT_EQ(known_motion("teleport"), nullptr);
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
  }
  EXPECT_FALSE(motion_parameters()[0].valid(-1.0)) << "a strength";
}

TEST(MotionChoice, IsWhatItsNameSays) {
  EXPECT_EQ((MotionChoice{"dwna"}.known().derivatives), 2);
  EXPECT_EQ((MotionChoice{"dwpa"}.known().derivatives), 3);
  EXPECT_TRUE((MotionChoice{"dwna"}.linear()));
  EXPECT_FALSE((MotionChoice{"dwna"}.manoeuvres()));
  EXPECT_TRUE((MotionChoice{"dwpa"}.manoeuvres()));
  EXPECT_FALSE((MotionChoice{"ct"}.linear()));
  MotionChoice turn{"known_turn"};
  turn[MotionParameter::turn_rate] = -5.0;
  EXPECT_EQ(turn.parameters[2], -5.0);
  EXPECT_TRUE(throws<std::invalid_argument>([] { MotionChoice{"teleport"}.known(); }, {"'teleport'"}));
}

}  // namespace
}  // namespace sigmax
