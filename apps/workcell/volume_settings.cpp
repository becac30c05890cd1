#include "workcell/volume_settings.hpp"

namespace vantage {

OccluderMode occluder_mode_of(std::string_view name) {
  return name == "voxels" ? OccluderMode::voxels : OccluderMode::mesh;
}

nlohmann::ordered_json config_of(const VolumeOptions& options) {
  return {{"occluders", options.occluders == OccluderMode::voxels ? "voxels" : "mesh"},
          {"anti_alias", options.anti_aliased()},
          {"band_sigmas", options.band_sigmas},
          {"noise",
           {{"focal_px", options.noise.focal_px},
            {"baseline_m", options.noise.baseline_m},
            {"subpixel_px", options.noise.subpixel_px}}}};
}

}  // namespace vantage
