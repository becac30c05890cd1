#include "plan/plan_world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "options/unused_options.hpp"
#include "reconstruct/depth_lens.hpp"
#include "reconstruct/scene_warnings.hpp"
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

constexpr const char* kGivenAnd = "given+";

/// A camera for each image whose pose was found; warnings of the others, and of doubtful ones.
void add_located(const BopScene& scene, const ObservedScene& observed, PlanWorld& plan) {
  for (std::size_t i = 0; i < scene.images.size(); ++i) {
    const auto& pose = observed.views[i].T_world_cam;
    if (pose) plan.world.cameras.push_back(observer(scene.images[i], *pose));
  }
  for (std::string& warning : camera_warnings(scene, observed)) {
    plan.warnings.push_back(std::move(warning));
  }
  plan.files.insert(plan.files.end(), observed.files.begin(), observed.files.end());
}

/// Objects from the workcell, and cameras from the dataset; cameras without a pose there are
/// located by the board.
void use_given(const BopScene& scene, const Workcell& workcell, const ObserveOptions& options,
               const StopToken& stop, PlanWorld& plan) {
  plan.world.objects = known(workcell.known_objects);
  const bool all_posed = std::ranges::all_of(
      scene.images, [](const BopImage& image) { return image.T_world_cam.has_value(); });
  const bool ask_board = options.cameras == CameraSource::board ||
                         (options.cameras == CameraSource::automatic && !all_posed);
  if (ask_board && workcell.board) {
    const ObservedScene observed = observe(scene, workcell, options, stop);
    if (stop.stop_requested()) return;
    check_cameras(scene, observed);
    add_located(scene, observed, plan);
    return;
  }
  for (const BopImage& image : scene.images) {
    plan.world.cameras.push_back({std::to_string(image.id), image.camera(), image.depth});
  }
}

/// Whether it is one of the given objects, found again.
bool is_given(const KnownObject& found, const std::vector<KnownObject>& given) {
  constexpr double kSameObject_m = 0.03;
  return std::ranges::any_of(given, [&](const KnownObject& object) {
    const double apart_m =
        (object.T_world_object.translation() - found.T_world_object.translation()).norm();
    return object.type == found.type && apart_m < kSameObject_m;
  });
}

void use_reconstruction(const BopScene& scene, const Workcell& workcell,
                        const SceneReconstructionOptions& options, const StopToken& stop,
                        PlanWorld& plan) {
  const SceneReconstruction found = reconstruct_scene(scene, workcell, options, stop);
  std::vector<std::string> taken;
  for (const PlacedObject& object : workcell.static_structures) taken.push_back(object.name);
  const bool with_given = plan.objects.starts_with(kGivenAnd);
  if (with_given) {
    plan.world.objects = known(workcell.known_objects);
    for (const PlacedObject& object : workcell.known_objects) taken.push_back(object.name);
  }
  const std::vector<KnownObject> given = plan.world.objects;
  std::vector<KnownObject> objects = known_objects(found.result, taken);
  for (std::string& warning : object_warnings(found.result, objects)) {
    plan.warnings.push_back(std::move(warning));
  }
  for (KnownObject& object : objects) {
    if (!is_given(object, given)) plan.world.objects.push_back(std::move(object));
  }
  add_located(scene, found.observed, plan);
}

void use_file(const BopScene& scene, const Workcell& workcell, const fs::path& file,
              PlanWorld& plan) {
  if (!fs::exists(file)) {
    throw bad_input("--objects", fmt::format("found {}; expected given, pnp, voting, svd, a sum "
                                             "such as given+pnp, or an existing world.json",
                                             file.string()));
  }
  WorldFile world = read_world(file, *workcell.knowledge);
  plan.world.objects = std::move(world.objects);
  for (const BopImage& image : scene.images) {
    const auto found = world.T_world_cam.find(image.id);
    if (found == world.T_world_cam.end()) {
      throw bad_input(
          file.string(),
          fmt::format(
              "it does not contain image {}; reconstruct the same images that you plan with",
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

/// Refuses options that say how to find objects where none are searched for.
void refuse_unused_search(const ReconstructCommandOptions& how, bool by_board) {
  const std::string needs = "--objects pnp, voting or svd";
  const ReconstructCommandOptions usual;
  refuse_unused(how.cameras == "board", by_board, "--cameras board", needs);
  refuse_unused(!how.features.empty(), by_board, "--features", needs);
  refuse_unused(how.inlier_px != usual.inlier_px, false, "--inlier-px", needs);
  refuse_unused(how.no_ambiguous, false, "--no-ambiguous", needs);
}

}  // namespace

PlanWorld load_plan_world(const fs::path& dataset, const std::vector<int>& images,
                          const Workcell& workcell, const ObjectSource& source,
                          const StopToken& stop) {
  SceneReconstructionOptions options = options_of(source.how);
  BopScene scene = load_dataset(dataset, workcell, images, options.observe);
  const DepthLens lens = source.how.depth_lens == "auto"
                             ? workcell.depth_lens
                             : depth_lens_of(source.how.depth_lens, "--depth-lens");
  apply_depth_lens(lens, calibrations_of(workcell, options.observe), scene);
  options.depth_is_pinhole = lens != DepthLens::unsaid;
  PlanWorld plan{{}, source.objects, scene.files, scene.warnings, scene.images.front().intrinsics};
  if (plan.objects.empty()) plan.objects = usual_source(scene, workcell);
  const std::string method = plan.objects.starts_with(kGivenAnd)
                                 ? plan.objects.substr(std::string_view(kGivenAnd).size())
                                 : plan.objects;
  plan.world.static_structures = known(workcell.static_structures);
  if (plan.objects == "given") {
    refuse_unused_search(source.how, workcell.board.has_value());
    use_given(scene, workcell, options.observe, stop, plan);
  } else if (is_method(method)) {
    refuse_unused(source.how.no_ambiguous, method == "pnp", "--no-ambiguous", "--objects pnp");
    options.method = reconstruction_method_of(method);
    use_reconstruction(scene, workcell, options, stop, plan);
  } else {
    refuse_unused_search(source.how, false);
    use_file(scene, workcell, plan.objects, plan);
  }
  return plan;
}

}  // namespace vantage
