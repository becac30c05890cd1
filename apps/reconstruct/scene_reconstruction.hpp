#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reconstruct/observed_scene.hpp"
#include "reconstruct/support/object_support.hpp"
#include "vantage/reconstruction/check_scene.hpp"
#include "vantage/reconstruction/reconstruct.hpp"

namespace vantage {

enum class ReconstructionMethod { svd, pnp, voting };

/// The methods' names on the command line, in the order of the enumeration.
inline const std::vector<std::string> kReconstructionMethods = {"svd", "pnp", "voting"};

/// @throws Error bad_input, "--method" as the place, for another name.
ReconstructionMethod reconstruction_method_of(const std::string& name);

/// How to reconstruct.
struct SceneReconstructionOptions {
  ReconstructionMethod method = ReconstructionMethod::pnp;
  ObserveOptions observe = {};
  ReconstructOptions options = {};
  /// Without types to recognise, the poses of cameras that a board tells are enough of a result.
  bool cameras_suffice = false;
  bool depth_is_pinhole = false;  ///< see `depth_cameras`
};

/// What stands in the recorded scene.
struct SceneReconstruction {
  ObservedScene observed;
  Reconstruction result;
  double reconstruct_s = 0;
  SceneSupport support = {};
};

/// One of the library's methods, by name.
Reconstruction reconstruct(ReconstructionMethod method, std::span<const CameraView> views,
                           const KnowledgeBase& knowledge, const ReconstructOptions& options = {},
                           const StopToken& stop = {});

/// @throws Error bad_input if no camera could be located, with each one's reason.
void check_cameras(const BopScene& scene, const ObservedScene& observed);

/// What the workcell and the located cameras say of the scene beside its objects.
SceneKnowledge scene_knowledge(const Workcell& workcell, const ObservedScene& observed);

/// Whether the workcell has types that can be recognised.
/// @throws Error bad_input if not, unless it has a board and `cameras_suffice`.
bool check_knowledge(const Workcell& workcell, bool cameras_suffice);

/// Detects, locates and reconstructs. Runs in the caller's task arena.
/// @throws Error bad_input as `observe` does; if no camera could be located, with each one's
/// reason; and for a workcell whose knowledge base has no type with features, unless it has a board
/// and `cameras_suffice`.
SceneReconstruction reconstruct_scene(const BopScene& scene, const Workcell& workcell,
                                      const SceneReconstructionOptions& settings,
                                      const StopToken& stop = {});

}  // namespace vantage
