#include "plan/plan_world.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "options/unused_options.hpp"
#include "reconstruct/world_file.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

bool is_method(const std::string& name) {
  return std::find(kReconstructionMethods.begin(), kReconstructionMethods.end(), name) !=
         kReconstructionMethods.end();
}

/// What an empty `ObjectSource::objects` stands for.
std::string usual_source(const BopScene& scene, const Workcell& workcell) {
  const auto& types = workcell.knowledge->types();
  const bool recognisable = std::any_of(types.begin(), types.end(),
                                        [](const TypePtr& t) { return !t->features.empty(); });
  const bool pictures = std::any_of(scene.images.begin(), scene.images.end(),
                                    [](const BopImage& image) { return !image.color.empty(); });
  return workcell.known_objects.empty() && recognisable && pictures ? "pnp" : "given";
}

DepthCamera observer(const BopImage& image, const Pose& T_world_cam) {
  return {std::to_string(image.id),
          PinholeCamera(image.intrinsics, T_world_cam, image.range, image.place), image.depth};
}

void use_given(const BopScene& scene, const Workcell& workcell, PlanWorld& plan) {
  plan.world.objects = known(workcell.known_objects);
  for (const BopImage& image : scene.images) {
    plan.world.cameras.push_back({std::to_string(image.id), image.camera(), image.depth});
  }
}

void use_reconstruction(const BopScene& scene, const Workcell& workcell,
                        const SceneReconstructionOptions& options, const StopToken& stop,
                        PlanWorld& plan) {
  const SceneReconstruction found = reconstruct_scene(scene, workcell, options, stop);
  std::vector<std::string> taken;
  for (const PlacedObject& object : workcell.static_structures) taken.push_back(object.name);
  plan.world.objects = known_objects(found.result, taken);
  for (std::size_t i = 0; i < scene.images.size(); ++i) {
    const auto& pose = found.observed.views[i].T_world_cam;
    if (pose) {
      plan.world.cameras.push_back(observer(scene.images[i], *pose));
    } else {
      plan.warnings.push_back(fmt::format("skipping image {}: {}", scene.images[i].id,
                                          found.observed.locations[i].reason));
    }
  }
  plan.files.insert(plan.files.end(), found.observed.files.begin(), found.observed.files.end());
}

void use_file(const BopScene& scene, const Workcell& workcell, const fs::path& file,
              PlanWorld& plan) {
  if (!fs::exists(file)) {
    throw bad_input("--objects", fmt::format("found {}; expected given, pnp, voting or svd, or a "
                                             "world.json that is there",
                                             file.string()));
  }
  WorldFile world = read_world(file, *workcell.knowledge);
  plan.world.objects = std::move(world.objects);
  for (const BopImage& image : scene.images) {
    const auto found = world.T_world_cam.find(image.id);
    if (found == world.T_world_cam.end()) {
      throw bad_input(file.string(), fmt::format("it says nothing of image {}; reconstruct the "
                                                 "same images that are to be planned with",
                                                 image.id));
    }
    if (found->second) {
      plan.world.cameras.push_back(observer(image, *found->second));
    } else {
      plan.warnings.push_back(
          fmt::format("skipping image {}: {} has no pose of its camera", image.id, file.string()));
    }
  }
  plan.files.push_back(file);
}

/// Of options that say how to find objects, where none are to be found.
void refuse_unused_search(const ReconstructCommandOptions& how) {
  const std::string needs = "--objects pnp, voting or svd";
  const ReconstructCommandOptions usual;
  refuse_unused(how.cameras == "board", false, "--cameras board", needs);
  refuse_unused(!how.features.empty(), false, "--features", needs);
  refuse_unused(how.inlier_px != usual.inlier_px, false, "--inlier-px", needs);
  refuse_unused(how.no_ambiguous, false, "--no-ambiguous", needs);
}

}  // namespace

PlanWorld load_plan_world(const fs::path& dataset, const std::vector<int>& images,
                          const Workcell& workcell, const ObjectSource& source,
                          const StopToken& stop) {
  SceneReconstructionOptions options = options_of(source.how);
  const BopScene scene = load_dataset(dataset, workcell, images, options.observe);
  PlanWorld plan{{}, source.objects, scene.files, scene.warnings, scene.images.front().intrinsics};
  if (plan.objects.empty()) plan.objects = usual_source(scene, workcell);
  plan.world.static_structures = known(workcell.static_structures);
  if (plan.objects == "given") {
    refuse_unused_search(source.how);
    use_given(scene, workcell, plan);
  } else if (is_method(plan.objects)) {
    options.method = reconstruction_method_of(plan.objects);
    use_reconstruction(scene, workcell, options, stop, plan);
  } else {
    refuse_unused_search(source.how);
    use_file(scene, workcell, plan.objects, plan);
  }
  return plan;
}

}  // namespace vantage
