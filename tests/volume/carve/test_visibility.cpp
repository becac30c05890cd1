#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <tuple>

#include "reference/noisy_depth.hpp"
#include "reference/random_workcell.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"
#include "vantage/volume/advanced/visibility.hpp"

namespace vantage {
namespace {

using test::Random;

constexpr float kUnknown = DepthImage::kUnknown;
constexpr int kWidth = 80, kHeight = 60;

PinholeCamera camera_at(const Eigen::Vector3d& eye, const Eigen::Vector3d& target = {0, 0, 0}) {
  return {{kWidth, kHeight, 70, 70, 39.5, 29.5}, Pose::looking_at(eye, target), {0.1, 3}};
}

const Box kArea({-0.2, -0.2, 0}, {0.2, 0.2, 0.15});

/// Every pixel's depth from `depth(u, v)`.
template <class Depth>
PosedDepth image_of(const PinholeCamera& camera, const Depth& depth) {
  DepthImage image(kWidth, kHeight);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) image.set(u, v, float(depth(u, v)));
  return {camera, std::make_shared<const DepthImage>(std::move(image))};
}

/// A plane that is nobody's special case: linear in inverse depth.
double tilted(int u, int v) {
  return 1 / (1.5 + 0.004 * u - 0.007 * v);
}

VisibilityOptions options_of(int step_px, double offset_sigmas = 0) {
  VisibilityOptions options;
  options.step_px = step_px;
  options.offset_sigmas = offset_sigmas;
  return options;
}

float at(const VisibilityMesh& lattice, int u, int v) {
  for (std::size_t j = 0; j < lattice.height(); ++j)
    for (std::size_t i = 0; i < lattice.width(); ++i)
      if (lattice.columns[i] == float(u) && lattice.rows[j] == float(v))
        return lattice.depth[j * lattice.width() + i];
  FAIL_CHECK("no vertex at this pixel");
  return 0;
}

/// With every pixel a vertex, so that it can be asked for any of them; near enough that the work
/// area fills the image.
VisibilityMesh full_lattice(const PosedDepth& image, VisibilityOptions options = options_of(1)) {
  const auto lattice = visibility_lattice(image, kArea, StereoNoise(), options);
  REQUIRE(lattice);
  REQUIRE(lattice->width() == kWidth);
  REQUIRE(lattice->height() == kHeight);
  return *lattice;
}

const PinholeCamera kNear = camera_at({0.02, -0.03, 0.25});

}  // namespace

TEST_CASE("a visibility mesh has a vertex at every step and at the region's border") {
  const auto image = image_of(kNear, tilted);
  const auto lattice = visibility_lattice(image, kArea, StereoNoise(), options_of(8));
  REQUIRE(lattice);
  lattice->check();
  CHECK(lattice->columns == std::vector<float>{0, 8, 16, 24, 32, 40, 48, 56, 64, 72, 79});
  CHECK(lattice->rows == std::vector<float>{0, 8, 16, 24, 32, 40, 48, 56, 59});
  for (std::size_t j = 0; j < lattice->height(); ++j)
    for (std::size_t i = 0; i < lattice->width(); ++i)
      CHECK(lattice->depth[j * lattice->width() + i] ==
            float(tilted(int(lattice->columns[i]), int(lattice->rows[j]))));
}

TEST_CASE("the region of interest holds every pixel that can see the work area, and few others") {
  Random random(3);
  double spare = 0;
  const std::uint32_t count = test::scene_count(300);
  for (std::uint32_t n = 0; n < count; ++n) {
    CAPTURE(n);
    const Eigen::Vector3d eye = kArea.centre() + random.uniform(0.4, 1.5) * random.direction();
    const PinholeCamera camera = camera_at(eye, kArea.centre() + random.in_cube(0.4));
    const auto lattice = visibility_lattice(image_of(camera, tilted), kArea, StereoNoise(),
                                            options_of(1 + int(random.below(12))));
    double u0 = kWidth, u1 = 0, v0 = kHeight, v1 = 0;
    for (int i = 0; i < 500; ++i) {
      const Eigen::Vector3d p = kArea.centre() + random.in_cube(1).cwiseProduct(0.5 * kArea.size());
      const auto seen = camera.project(p);
      if (!seen || seen->u < 0 || seen->u > kWidth - 1 || seen->v < 0 || seen->v > kHeight - 1) {
        continue;
      }
      u0 = std::min(u0, seen->u), u1 = std::max(u1, seen->u);
      v0 = std::min(v0, seen->v), v1 = std::max(v1, seen->v);
    }
    if (u0 > u1) continue;
    REQUIRE(lattice);
    CHECK(double(lattice->columns.front()) <= u0);
    CHECK(double(lattice->columns.back()) >= u1);
    CHECK(double(lattice->rows.front()) <= v0);
    CHECK(double(lattice->rows.back()) >= v1);
    spare += double(lattice->columns.back() - lattice->columns.front()) - (u1 - u0);
  }
  if (test::kAllScenes) CHECK(spare / count < 8);
}

TEST_CASE("a camera in the work area, or beside it, has a mesh, and one that looks away has none") {
  const auto mesh = [](const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
    return visibility_lattice(image_of(camera_at(eye, target), tilted), kArea, StereoNoise(),
                              options_of(8));
  };
  const auto inside = mesh({0, 0, 0.1}, {0.3, 0, 0});
  REQUIRE(inside);
  CHECK(inside->columns.back() == kWidth - 1);
  CHECK(inside->sees({0.1, 0, 0.07}));
  // The camera's plane goes through the work area.
  const auto beside = mesh({0.21, 0, 0.1}, {0.21, 0.5, 0.1});
  if (beside) CHECK(beside->columns.front() == 0);
  CHECK_FALSE(mesh({0, -1, 0.1}, {0, -2, 0.1}));
  CHECK_FALSE(mesh({0, -1, 0.1}, {1, -1, 0.1}));
}

TEST_CASE("the surface moves back, away from the camera, by the noise") {
  const VisibilityOptions still = options_of(8), moved = options_of(8, 2);
  const auto image = image_of(kNear, tilted);
  const auto exact = visibility_lattice(image, kArea, StereoNoise(), still);
  const auto behind = visibility_lattice(image, kArea, StereoNoise(), moved);
  REQUIRE(exact);
  REQUIRE(behind);
  for (std::size_t n = 0; n < exact->depth.size(); ++n) {
    const double z = double(exact->depth[n]);
    const double offset = double(behind->depth[n]) - z;
    CHECK(std::abs(offset / (2 * StereoNoise().sigma_m(z)) - 1) < 0.03);
  }
}

TEST_CASE("no offset, however large, more than doubles a depth") {
  auto options = options_of(8, 1e300);
  const auto lattice = visibility_lattice(image_of(kNear, tilted), kArea, StereoNoise(), options);
  REQUIRE(lattice);
  lattice->check();
  const auto exact =
      visibility_lattice(image_of(kNear, tilted), kArea, StereoNoise(), options_of(8));
  REQUIRE(exact);
  for (std::size_t n = 0; n < exact->depth.size(); ++n) {
    CHECK(lattice->depth[n] == doctest::Approx(2 * double(exact->depth[n])));
  }
}

TEST_CASE("holes in a plane are filled with the plane") {
  Random random(1);
  for (const std::uint32_t one_of : {2u, 10u}) {  // half of the pixels are there, or a tenth
    const auto image = image_of(kNear, [&](int u, int v) {
      return random.below(one_of) == 0 ? tilted(u, v) : double(kUnknown);
    });
    const VisibilityMesh lattice = full_lattice(image);
    std::size_t unknown = 0;
    for (int v = 0; v < kHeight; ++v) {
      for (int u = 0; u < kWidth; ++u) {
        const double depth = double(at(lattice, u, v)), truth = tilted(u, v);
        if (std::isnan(depth)) {
          ++unknown;
          continue;
        }
        // Never farther than measured: at the border there is no other side.
        CHECK(depth < truth * 1.13);
        if (u > 30 && u < 50 && v > 25 && v < 35 && one_of == 2) {
          CHECK(std::abs(depth / truth - 1) < 1e-6);
        }
      }
    }
    CHECK(unknown == 0);
  }
}

TEST_CASE("a hole of a few pixels at a vertex is filled from its neighbours") {
  const auto image = image_of(kNear, [](int u, int v) {
    const bool hole = std::abs(u - 40) <= 1 && std::abs(v - 32) <= 2;
    return hole ? double(kUnknown) : tilted(u, v);
  });
  const auto lattice = visibility_lattice(image, kArea, StereoNoise(), options_of(8));
  REQUIRE(lattice);
  CHECK(double(at(*lattice, 40, 32)) == doctest::Approx(tilted(40, 32)).epsilon(1e-6));
  auto careful = options_of(8);
  careful.holes = DepthHoles::unknown;
  const auto holes = visibility_lattice(image, kArea, StereoNoise(), careful);
  REQUIRE(holes);
  CHECK(std::isnan(at(*holes, 40, 32)));
  CHECK(at(*holes, 48, 32) == at(*lattice, 48, 32));
}

TEST_CASE("what is filled between a near and a far side is nearer to what is nearer") {
  const auto image = image_of(kNear, [](int u, int) {
    return u <= 30 ? 0.5 : u >= 40 ? 1.0 : double(kUnknown);
  });
  const VisibilityMesh lattice = full_lattice(image);
  for (int u = 30; u <= 40; ++u) {  // linear in inverse depth
    CHECK(1 / double(at(lattice, u, 20)) == doctest::Approx(2 - 0.1 * (u - 30)).epsilon(1e-6));
  }
}

TEST_CASE("from one side a surface goes on towards the camera, never away from it") {
  const double slope = 0.02;
  for (const double sign : {-1.0, 1.0}) {
    const auto image = image_of(kNear, [&](int u, int) {
      return u <= 40 ? 1 / (2 + sign * slope * (u - 40)) : double(kUnknown);
    });
    const VisibilityMesh lattice = full_lattice(image);
    for (int u = 41; u <= 40 + 24; ++u) {
      const double expected = sign > 0 ? 1 / (2 + slope * (u - 40)) : 0.5;
      CHECK(double(at(lattice, u, 20)) == doctest::Approx(expected).epsilon(1e-5));
    }
    CHECK(std::isnan(at(lattice, 65, 20)));  // out of reach
  }
}

TEST_CASE("nothing is filled in out of reach, and without a measurement there is no mesh") {
  const auto spot = image_of(kNear, [](int u, int v) {
    return std::abs(u - 40) < 2 && std::abs(v - 30) < 2 ? 0.5 : double(kUnknown);
  });
  auto options = options_of(1);
  options.fill_reach_px = 5;
  const VisibilityMesh lattice = full_lattice(spot, options);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) {
      const bool near = std::max(std::abs(u - 40), std::abs(v - 30)) <= 6;
      if (!near) CHECK(std::isnan(at(lattice, u, v)));
    }
  const auto uniform = [](double depth) {
    return image_of(kNear, [=](int, int) { return depth; });
  };
  CHECK_FALSE(visibility_lattice(uniform(double(kUnknown)), kArea, StereoNoise(), {}));
  CHECK_FALSE(visibility_lattice(uniform(0), kArea, StereoNoise(), {}));
  CHECK_FALSE(visibility_lattice(uniform(0.05), kArea, StereoNoise(), {}));  // too near
  CHECK(visibility_lattice(uniform(0.5), kArea, StereoNoise(), {}));
}

TEST_CASE("what is measured beyond the far limit was seen through up to there") {
  const double far = kNear.range().far_m;
  const StereoNoise none{.subpixel_px = 0};
  for (const double depth : {far, far + 0.01, 2 * far, 60.0}) {
    CAPTURE(depth);
    const auto mesh = visibility_lattice(image_of(kNear, [=](int, int) { return depth; }), kArea,
                                         none, options_of(1));
    REQUIRE(mesh);
    for (const float z : mesh->depth) CHECK(z == doctest::Approx(far));
  }
}

TEST_CASE("a mesh frees no space out of reach of what was measured") {
  for (std::uint32_t seed = 0; seed < test::scene_count(12); ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const PinholeCamera camera = test::random_observer(random);
    const auto scene = test::scene_with_foreign_box(test::random_workcell(seed), random);
    DepthImage depth = *test::noisy_depth(*scene, camera, random);
    for (int v = 0; v < depth.height(); ++v)
      for (int u = 0; u < depth.width(); ++u)
        if (random.below(10) != 0) depth.set(u, v, kUnknown);
    auto options = options_of(1 + int(random.below(8)));
    options.fill_reach_px = 4;
    const auto lattice = visibility_lattice({camera, std::make_shared<const DepthImage>(depth)},
                                            test::random_workcell_area(), StereoNoise(), options);
    if (!lattice) continue;
    // A vertex has a depth only within reach of a measured one, and none that is farther than all
    // of those.
    for (std::size_t n = 0; n < lattice->depth.size(); ++n) {
      const int u = int(lattice->columns[n % lattice->width()]);
      const int v = int(lattice->rows[n / lattice->width()]);
      float farthest = 0;
      for (int d = -4; d <= 4; ++d) {
        for (const auto& [x, y] : {std::pair(u + d, v), std::pair(u, v + d)}) {
          if (x < 0 || x >= depth.width() || y < 0 || y >= depth.height()) continue;
          if (depth.at(x, y) > farthest) farthest = depth.at(x, y);
        }
      }
      CHECK(std::isnan(lattice->depth[n]) == (farthest == 0));
      if (farthest > 0) CHECK(lattice->depth[n] <= farthest * 1.000001f);
    }
  }
}

TEST_CASE("images of a single row or column have no cells, and one next to them does") {
  const auto one = [](int width, int height) {
    const PinholeCamera camera({width, height, 70, 70, 0, 0},
                               Pose::looking_at({0, 0, 1}, {0, 0, 0}));
    const std::vector<float> depth(std::size_t(width) * std::size_t(height), 0.8f);
    return visibility_lattice({camera, std::make_shared<const DepthImage>(width, height, depth)},
                              kArea, StereoNoise(), {});
  };
  CHECK_FALSE(one(1, 9));
  CHECK_FALSE(one(9, 1));
  CHECK(one(2, 2));
}

TEST_CASE("visibility options are checked by their keys") {
  const auto refused = [](const char* key, const char* expected, const auto& change) {
    VisibilityOptions options;
    change(options);
    test::expect_bad_input(key, expected, [&] { options.check(); });
    test::expect_bad_input(key, expected, [&] {
      std::ignore = visibility_lattice(image_of(kNear, tilted), kArea, StereoNoise(), options);
    });
  };
  CHECK_NOTHROW(VisibilityOptions{}.check());
  for (const int bad : {0, -1, 65}) {
    refused("step_px", "expected 1 to 64 pixels", [&](auto& o) { o.step_px = bad; });
  }
  for (const int bad : {-1, 16385}) {
    refused("fill_reach_px", "expected 0 to 16384", [&](auto& o) { o.fill_reach_px = bad; });
  }
  for (const double bad : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    refused("offset_sigmas", "expected a finite number", [&](auto& o) { o.offset_sigmas = bad; });
    const StereoNoise noise{.focal_px = bad};
    test::expect_bad_input("noise.focal_px", "expected a finite", [&] {
      std::ignore = visibility_lattice(image_of(kNear, tilted), kArea, noise);
    });
  }
}

}  // namespace vantage
