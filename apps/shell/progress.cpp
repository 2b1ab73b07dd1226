#include "shell/progress.hpp"

#include <atomic>
#include <cmath>
#include <exception>
#include <map>
#include <thread>

#include <sys/ioctl.h>

#include "shell/files.hpp"
#include "shell/text.hpp"

namespace sigmax::apps {

int threads_or_all(int asked) {
  return asked > 0 ? asked : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

void in_parallel(std::size_t count, int threads, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  std::mutex failing;
  std::map<std::size_t, std::exception_ptr> failures;
  const auto take = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        next = count;
        const std::lock_guard lock(failing);
        failures.emplace(i, std::current_exception());
      }
    }
  };
  {
    std::vector<std::jthread> workers;
    for (int t = 1; t < std::min(threads, static_cast<int>(std::min<std::size_t>(count, 4096))); ++t)
      workers.emplace_back(take);
    take();
  }
  if (!failures.empty()) std::rethrow_exception(failures.begin()->second);
}

namespace {

constexpr auto period = std::chrono::milliseconds{100};
constexpr std::size_t longest_bar = 40;

std::string remaining(double seconds) {
  if (seconds < 90.0) return fmt::format("{:.0f} s left", std::ceil(seconds));
  if (seconds < 5400.0) return fmt::format("{:.0f} min left", std::ceil(seconds / 60.0));
  return fmt::format("{:.1f} h left", seconds / 3600.0);
}

}  // namespace

std::size_t columns_of(int terminal) {
  winsize size{};
  if (::ioctl(terminal, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return terminal_width;
  return size.ws_col;
}

Progress::Progress(std::string_view label, std::uint64_t total, bool quiet, int terminal)
    : label_(printable(label)),
      total_(total),
      terminal_(terminal),
      silent_(quiet || ::isatty(terminal) == 0),
      next_(start_ + period) {}

void Progress::advance(std::uint64_t work) {
  const std::lock_guard lock{advancing_};
  done_ += work;
  const auto now = silent_ || finished_ ? start_ : Clock::now();
  if (now < next_) return;
  next_ = now + period;
  // A line as wide as the terminal would wrap. One that went away is no reason to stop the work.
  const std::string text = line(label_, done_, total_, now - start_, columns_of(terminal_) - 1);
  const std::size_t width = display_width(text), left_over = shown_ > width ? shown_ - width : 0;
  write_all(terminal_, "\r" + text + std::string(left_over, ' ') + std::string(left_over, '\b'));
  shown_ = width;
}

void Progress::finish() {
  const std::lock_guard lock{advancing_};
  if (!std::exchange(finished_, true) && shown_ > 0) write_all(terminal_, "\r" + std::string(shown_, ' ') + "\r");
}

std::string Progress::line(std::string_view label, std::uint64_t done, std::uint64_t total,
                           std::chrono::duration<double> elapsed, std::size_t width) {
  if (total == 0) return std::string{label.substr(0, width)};
  const double part = std::min(1.0, static_cast<double>(done) / static_cast<double>(total));
  std::string state = fmt::format("{:3.0f} %", std::floor(100.0 * part));
  if (part > 0.0) state += ", " + remaining(elapsed.count() * (1.0 - part) / part);
  const std::size_t rest = display_width(label) + state.size() + 4;
  if (width < rest + 4) return state.substr(0, width);
  const std::size_t bar = std::min(longest_bar, width - rest);
  const auto full = static_cast<std::size_t>(part * static_cast<double>(bar));
  return fmt::format("{} [{}{}] {}", label, std::string(full, '#'), std::string(bar - full, '.'), state);
}

}  // namespace sigmax::apps
