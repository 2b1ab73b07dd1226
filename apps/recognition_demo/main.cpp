#include "shell/command_line.hpp"

namespace sigmax::apps {

// One subcommand a file: each adds its options, and does its work when it was asked for.
AddSubcommand add_esm, add_train, add_classify, add_evaluate;

}  // namespace sigmax::apps

int main(int argc, char** argv) {
  using namespace sigmax::apps;
  constexpr const char* usage =
#include "recognition_demo/usage.txt"
      ;
  return run_command_line(
      {"recognition_demo",
       "Recognises patterns by sigma inference (probabilities), max inference (possibilities) and sigma-max inference "
       "(both).",
       {add_esm, add_train, add_classify, add_evaluate},
       "esm",
       usage},
      argc, argv);
}
