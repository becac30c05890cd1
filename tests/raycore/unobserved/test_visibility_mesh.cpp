#include <doctest/doctest.h>

#include <cmath>

#include "reference/plain_seen_space.hpp"
#include "reference/random_lattices.hpp"
#include "support/expect_error.hpp"
#include "support/non_finite.hpp"
#include "support/scene_count.hpp"
#include "vantage/raycore/advanced/visibility_mesh.hpp"

using namespace vantage;
using namespace vantage::test;

namespace {

/// Looks along +z from the origin; pixel (100 x / z, 100 y / z).
VisibilityMesh lattice_of(std::vector<float> columns, std::vector<float> rows,
                          std::vector<float> depth) {
  return {
      {{100, 100, 100, 100, 0, 0}, Pose()}, std::move(columns), std::move(rows), std::move(depth)};
}

}  // namespace

TEST_CASE("a lattice sees up to its surface, which is a plane in inverse depth") {
  const VisibilityMesh lattice = lattice_of({0, 100}, {0, 100}, {1, 1, 1, 4});
  const auto surface = [&](double u, double v) {  // by bisection
    double near = 0.01, far = 100;
    for (int i = 0; i < 60; ++i) {
      const double z = 0.5 * (near + far);
      (lattice.sees(lattice.camera.unproject(u, v, z)) ? near : far) = z;
    }
    return near;
  };
  // The upper left half is flat; the other one goes from 1 on the diagonal to 1/4 at its corner.
  CHECK(surface(10, 10) == doctest::Approx(1));
  CHECK(surface(80, 10) == doctest::Approx(1));
  CHECK(surface(50, 50) == doctest::Approx(1));
  CHECK(surface(75, 75) == doctest::Approx(1 / 0.625));
  CHECK(surface(99.999999, 99.999999) == doctest::Approx(4));
  CHECK(surface(90, 60) == doctest::Approx(surface(60, 90)));
  CHECK_FALSE(lattice.sees({-0.01, 0.5, 1}));
  CHECK_FALSE(lattice.sees({0.5, 0.5, -1}));
  CHECK_FALSE(lattice.sees({0, 0, 0}));
}

TEST_CASE("a cell is there if all its four depths are known") {
  const VisibilityMesh lattice =
      lattice_of({0, 10, 20, 30}, {0, 10, 20}, {1, 1, 1, 1, 1, 1, kNaN, 1, 1, 1, 1, 1});
  for (std::size_t j = 0; j < 2; ++j) {
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(lattice.has_cell(i, j) == (i == 0));
      const Eigen::Vector3d middle =
          lattice.camera.unproject(5 + 10 * double(i), 5 + 10 * double(j), 0.5);
      CHECK(lattice.sees(middle) == (i == 0));
    }
  }
}

TEST_CASE("a lattice sees the points that are in its tetrahedra") {
  std::size_t inside = 0, outside = 0;
  for (std::uint32_t seed = 0; seed < scene_count(60); ++seed) {
    CAPTURE(seed);
    const RandomLattices scene = random_lattices(seed);
    const PlainSeenSpace plain(scene.lattices, scene.box);
    Random random(seed);
    for (std::uint32_t k = 0; k < scene.lattices.size(); ++k) {
      for (int i = 0; i < 100; ++i) {
        const Eigen::Vector3d point = random.in_cube(0.6);
        const bool sees = scene.lattices[k].sees(point);
        CHECK(sees == plain.sees(k, point));
        ++(sees ? inside : outside);
      }
    }
  }
  CHECK(inside >= enough(500));
  CHECK(outside >= enough(2000));
}

TEST_CASE("invalid lattices are refused with the place") {
  const auto expect_refusal = [](const VisibilityMesh& lattice, const char* message) {
    expect_bad_input("depth lattice", message, [&] { lattice.check(); });
  };
  lattice_of({0, 1}, {0, 1}, {1, kNaN, 2, 3}).check();
  expect_refusal(lattice_of({0}, {0, 1}, {1, 1}), "it has 1 columns; expected 2 to 32767");
  expect_refusal(lattice_of({0, 1}, {}, {}), "it has 0 rows; expected 2 to 32767");
  expect_refusal(lattice_of({0, 1, 1}, {0, 1}, std::vector<float>(6, 1.f)),
                 "columns[2] is 1 after 1; expected them to increase");
  expect_refusal(lattice_of({0, 1}, {0, kNaN}, {1, 1, 1, 1}),
                 "rows[1] is nan; expected pixel coordinates within 1e+06");
  expect_refusal(lattice_of({-2e6f, 1}, {0, 1}, {1, 1, 1, 1}), "columns[0] is -2000000");
  expect_refusal(lattice_of({0, 1}, {0, 1}, {1, 1, 1}), "it has 3 depths; expected 2 x 2 = 4");
  expect_refusal(lattice_of({0, 1}, {0, 1}, {1, 1, 0, 1}), "at column 0, row 1 is 0; expected");
  expect_refusal(lattice_of({0, 1}, {0, 1}, {1, INFINITY, 1, 1}), "at column 1, row 0 is inf");
  expect_bad_input("here", "it has 3 depths", [] {
    lattice_of({0, 1}, {0, 1}, {1, 1, 1}).check("here");
  });
}
