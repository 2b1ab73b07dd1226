#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include "support/program.hpp"

namespace sigmax::apps {

/// The most memory that a run of a program had, in KiB; it must end well.
inline long peak_memory(const std::string& path, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), program::chosen(path));
  std::vector<char*> words;
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    ::setenv("ASAN_OPTIONS", "quarantine_size_mb=1", 1);  // else a sanitizer keeps what is freed
    ::dup2(::open("/dev/null", O_WRONLY), STDOUT_FILENO);
    ::execv(words.front(), words.data());
    ::_exit(127);
  }
  int status = 0;
  rusage usage{};
  ::wait4(child, &status, 0, &usage);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  return usage.ru_maxrss;
}

}  // namespace sigmax::apps
