#include "options/view_options.hpp"

#include <doctest/doctest.h>

#include <string>

#include "options/command_line.hpp"
#include "options/field_json.hpp"
#include "support/expect_error.hpp"

namespace vantage::test {
namespace {

PlanRequest request_from(const std::string& options) {
  CLI::App app;
  ViewOptions views;
  nlohmann::json given = nlohmann::json::object();
  add_fields(app, fields_of(views), given);
  app.parse(options);
  read_given(given, fields_of(views));
  PlanRequest request{.work_area = Box({0, 0, 0}, {1, 1, 1}),
                      .intrinsics = {64, 48, 60, 60, 31.5, 23.5}};
  views.apply(request);
  return request;
}

MeshMethod mesh_of(const std::string& options) {
  return std::get<MeshMethod>(request_from("--method mesh " + options).method);
}

}  // namespace

TEST_CASE("each method gets its own options") {
  CHECK(request_from("").method == Method(VoxelMethod{}));
  CHECK(request_from("--method light --depth-power 3").method == Method(LightMethod{}));
  CHECK(request_from("--method shadow").method == Method(ShadowMethod{6}));
  CHECK(request_from("--method shadow --depth-power 3").method == Method(ShadowMethod{3}));
}

TEST_CASE("the mesh method weighs by volume, and by depth if its power is named") {
  CHECK(mesh_of("").weight == MeshWeight::volume);
  CHECK(mesh_of("--depth-power 3").weight == MeshWeight::depth);
  CHECK(mesh_of("--depth-power 3").depth_power == 3);
  CHECK(mesh_of("--mesh-weight depth").weight == MeshWeight::depth);
  CHECK(mesh_of("--mesh-weight depth").depth_power == 6);
  CHECK(mesh_of("--depth-power 3 --mesh-weight volume").weight == MeshWeight::volume);
}

TEST_CASE("the mesh method gets its options") {
  const PlanRequest request = request_from(
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

TEST_CASE("a travel cost needs a start") {
  expect_bad_input("travel", "--from", [] { request_from("--travel-weight 2"); });
  const auto travel = request_from("--travel-weight 2 --from 0.1 0.2 0.3").search.travel;
  REQUIRE(travel);
  CHECK(travel->weight_per_m == 2);
  CHECK(travel->from_m == Eigen::Vector3d(0.1, 0.2, 0.3));
}

}  // namespace vantage::test
