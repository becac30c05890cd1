#pragma once

#include "vantage/reconstruction/support.hpp"
#include "workcell/workcell.hpp"

namespace vantage {

/// What holds the objects of a scene.
struct SceneSupport {
  std::vector<ObjectSupport> objects;   ///< one element for each; empty where it was not looked for
  std::vector<KnownObject> structures;  ///< that it counts
};

/// Judges whether the objects that were found can be at rest in the workcell, pulls those that
/// stand to what they stand on, and makes those that cannot stand less likely, with a warning. Does
/// nothing where the workcell has neither a floor nor structures.
/// @param depth what measures the space; may be empty.
SceneSupport check_support(const Workcell& workcell, std::vector<DepthCamera> depth,
                           std::span<ReconstructedObject> objects);

}  // namespace vantage
