#include "dataset/bop_sensors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "vantage/raycore/error.hpp"

namespace vantage::reconstruction::detail {

std::vector<BopSensor> sensors_of(const std::filesystem::path& folder) {
  constexpr std::string_view kStart = "scene_camera", kEnd = ".json";
  constexpr std::size_t kMaxSensors = 1000;
  std::vector<BopSensor> sensors;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const bool fits = name.size() >= kStart.size() + kEnd.size() && name.starts_with(kStart) &&
                      name.ends_with(kEnd) && entry.is_regular_file();
    if (!fits) continue;
    const std::string suffix =
        name.substr(kStart.size(), name.size() - kStart.size() - kEnd.size());
    if (suffix.empty() || suffix.front() == '_') sensors.push_back({folder / name, suffix});
  }
  if (sensors.size() > kMaxSensors) {
    throw bad_input(folder.string(), fmt::format("has {} files scene_camera_*.json; expected one "
                                                 "for each sensor, and at most {}",
                                                 sensors.size(), kMaxSensors));
  }
  std::ranges::sort(sensors, {}, &BopSensor::suffix);
  for (std::size_t i = 0; i < sensors.size(); ++i) sensors[i].first_id = int(i) * kIdsPerSensor;
  return sensors;
}

}  // namespace vantage::reconstruction::detail
