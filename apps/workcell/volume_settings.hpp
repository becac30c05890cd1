#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

#include "vantage/volume/volume_options.hpp"

namespace vantage {

/// `mesh` or `voxels`, which the command line and the workcell's schema have made sure of.
OccluderMode occluder_mode_of(std::string_view name);

/// The settings that were used, for plan.json.
nlohmann::ordered_json config_of(const VolumeOptions& options);

}  // namespace vantage
