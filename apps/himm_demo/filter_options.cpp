#include "himm_demo/filter_options.hpp"

#include <CLI/CLI.hpp>

#include <fmt/core.h>

#include "himm_demo/filter_keys.hpp"

namespace sigmax::apps {

void add_filter_options(CLI::App& app, std::string& config, std::vector<std::string>& sets, bool& print_config) {
  app.add_option("--config", config, "Settings in TOML")->type_name("FILE.toml");
  app.add_option("--set", sets, "One setting, as lift=unbiased; may be repeated")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  app.add_flag("--print-config", print_config, "Print the settings in force and stop");
}

void add_keys(CLI::App& program, const std::string&) {
  CLI::App& app = *program.add_subcommand("keys", "Lists the keys of --config and --set.");
  app.footer("Examples:\n  himm_demo keys\n  himm_demo keys | grep -A 3 gate");
  app.callback([] { fmt::print("{}", key_table()); });
}

}  // namespace sigmax::apps
