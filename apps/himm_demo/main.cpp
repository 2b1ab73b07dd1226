#include "himm_demo/subcommands.hpp"
#include "support/command_line.hpp"

int main(int argc, char** argv) {
  using namespace sigmax::apps;
  return run_command_line(
      {"himm_demo",
       "Tracks manoeuvring targets by the interacting multiple-model filter with a random mode (IMM) and with a fuzzy "
       "mode (HIMM).",
       {add_simulate, add_reproduce, add_sweep, add_merge, add_track, add_tune, add_keys},
       "simulate"},
      argc, argv);
}
