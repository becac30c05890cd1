#pragma once

#include <string>
#include <vector>

#include "reconstruct/scene_reconstruction.hpp"
#include "vantage/raycore/world_model.hpp"

namespace vantage {

/// Warnings about the location of cameras: those that were not located, and what contradicts the
/// others.
std::vector<std::string> camera_warnings(const BopScene& scene, const ObservedScene& observed);

/// Warnings about objects that were found. `objects` have their names, in the order of the
/// result's.
std::vector<std::string> object_warnings(const Reconstruction& result,
                                         const std::vector<KnownObject>& objects);

/// Warnings about a workcell's board and types: their meshes' files, and sizes that are likely
/// millimetres.
std::vector<std::string> type_warnings(const Workcell& workcell);

}  // namespace vantage
