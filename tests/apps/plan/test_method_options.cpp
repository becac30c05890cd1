#include "plan/method_options.hpp"

#include <doctest/doctest.h>

#include <string>

namespace vantage::test {
namespace {

PlanRequest parsed(const std::string& options) {
  CLI::App app;
  ViewOptions arguments;
  arguments.add_to(app);
  app.parse(options);
  PlanRequest request{.work_area = Box({0, 0, 0}, {1, 1, 1}),
                      .intrinsics = {64, 48, 60, 60, 31.5, 23.5}};
  arguments.apply(request);
  return request;
}

MeshMethod mesh_of(const std::string& options) {
  return std::get<MeshMethod>(parsed("--method mesh " + options).method);
}

}  // namespace

TEST_CASE("each method gets its own options") {
  CHECK(parsed("").method == Method(VoxelMethod{}));
  CHECK(parsed("--method light --depth-power 3").method == Method(LightMethod{}));
  CHECK(parsed("--method shadow").method == Method(ShadowMethod{6}));
  CHECK(parsed("--method shadow --depth-power 3").method == Method(ShadowMethod{3}));
}

TEST_CASE("the mesh method weighs by volume, and by depth if its power is named") {
  CHECK(mesh_of("").weight == MeshWeight::volume);
  CHECK(mesh_of("--depth-power 3").weight == MeshWeight::depth);
  CHECK(mesh_of("--depth-power 3").depth_power == 3);
  CHECK(mesh_of("--mesh-weight depth").weight == MeshWeight::depth);
  CHECK(mesh_of("--mesh-weight depth").depth_power == 6);
  CHECK(mesh_of("--depth-power 3 --mesh-weight volume").weight == MeshWeight::volume);
}

TEST_CASE("what the mesh method is told arrives") {
  const PlanRequest request = parsed(
      "--method mesh --mesh-step 3 --mesh-holes unknown --mesh-offset 2 --mesh-opening 0.04 "
      "--mesh-exact 7 --mesh-shortlist 9 --servo 2 --polish 0");
  const auto& mesh = std::get<MeshMethod>(request.method);
  CHECK(mesh.visibility.step_px == 3);
  CHECK(mesh.visibility.holes == DepthHoles::unknown);
  CHECK(mesh.visibility.offset_sigmas == 2);
  CHECK(mesh.opening_m == 0.04);
  CHECK(mesh.exact_views == 7);
  CHECK(mesh.shortlist == 9);
  CHECK(request.servo.iterations == 2);
  CHECK(request.polish.views == 0);
}

}  // namespace vantage::test
