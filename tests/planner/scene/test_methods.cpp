#include "vantage/planner/methods.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "support/expect_error.hpp"

namespace vantage {

TEST_CASE("every method has a name that gives it back with its usual options") {
  CHECK(method_names() == std::vector<std::string>{"voxel", "shadow", "mesh", "light"});
  for (const std::string& name : method_names()) CHECK(name_of(method_named(name)) == name);
  CHECK(method_named("voxel") == Method(VoxelMethod{}));
  CHECK(method_named("shadow") == Method(ShadowMethod{}));
  CHECK(method_named("mesh") == Method(MeshMethod{}));
  CHECK(method_named("light") == Method(LightMethod{}));
  test::expect_bad_input("method", "\"voxels\" is unknown; expected one of voxel, shadow, mesh",
                         [] { (void)method_named("voxels"); });
}

TEST_CASE("a method's options are checked with the method, and its power is a number to 16") {
  for (const Method& method : {Method(VoxelMethod{}), Method(ShadowMethod{0}),
                               Method(LightMethod{}), Method(MeshMethod{.depth_power = 16})}) {
    CHECK_NOTHROW(check(method));
  }
  for (const double power : {-0.5, 16.5, std::nan("")}) {
    test::expect_bad_input("method", "expected a number from 0 to 16",
                           [&] { check(ShadowMethod{power}); });
    test::expect_bad_input("method", "expected a number from 0 to 16",
                           [&] { check(MeshMethod{.depth_power = power}); });
  }
  test::expect_bad_input("step_px", "expected 1 to 64",
                         [] { check(MeshMethod{.visibility = {.step_px = 0}}); });
}

}  // namespace vantage
