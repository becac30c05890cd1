#pragma once

#include <vector>

#include "metrics/bop/true_object.hpp"
#include "vantage/reconstruction/bop_scene.hpp"
#include "workcell/workcell.hpp"

namespace vantage {

/// The true objects of a recorded scene, of the types of the workcell's knowledge base.
///
/// A simulated cell's known objects, random ones with them; where the workcell has none, the
/// dataset's scene_gt.json, whose obj_id are BOP models of the knowledge base. There, an object
/// that several images name is the same if its poses agree to a tenth of its diameter.
/// @param workcell with its random objects placed.
/// @param files gets scene_gt.json if that was read.
/// @throws Error bad_input if neither says anything, for a scene_gt.json that is not as BOP has it,
/// and for an obj_id of no type.
std::vector<TrueObject> true_objects(const Workcell& workcell, const BopScene& scene,
                                     std::vector<std::filesystem::path>& files);

}  // namespace vantage
