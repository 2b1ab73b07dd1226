#pragma once

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "support/test.hpp"

namespace sigmax::apps {

/// A pseudo-terminal of 60 columns; `seen` is what was written to it.
class Terminal {
 public:
  Terminal() : master_(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)) {
    if (master_ < 0 || ::grantpt(master_) != 0 || ::unlockpt(master_) != 0) return;
    slave_ = ::open(::ptsname(master_), O_RDWR | O_NOCTTY);
    const winsize size{24, 60, 0, 0};
    ::ioctl(master_, TIOCSWINSZ, &size);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  ~Terminal() {
    ::close(slave_);
    ::close(master_);
  }

  bool works() const { return slave_ >= 0; }
  int device() const { return slave_; }

  std::string seen() const {
    std::string text(1 << 16, '\0');
    const auto size = ::read(master_, text.data(), text.size());
    text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return text;
  }

 private:
  int master_;
  int slave_ = -1;
};

}  // namespace sigmax::apps
