#include "track/sequence_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "documents/document_value.hpp"
#include "documents/json_document.hpp"
#include "documents/schema_check.hpp"
#include "documents/schemas.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/reconstruction/bop_scene.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

SequenceInstant read_instant(const fs::path& folder, const Value& value) {
  SequenceInstant instant{folder / value["folder"].as<std::string>(), value["time_s"].as<double>()};
  if (!is_bop_scene(instant.folder)) {
    throw value["folder"].error(
        fmt::format("{} has no scene_camera.json; expected a BOP scene folder beside this file",
                    instant.folder.string()));
  }
  if (!value.has("images")) return instant;
  for (const Value& image : value["images"].elements()) instant.images.push_back(image.as<int>());
  return instant;
}

std::vector<SequenceInstant> listed_instants(const fs::path& file) {
  const Document document = read_document(file);
  check_schema(document, sequence_schema());
  const Value root(document);
  std::vector<SequenceInstant> instants;
  for (const Value& value : root["instants"].elements()) {
    instants.push_back(read_instant(file.parent_path(), value));
    const std::size_t count = instants.size();
    if (count > 1 && instants[count - 1].time_s <= instants[count - 2].time_s) {
      throw value["time_s"].error(fmt::format("found {}; expected a time after {}, the last one's",
                                              instants[count - 1].time_s,
                                              instants[count - 2].time_s));
    }
  }
  return instants;
}

bool is_number(const std::string& name) {
  return !name.empty() && name.size() <= 9 &&
         std::ranges::all_of(name, [](char c) { return c >= '0' && c <= '9'; });
}

std::vector<SequenceInstant> numbered_instants(const fs::path& folder, double period_s) {
  std::map<int, fs::path> numbered;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (!is_number(name) || !is_bop_scene(entry.path())) continue;
    const auto [other, is_new] = numbered.try_emplace(std::stoi(name), entry.path());
    if (!is_new) {
      throw bad_input(entry.path().string(), fmt::format("is instant {}, and so is {}; remove one",
                                                         other->first, other->second.string()));
    }
  }
  std::vector<SequenceInstant> instants;
  for (const auto& [number, path] : numbered) instants.push_back({path, number * period_s});
  return instants;
}

}  // namespace

std::vector<SequenceInstant> read_sequence(const fs::path& folder, double period_s) {
  if (!fs::is_directory(folder)) {
    throw bad_input(folder.string(),
                    "the folder does not exist; expected one with a BOP scene "
                    "folder for each instant");
  }
  const fs::path file = folder / "sequence.json";
  std::vector<SequenceInstant> instants =
      fs::exists(file) ? listed_instants(file) : numbered_instants(folder, period_s);
  if (!instants.empty()) return instants;
  throw bad_input(
      folder.string(),
      is_bop_scene(folder)
          ? "is a single BOP scene; expected a folder of them, named 000000, 000001, …, "
            "or a sequence.json that says which images were taken when"
          : "has no BOP scene folders named 000000, 000001, …, and no sequence.json");
}

}  // namespace vantage
