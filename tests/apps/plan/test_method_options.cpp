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
  request.volume.noise.subpixel_px = 0.2;
  arguments.apply(request);
  return request;
}

}  // namespace

TEST_CASE("the mesh method weighs by volume, and by depth if its power is named") {
  CHECK(parsed("--method mesh").method.mesh.weight == MeshWeight::volume);
  const MethodOptions named = parsed("--method mesh --depth-power 3").method;
  CHECK(named.mesh.weight == MeshWeight::depth);
  CHECK(named.depth_power == 3);
  CHECK(parsed("--method mesh --mesh-weight depth").method.depth_power == 6);
  CHECK(parsed("--mesh-weight depth").method.mesh.weight == MeshWeight::depth);
  CHECK(parsed("--depth-power 3 --mesh-weight volume").method.mesh.weight == MeshWeight::volume);
}

TEST_CASE("what the mesh method is told arrives") {
  const PlanRequest request = parsed(
      "--method mesh --mesh-step 3 --mesh-holes unknown --mesh-offset 2 --mesh-opening 0.04 "
      "--mesh-exact 7 --mesh-shortlist 9 --servo 2 --polish 0");
  const MeshOptions& mesh = request.method.mesh;
  CHECK(request.method.name == "mesh");
  CHECK(mesh.visibility.step_px == 3);
  CHECK(mesh.visibility.holes == DepthHoles::unknown);
  CHECK(mesh.visibility.offset_sigmas == 2);
  CHECK(mesh.visibility.noise == request.volume.noise);
  CHECK(mesh.opening_m == 0.04);
  CHECK(mesh.exact_views == 7);
  CHECK(mesh.shortlist == 9);
  CHECK(request.servo.iterations == 2);
  CHECK(request.polish.views == 0);
}

}  // namespace vantage::test
