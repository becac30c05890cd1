// A box stands between a camera and what the robot wants to see. Ends with 1 if vantage is wrong.
#include <cmath>
#include <cstdio>
#include <exception>
#include <vantage/planner/plan.hpp>
#include <vantage/raycore/advanced/scene_builder.hpp>
#include <vantage/raycore/error.hpp>
#include <vantage/reconstruction/bop_scene.hpp>
#include <vantage/reconstruction/reconstruct.hpp>

namespace {

bool expect(bool condition, const char* what) {
  std::printf("%s: %s\n", condition ? "ok" : "WRONG", what);
  return condition;
}

bool look_at_a_box() {
  vantage::SceneBuilder builder;
  const vantage::ObjectId box = builder.add_box(vantage::Box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}),
                                                vantage::Pose::from_translation({0, 0, 0.5}));
  const auto scene = builder.build();

  const Eigen::Vector3f camera(1, 0, 0.5f);
  bool good = expect(scene->occluded(camera, {-1, 0, 0.5f}), "the box hides what is behind it");
  good &= expect(!scene->occluded(camera, {-1, 0, 1.5f}), "and not what is above it");

  vantage::Ray ray;
  ray.origin = camera;
  ray.direction = {-1, 0, 0};
  const auto hit = scene->closest_hit(ray);
  good &= expect(hit && hit->object == box && std::abs(hit->t - 0.9f) < 1e-5f,
                 "the ray ends on the box, 0.9 m away");
  return good;
}

/// An error that is thrown inside the shared library is caught by its type outside of it.
bool refuse_a_flat_box() {
  try {
    vantage::Box({0, 0, 0}, {1, 1, 0}, "the flat box");
  } catch (const vantage::Error& error) {
    return expect(error.where() == "the flat box", error.what());
  }
  return expect(false, "a box without volume is refused");
}

/// Grid, scorer and plan: through volume and planner, without a line of OpenVDB or TBB here.
bool plan_a_view_behind_a_wall() {
  const vantage::Intrinsics intrinsics{64, 48, 60, 60, 31.5, 23.5};
  vantage::WorldModel world;
  world.objects.push_back(
      {"wall",
       std::make_shared<const vantage::TriangleMesh>(
           vantage::TriangleMesh::from_box({{-0.1, -0.01, 0}, {0.1, 0.01, 0.1}})),
       {}});
  world.cameras.push_back(
      {"front",
       vantage::PinholeCamera(intrinsics, vantage::Pose::looking_at({0, -0.5, 0.2}, {0, 0, 0.05})),
       nullptr});
  const vantage::Plan plan = vantage::plan_next_view(
      world, {.work_area = {{-0.1, -0.1, 0}, {0.1, 0.1, 0.1}}, .intrinsics = intrinsics});
  return expect(plan.best() != nullptr && plan.views.front().revealed_voxels > 0,
                "the next view reveals something behind the wall");
}

/// A detector of the robot's own says where a tool is; the library makes an object of it.
bool find_a_tool() {
  vantage::ObjectType tool{"tool"};
  tool.mesh = std::make_shared<const vantage::TriangleMesh>(
      vantage::TriangleMesh::from_box({{-0.1, -0.01, 0}, {0.1, 0.01, 0.1}}));
  tool.features.push_back({{"tracker", "7"}, vantage::FeaturePose{}});
  const vantage::MemoryKnowledgeBase knowledge({tool});
  vantage::CameraView view{"front", vantage::Lens({64, 48, 60, 60, 31.5, 23.5}, {})};
  view.T_world_cam = vantage::Pose::looking_at({0, -0.5, 0.2}, {0, 0, 0.05});
  view.observations.push_back(
      {{"tracker", "7"}, vantage::SeenPose{vantage::Pose::from_translation({0, 0, 0.5})}});
  const auto found = vantage::reconstruct_pnp({&view, 1}, knowledge);
  const auto objects = vantage::known_objects(found);
  const Eigen::Vector3d there = *view.T_world_cam * Eigen::Vector3d(0, 0, 0.5);
  return expect(objects.size() == 1 && objects[0].name == "tool" &&
                    (objects[0].T_world_object.translation() - there).norm() < 1e-6,
                "what a detector saw becomes an object in the world");
}

bool refuse_a_missing_recording() {
  try {
    vantage::load_bop_scene("no such folder");
  } catch (const vantage::Error& error) {
    return expect(error.code() == vantage::ErrorCode::bad_input, error.what());
  }
  return expect(false, "a recording that is not there is refused");
}

}  // namespace

int main() {
  try {
    const bool good = look_at_a_box() & refuse_a_flat_box() & plan_a_view_behind_a_wall() &
                      find_a_tool() & refuse_a_missing_recording();
    return good ? 0 : 1;
  } catch (const std::exception& error) {
    std::printf("WRONG: %s\n", error.what());
    return 1;
  }
}
