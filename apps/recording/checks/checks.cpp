#include "recording/checks/checks.hpp"

namespace sigmax::apps {

void RecordingChecks::see(const Row&, const LocalFrame*) {}

std::vector<std::string> RecordingChecks::findings() const { return {}; }

}  // namespace sigmax::apps
