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
  request.volume.noise.subpixel_px = 0.2;
  views.apply(request);
  return request;
}

}  // namespace

TEST_CASE("the mesh method weighs by volume, and by depth if its power is named") {
  CHECK(request_from("--method mesh").method.mesh.weight == MeshWeight::volume);
  const MethodOptions named = request_from("--method mesh --depth-power 3").method;
  CHECK(named.mesh.weight == MeshWeight::depth);
  CHECK(named.depth_power == 3);
  CHECK(request_from("--method mesh --mesh-weight depth").method.depth_power == 6);
  CHECK(request_from("--mesh-weight depth").method.mesh.weight == MeshWeight::depth);
  CHECK(request_from("--depth-power 3 --mesh-weight volume").method.mesh.weight ==
        MeshWeight::volume);
}

TEST_CASE("what the mesh method is told arrives") {
  const PlanRequest request = request_from(
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

TEST_CASE("a travel cost needs a start") {
  expect_bad_input("travel", "--from", [] { request_from("--travel-weight 2"); });
  const auto travel = request_from("--travel-weight 2 --from 0.1 0.2 0.3").search.travel;
  REQUIRE(travel);
  CHECK(travel->weight_per_m == 2);
  CHECK(travel->from_m == Eigen::Vector3d(0.1, 0.2, 0.3));
}

}  // namespace vantage::test
