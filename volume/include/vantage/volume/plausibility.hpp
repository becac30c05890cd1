#pragma once

#include <string>
#include <vector>

#include "vantage/raycore/box.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/world_model.hpp"

namespace vantage {

/// Inconsistencies in a world, in sentences for a user, each with its place and its likely cause: a
/// depth scale that is off by powers of ten, poses the wrong way round or with another convention's
/// axes, intrinsics of another resolution, a camera inside a solid, lengths in millimetres. Such
/// inputs classify and plan without an error, but the result is worthless.
///
/// Looks at samples only: a few thousand pixels of each image, a thousand points of the work area.
/// An empty list does not prove that everything is right.
/// @param voxel_size_m by which objects count as too small to be there.
/// Thread-safe; deterministic.
VANTAGE_API std::vector<std::string> implausibilities(const WorldModel& world, const Box& work_area,
                                                      double voxel_size_m);

/// The same for one camera's intrinsics: those of another resolution than its image. A cropped
/// image, whose principal point may lie outside, is not a fault. Empty: nothing found.
VANTAGE_API std::string resolution_misfit(const Intrinsics& intrinsics);

}  // namespace vantage
