// Any bytes are a recording whose rows have finite numbers, or an error that names the file. The first byte tells
// whether rows of several targets are mixed, as for associate, and whether a column tells them apart.

#include "fuzz/memory_file.hpp"
#include "records/recording.hpp"

namespace {

void check(const Row& row, const RecordingReader& recording) {
  require(row.line > 1, "a row stands below the header");
  const AnyDetection& detection = row.detection;
  require(std::isfinite(detection.time), "a time is finite");
  require(detection.size >= 0 && detection.size <= 6, "a detection has at most six numbers");
  for (std::size_t i = 0; row.measured() && i < static_cast<std::size_t>(detection.size); ++i)
    require(std::isfinite(detection.z[i]), "what is measured is finite");
  for (const double x : row.truth.value_or(Position{})) require(std::isfinite(x), "a truth is finite");
  require(recording.has_tracks() || row.track.empty(), "a label stands in its column");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  static const MemoryFile file;
  RecordingOptions options;
  options.file = file.holding({reinterpret_cast<const char*>(data) + 1, size - 1}).string();
  options.mixed = (data[0] & 1) != 0;
  if ((data[0] & 2) != 0) options.track_id = "label";
  try {
    RecordingReader recording(options);
    double last = -INFINITY;
    for (Row row; recording.next(row);) {
      check(row, recording);
      if (!options.mixed) continue;
      require(row.detection.time >= last, "times of mixed rows never go back");
      last = row.detection.time;
    }
  } catch (const InputError& error) {
    require(std::string_view(error.what()).starts_with(options.file), "an error names the file");
  } catch (const UsageError& error) {
    require(error.what()[0] != '\0', "an error says something");
  }
  return 0;
}
