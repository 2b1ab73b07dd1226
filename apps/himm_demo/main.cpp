#include "shell/command_line.hpp"

namespace sigmax::apps {

// One subcommand a file: each adds its options, and does its work when it was asked for.
AddSubcommand add_simulate, add_reproduce, add_sweep, add_track, add_associate, add_tune, add_keys;

}  // namespace sigmax::apps

int main(int argc, char** argv) {
  using namespace sigmax::apps;
  constexpr const char* usage =
#include "himm_demo/usage.txt"
      ;
  return run_command_line({"himm_demo",
                           "Tracks manoeuvring targets by the interacting multiple-model filter with a random mode "
                           "(IMM) and with a fuzzy mode (HIMM).",
                           {add_simulate, add_reproduce, add_sweep, add_track, add_associate, add_tune, add_keys},
                           "simulate",
                           usage},
                          argc, argv);
}
