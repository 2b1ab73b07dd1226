#include "support/gnuplot.hpp"

#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <span>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "support/error.hpp"
#include "support/unnamed_file.hpp"

namespace sigmax::apps {
namespace {

std::string contents(const UnnamedFile& file) {
  std::string text(file.size(), ' ');
  file.read(0, std::as_writable_bytes(std::span(text)));
  return text;
}

/// What gnuplot writes when it reads the script; nothing where there is no gnuplot.
std::string run(const std::string& script) {
  const UnnamedFile in("gnuplot"), out("gnuplot"), complaints("gnuplot");
  in.write(0, std::as_bytes(std::span(script)));
  posix_spawn_file_actions_t streams;
  ::posix_spawn_file_actions_init(&streams);
  int to = 0;
  for (const UnnamedFile* file : {&in, &out, &complaints})
    ::posix_spawn_file_actions_adddup2(&streams, file->descriptor(), to++);
  std::string name = "gnuplot", no_settings = "-d", standard_input = "-";
  std::array<char*, 4> arguments{name.data(), no_settings.data(), standard_input.data(), nullptr};
  pid_t child = 0;
  const int failure = ::posix_spawnp(&child, name.c_str(), &streams, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&streams);
  if (failure != 0)
    throw UsageError(message({.what = "gnuplot, which draws the plots, cannot be started: " + reason(failure),
                              .remedy = "install it (Debian: gnuplot-nox), or leave the plots out"}));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error("gnuplot failed: " + printable(contents(complaints), true));
  return contents(out);
}

/// Takes the time of day out of a PDF, in whose tables places are counted.
void blank_date(std::string& pdf) {
  const auto from = pdf.find("/CreationDate (");
  if (from == std::string::npos) return;
  const auto to = pdf.find(')', from);
  std::fill(pdf.begin() + static_cast<std::ptrdiff_t>(from), pdf.begin() + static_cast<std::ptrdiff_t>(to) + 1, ' ');
}

}  // namespace

Gnuplot::Gnuplot() { run(""); }

std::string Gnuplot::svg(const Picture& picture) const {
  constexpr double pixels_per_cm = 42.0;
  return run(fmt::format(
      "set terminal svg size {:.0f},{:.0f} noenhanced font 'sans-serif,9' fontscale 1.45 background 'white'\n{}",
      pixels_per_cm * picture.width_cm, pixels_per_cm * picture.height_cm, picture.script));
}

std::string Gnuplot::pdf(const Picture& picture) const {
  std::string document = run(fmt::format("set terminal pdfcairo size {}cm,{}cm noenhanced font 'sans,9'\n{}",
                                         picture.width_cm, picture.height_cm, picture.script));
  blank_date(document);
  return document;
}

std::string in_gnuplot(std::string_view text) {
  using Json = nlohmann::json;
  const Json sound = Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace));
  std::string quoted = "'";
  for (const char letter : sound.get<std::string>()) {
    if (letter == '\'') quoted += '\'';
    quoted += static_cast<unsigned char>(letter) < ' ' || letter == '\x7F' ? ' ' : letter;
  }
  return quoted + "'";
}

}  // namespace sigmax::apps
