#include "support/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "support/error.hpp"
#include "support/input.hpp"

namespace sigmax::apps {

Option& Option::in(int least, int greatest) { return option_->check(CLI::Range(least, greatest)), *this; }

Option& Option::number_in(double least, double greatest) {
  const std::string range = fmt::format("[{} - {}]", least, greatest);
  const auto check = [=](const std::string& text) -> std::string {
    const auto number = parse_number(text);
    if (number && *number >= least && *number <= greatest) return "";
    return fmt::format("found {}, expected a number in {}", in_quotes(text), range);
  };
  return option_->check(CLI::Validator(check, "FLOAT in " + range)), *this;
}

Option& Option::one_of(const std::vector<int>& values) { return option_->check(CLI::IsMember(values)), *this; }

Option& Option::one_of(const std::vector<std::string>& values) { return option_->check(CLI::IsMember(values)), *this; }

Option& Option::check(const std::function<std::string(const std::string&)>& complaint) {
  return option_->check(CLI::Validator(complaint, "")), *this;
}

Option& Option::shows_default() { return option_->capture_default_str(), *this; }

Option& Option::text(const std::string& text) { return option_->option_text(text), *this; }

Option& Option::type(const std::string& name) { return option_->type_name(name), *this; }

Option& Option::list() { return option_->delimiter(','), *this; }

Option& Option::list_alone() { return option_->delimiter(',')->allow_extra_args(false), *this; }

Option& Option::repeated() { return option_->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll), *this; }

Option& Option::required() { return option_->required(), *this; }

Option& Option::needs(const Option& other) { return option_->needs(other.option_), *this; }

Option& Option::hidden() { return option_->group(""), *this; }

bool Option::given() const { return option_->count() > 0; }

Subcommand::Subcommand(CLI::App& program, const std::string& name, const std::string& meaning)
    : app_(*program.add_subcommand(name, meaning)) {}

template <class Value>
Option Subcommand::option(const std::string& name, Value& value, const std::string& meaning) {
  return Option(app_.add_option(name, value, meaning));
}

template Option Subcommand::option(const std::string&, int&, const std::string&);
template Option Subcommand::option(const std::string&, std::size_t&, const std::string&);
template Option Subcommand::option(const std::string&, double&, const std::string&);
template Option Subcommand::option(const std::string&, std::string&, const std::string&);
template Option Subcommand::option(const std::string&, std::optional<int>&, const std::string&);
template Option Subcommand::option(const std::string&, std::optional<double>&, const std::string&);
template Option Subcommand::option(const std::string&, std::vector<int>&, const std::string&);
template Option Subcommand::option(const std::string&, std::vector<double>&, const std::string&);
template Option Subcommand::option(const std::string&, std::vector<std::string>&, const std::string&);

Option Subcommand::option(const std::string& name, const std::function<void(const std::string&)>& read,
                          const std::string& meaning) {
  const auto refused = [=](const std::string& text) {
    try {
      read(text);
    } catch (const std::invalid_argument& error) {
      throw CLI::ValidationError(name, error.what());
    }
  };
  return Option(app_.add_option_function<std::string>(name, refused, meaning));
}

Option Subcommand::choice(const std::string& name, const std::vector<std::string>& names,
                          const std::function<void(int)>& chosen, const std::string& meaning) {
  std::map<std::string, int> places;
  for (const std::string& one : names) places.emplace(one, static_cast<int>(places.size()));
  return Option(app_.add_option_function<int>(name, chosen, meaning)->transform(CLI::CheckedTransformer(places)));
}

Option Subcommand::flag(const std::string& name, bool& value, const std::string& meaning) {
  return Option(app_.add_flag(name, value, meaning));
}

Option Subcommand::flag(const std::string& name, std::string& value, const std::string& meaning) {
  return Option(app_.add_flag(name, value, meaning));
}

Option Subcommand::triple(const std::string& name, std::optional<std::array<double, 3>>& values,
                          const std::string& meaning) {
  const auto take = [&values](const std::vector<double>& given) { values = {given[0], given[1], given[2]}; };
  return Option(app_.add_option_function<std::vector<double>>(name, take, meaning)->delimiter(',')->expected(3));
}

Option Subcommand::option(const std::string& name) { return Option(app_.get_option(name)); }

void Subcommand::footer(const std::string& text) { app_.footer(text); }

void Subcommand::run(const std::function<void()>& work) { app_.callback(work); }

void run_again(const std::vector<void (*)(CLI::App& program, const std::string& command)>& subcommands,
               const std::string& program, std::vector<std::string> arguments) {
  CLI::App app{"", program};
  std::string command = program;
  for (const std::string& argument : arguments) command += " " + argument;
  for (const auto add : subcommands) add(app, command);
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
  app.parse(arguments);
}

}  // namespace sigmax::apps
