#include "reconstruct/calibration_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <string>

#include "cli/signal_handler.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/reconstruction/calibration.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

/// "2=b.yml": of image 2.
struct GivenCalibration {
  std::optional<int> image = {};
  fs::path name;
};

GivenCalibration given_calibration(const fs::path& text_path) {
  const std::string text = text_path.string();
  const std::size_t mark = text.find('=');
  if (mark == std::string::npos || fs::exists(text_path)) return {{}, text_path};
  int id = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + mark, id);
  if (error != std::errc() || end != text.data() + mark || id < 0) return {{}, text_path};
  return {id, text.substr(mark + 1)};
}

Lens lens_of(const BopImage& image, const fs::path& name) {
  return read_calibration(name, image.intrinsics.width, image.intrinsics.height);
}

std::vector<Lens> lenses_by_id(const BopScene& scene, const std::vector<GivenCalibration>& all) {
  std::map<int, fs::path> by_id;
  for (const auto& [image, name] : all) {
    if (!image) {
      throw bad_input("calibration", fmt::format("{} has no image's id in front, and others have; "
                                                 "expected all as ID=FILE, or none",
                                                 name.string()));
    }
    if (!by_id.emplace(*image, name).second) {
      throw bad_input("calibration", fmt::format("image {} has two calibrations; expected one for "
                                                 "each",
                                                 *image));
    }
  }
  std::vector<Lens> lenses;
  for (const BopImage& image : scene.images) {
    const auto found = by_id.find(image.id);
    if (found == by_id.end()) {
      throw bad_input("calibration", fmt::format("image {} has none; expected one for each image: "
                                                 "{}=FILE",
                                                 image.id, image.id));
    }
    lenses.push_back(lens_of(image, found->second));
  }
  return lenses;
}

}  // namespace

std::vector<Lens> lenses_of(const BopScene& scene, const std::vector<fs::path>& calibrations) {
  const ReadingPhase reading;
  std::vector<GivenCalibration> given;
  for (const fs::path& text : calibrations) given.push_back(given_calibration(text));
  if (std::ranges::any_of(given, [](const auto& one) { return one.image.has_value(); })) {
    return lenses_by_id(scene, given);
  }
  if (given.size() > 1 && given.size() != scene.images.size()) {
    throw bad_input("calibration",
                    fmt::format("found {} files for {} images; expected one for all cameras, one "
                                "for each image in the order of their ids, or ID=FILE for each",
                                given.size(), scene.images.size()));
  }
  std::vector<Lens> lenses;
  for (const BopImage& image : scene.images) {
    if (given.empty()) {
      lenses.emplace_back(image.intrinsics, Distortion{}, image.place);
    } else if (given.size() == 1 && !lenses.empty()) {
      const Intrinsics &first = lenses.front().intrinsics(), &now = image.intrinsics;
      const bool same_size = first.width == now.width && first.height == now.height;
      lenses.push_back(same_size ? lenses.front() : lens_of(image, given.front().name));
    } else {
      lenses.push_back(lens_of(image, given[given.size() == 1 ? 0 : lenses.size()].name));
    }
  }
  return lenses;
}

std::vector<fs::path> calibration_files(const std::vector<fs::path>& calibrations) {
  std::vector<fs::path> files;
  for (const fs::path& text : calibrations) {
    const fs::path file = calibration_name(given_calibration(text).name).file;
    if (std::ranges::find(files, file) == files.end()) files.push_back(file);
  }
  return files;
}

}  // namespace vantage
