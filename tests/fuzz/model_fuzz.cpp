// Any bytes are a model of recognition_demo whose counts can be used, and which reads the same when written out again,
// or an error that names the file.

#include "fuzz/memory_file.hpp"
#include "recognition_demo/learning.hpp"
#include "shell/files.hpp"

namespace {

std::string written(const SavedModel& saved, const MemoryFile& place) {
  write_model(saved, place.path());
  return read_text(place.path());
}

/// What classifiers are made of: each constructor proves its table.
void check_relations(const TableModel& model) {
  const auto features = model.features.size();
  require(pattern_prior(model.counts).variable().size() >= 2, "there are classes to choose from");
  require(learned_relations(model.counts, model.options.smoothing).size() == features, "a relation a feature");
  require(learned_relations(model.counts, model.options.smoothing, RatioScale{}).size() == features,
          "a possibility a feature");
  require(learned_relations(model.counts, model.options.smoothing, DuboisPrade{}).size() == features,
          "another possibility a feature");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const MemoryFile place;
  std::optional<SavedModel> file;
  try {
    file = read_model(place.holding({reinterpret_cast<const char*>(data), size}));
  } catch (const InputError& error) {
    require(std::string_view{error.what()}.starts_with(place.path().native()), "an error names the file");
    return 0;
  }
  check_relations(file->model);
  const std::string text = written(*file, place);
  require(written(read_model(place.path()), place) == text, "a model reads the same when written out again");
  return 0;
}
