#include "himm_demo/subcommands.hpp"

int main(int argc, char** argv) {
  using namespace sigmax::apps;
  constexpr const char* usage =
#include "himm_demo/usage.txt"
      ;
  return run_command_line({"himm_demo",
                           "Tracks manoeuvring targets by the interacting multiple-model filter with a random mode "
                           "(IMM) and with a fuzzy mode (HIMM).",
                           subcommands, "simulate", usage},
                          argc, argv);
}
