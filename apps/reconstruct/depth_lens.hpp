#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vantage/reconstruction/bop_scene.hpp"
#include "workcell/workcell.hpp"

namespace vantage {

/// Makes of a scene's depth images, which cameras here take for a pinhole's, what the lens of
/// `calibrations` says that they are. Where nobody said how it is, they stay as they are, with a
/// warning if the lens distorts by more than a pixel.
/// @param calibrations as for `lenses_of`; none: nothing is done.
/// @throws Error bad_input as `lenses_of` does.
void apply_depth_lens(DepthLens kind, const std::vector<std::filesystem::path>& calibrations,
                      BopScene& scene);

/// @throws Error bad_input, with `where` as the place, for another name than auto, pinhole and
/// calibrated.
DepthLens depth_lens_of(const std::string& name, const std::string& where);

}  // namespace vantage
