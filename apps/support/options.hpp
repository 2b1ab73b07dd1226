#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace sigmax::apps {

/// An option that was added, for what else there is to say of it.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  /// @{
  /// What it may be: a whole number or a number in a range, or one of some. (CLI::Range lets NaN pass.)
  Option& in(int least, int greatest);
  Option& number_in(double least, double greatest);
  Option& one_of(const std::vector<int>& values);
  Option& one_of(const std::vector<std::string>& values);
  /// @}
  /// A check of one's own, which returns what is wrong, or nothing.
  Option& check(const std::function<std::string(const std::string&)>& complaint);

  Option& shows_default();                ///< in the help, as it is now
  Option& text(const std::string& text);  ///< instead of type, default and range in the help
  Option& type(const std::string& name);  ///< instead of the type alone
  Option& list();                         ///< its values have commas between
  Option& list_alone();                   ///< and what follows after a blank is none of them
  Option& repeated();                     ///< it takes one value, and may be given again
  Option& required();
  Option& needs(const Option& other);
  Option& hidden();  ///< from the help

  bool given() const;

 private:
  CLI::Option* option_;
};

/// A subcommand and its options, which CLI11 reads; it takes seconds to include, and so only what implements this does.
///
///     Subcommand app(program, "simulate", "Simulated targets.");
///     app.option("--runs", options->runs, "Monte Carlo runs").in(1, 1000).shows_default();
///     app.run([options] { … });
class Subcommand {
 public:
  Subcommand(CLI::App& program, const std::string& name, const std::string& meaning);
  explicit Subcommand(CLI::App& app) : app_(app) {}

  operator CLI::App&() const { return app_; }

  /// An option, or an argument if its name has no dashes, whose value is an int, a size_t, a double, a string, one of
  /// these that may be missing (std::optional), or a vector.
  template <class Value>
  Option option(const std::string& name, Value& value, const std::string& meaning);

  /// One whose text is read by a function, which throws what is wrong.
  Option option(const std::string& name, const std::function<void(const std::string&)>& read,
                const std::string& meaning);

  /// One out of names, which is told by its place among them.
  Option choice(const std::string& name, const std::vector<std::string>& names, const std::function<void(int)>& chosen,
                const std::string& meaning);

  Option flag(const std::string& name, bool& value, const std::string& meaning);
  /// One that may have a value, as --truth{rmse}, and this one without.
  Option flag(const std::string& name, std::string& value, const std::string& meaning);

  /// Three numbers with commas between.
  Option triple(const std::string& name, std::optional<std::array<double, 3>>& values, const std::string& meaning);

  /// One that was added before.
  Option option(const std::string& name);

  void footer(const std::string& text);
  void run(const std::function<void()>& work);

 private:
  CLI::App& app_;
};

/// Runs a subcommand, whose name is the first argument, as if the program had been called with it.
void run_again(const std::vector<void (*)(CLI::App& program, const std::string& command)>& subcommands,
               const std::string& program, std::vector<std::string> arguments);

}  // namespace sigmax::apps
