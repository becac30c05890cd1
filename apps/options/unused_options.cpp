#include "options/unused_options.hpp"

#include <fmt/format.h>

#include <utility>

#include "process/usage_error.hpp"

namespace vantage {
namespace {

bool has(const nlohmann::json& given, const char* group, const char* key) {
  return given.contains(group) && given[group].contains(key);
}

void check_power(const nlohmann::json& given, const ViewOptions& views) {
  const bool by_depth =
      views.method == ShadowMethod::kName ||
      (views.method == MeshMethod::kName && views.mesh_method().weight == MeshWeight::depth);
  refuse_unused(given.contains("depth_power"), by_depth, "--depth-power",
                views.method == MeshMethod::kName ? "--mesh-weight depth"
                                                  : "--method shadow or --method mesh");
}

}  // namespace

void refuse_unused(bool given, bool used, const std::string& option, const std::string& needs) {
  if (!given || used) return;
  throw UsageError(
      fmt::format("{}: does nothing without {}; give both, or leave it out", option, needs));
}

void refuse_useless(bool given, bool overridden, const std::string& option, const std::string& by) {
  if (!given || !overridden) return;
  throw UsageError(fmt::format("{}: does nothing with {}; leave one of them out", option, by));
}

void refuse_unused_fields(const nlohmann::json& given, const ViewOptions& views,
                          const VolumeOptions& volume) {
  const bool mesh = views.method == MeshMethod::kName;
  refuse_unused(has(given, "mesh", "weight"), mesh, "--mesh-weight", "--method mesh");
  refuse_unused_mesh(given, mesh, "--method mesh");
  check_power(given, views);
  refuse_unused(given.contains("value"), views.method == VoxelMethod::kName, "--value",
                "--method voxel");
  refuse_unused_servo(given, views.servo);
  refuse_unused(has(given, "travel", "from_m"), views.travel_weight_per_m > 0, "--from",
                "--travel-weight W above 0");
  refuse_unused(has(given, "travel", "weight_per_m"), views.from_m.has_value(), "--travel-weight",
                "--from X Y Z");
  for (const auto& [key, option] : {std::pair("least_gain_m3", "--least-gain"),
                                    std::pair("least_gain_share", "--least-gain-share")}) {
    refuse_unused(has(given, "views", key), views.views.most > 1, option, "--views N of 2 or more");
  }
  refuse_unused_filter(given, volume);
}

void refuse_unused_mesh(const nlohmann::json& given, bool used, const std::string& needs) {
  MeshMethod described;
  for (const Field& field : fields_of(described).fields) {
    refuse_unused(has(given, "mesh", field.key.c_str()), used, field.option, needs);
  }
}

void refuse_unused_servo(const nlohmann::json& given, const ServoOptions& servo) {
  refuse_unused(has(given, "servo", "image_width"), servo.iterations > 0, "--servo-width",
                "--servo N");
}

void refuse_unused_filter(const nlohmann::json& given, const VolumeOptions& volume) {
  refuse_unused(has(given, "volume", "filter_m"), volume.filter != FalseShadowFilter::off,
                "--filter-edge", "--filter on or auto");
}

}  // namespace vantage
