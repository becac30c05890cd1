#include "reconstruct/scene_reconstruction.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>

#include "vantage/raycore/error.hpp"
#include "vantage/raycore/solids.hpp"
#include "vantage/reconstruction/check_scene.hpp"

namespace vantage {
namespace {

bool is_recognisable(const TypePtr& type) {
  return !type->features.empty();
}

/// The plate of the board, as a thing that hides what is behind it.
KnownObject plate_of(const Board& board) {
  const Eigen::Vector3d size(board.size_m.x(), board.size_m.y(), board.thickness_m);
  return {"the board", std::make_shared<TriangleMesh>(box_solid(size)),
          Pose::from_translation({0, 0, -0.5 * board.thickness_m})};
}

/// The corners of the board's markers that each camera was located by.
std::vector<std::vector<Eigen::Vector3d>> seen_corners(const Board& board,
                                                       const ObservedScene& observed) {
  std::vector<std::vector<Eigen::Vector3d>> seen(observed.views.size());
  for (std::size_t v = 0; v < observed.views.size(); ++v) {
    for (const std::size_t i : observed.locations[v].inliers) {
      for (const ObjectFeature& feature : board.features()) {
        if (feature.key != observed.board[v][i].key) continue;
        const auto points = feature.points();
        seen[v].insert(seen[v].end(), points.begin(), points.end());
      }
    }
  }
  return seen;
}

}  // namespace

SceneKnowledge scene_knowledge(const Workcell& workcell, const ObservedScene& observed) {
  SceneKnowledge knowledge{known(workcell.static_structures)};
  if (!workcell.board) return knowledge;
  knowledge.solids.push_back(plate_of(*workcell.board));
  knowledge.seen_points = seen_corners(*workcell.board, observed);
  return knowledge;
}

bool check_knowledge(const Workcell& workcell, bool cameras_suffice) {
  const auto& types = workcell.knowledge->types();
  if (std::any_of(types.begin(), types.end(), is_recognisable)) return true;
  if (cameras_suffice && workcell.board && !workcell.board->markers.empty()) return false;
  throw bad_input(
      workcell.files.empty() ? "workcell" : workcell.files.front().string(),
      types.empty()
          ? "there is no knowledge_base to recognise objects by; name its file in the workcell"
          : "no type of the knowledge base has features to recognise objects by");
}

void check_cameras(const BopScene& scene, const ObservedScene& observed) {
  std::vector<std::string> reasons;
  for (std::size_t i = 0; i < scene.images.size(); ++i) {
    if (observed.views[i].T_world_cam) return;
    reasons.push_back(
        fmt::format("image {}: {}", scene.images[i].id, observed.locations[i].reason));
  }
  throw bad_input(scene.folder.string(),
                  fmt::format("no camera could be located by the workcell's board: {}",
                              fmt::join(reasons, "; ")));
}

ReconstructionMethod reconstruction_method_of(const std::string& name) {
  const auto found = std::find(kReconstructionMethods.begin(), kReconstructionMethods.end(), name);
  if (found != kReconstructionMethods.end()) {
    return ReconstructionMethod(found - kReconstructionMethods.begin());
  }
  throw bad_input("--method", fmt::format("found {}; expected one of {}", name,
                                          fmt::join(kReconstructionMethods, ", ")));
}

Reconstruction reconstruct(ReconstructionMethod method, std::span<const CameraView> views,
                           const KnowledgeBase& knowledge, const ReconstructOptions& options,
                           const StopToken& stop) {
  switch (method) {
    case ReconstructionMethod::svd:
      return reconstruct_svd(views, knowledge, options, stop);
    case ReconstructionMethod::voting:
      return reconstruct_voting(views, knowledge, options, stop);
    case ReconstructionMethod::pnp:
      break;
  }
  return reconstruct_pnp(views, knowledge, options, stop);
}

SceneReconstruction reconstruct_scene(const BopScene& scene, const Workcell& workcell,
                                      const SceneReconstructionOptions& settings,
                                      const StopToken& stop) {
  const bool has_types = check_knowledge(workcell, settings.cameras_suffice);
  SceneReconstruction all{observe(scene, workcell, settings.observe, stop), {}, 0};
  if (stop.stop_requested()) {
    all.result.stopped = stop.reason();
    return all;
  }
  check_cameras(scene, all.observed);
  if (!has_types) return all;
  const auto start = std::chrono::steady_clock::now();
  all.result =
      reconstruct(settings.method, all.observed.views, *workcell.knowledge, settings.options, stop);
  SceneKnowledge knowledge = scene_knowledge(workcell, all.observed);
  knowledge.depth = depth_cameras(scene, all.observed, settings.depth_is_pinhole);
  reject_contradicted(all.observed.views, knowledge, all.result);
  warn_of_motion(all.observed.views, *workcell.knowledge, settings.options, stop, all.result);
  all.support = check_support(workcell, std::move(knowledge.depth), all.result.objects);
  all.reconstruct_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return all;
}

}  // namespace vantage
