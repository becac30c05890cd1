#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "raycore/seen_tiles.hpp"
#include "reference/random_lattices.hpp"
#include "support/expect_error.hpp"
#include "support/non_finite.hpp"
#include "support/scene_count.hpp"

using namespace vantage;
using namespace vantage::test;

namespace {

const Box kUnitBox({-0.5, -0.5, 0}, {0.5, 0.5, 1});

/// From 2 m above the middle of the floor down to `height_m`, 2.5 m of it in each direction: more
/// than the box.
VisibilityMesh looks_down(double height_m) {
  const auto depth = float(2 - height_m);
  const float half = 250 / depth;
  return {{{100, 100, 100, 100, 50, 50}, Pose::looking_at({0, 0, 2}, {0, 0, 0})},
          {50 - half, 50, 50 + half},
          {50 - half, 50 + half},
          std::vector<float>(6, depth)};
}

PinholeCamera viewer_at(const Eigen::Vector3d& eye, const Eigen::Vector3d& target,
                        double far_m = 10) {
  return {{41, 41, 60, 60, 20, 20}, Pose::looking_at(eye, target), {0.01, far_m}};
}

UnseenPixel middle_pixel(const UnobservedSpace& space, const PinholeCamera& camera) {
  for (const UnseenPixel& pixel : unseen_pixels(space, camera)) {
    if (pixel.u == 20 && pixel.v == 20) return pixel;
  }
  FAIL("the camera has no such pixel");
  return {};
}

/// Where the box's rays start and end.
std::pair<double, double> ends(const Box& box, const PixelRay& ray, double far_m) {
  double first = 0, last = far_m;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (box.min()[axis] - ray.origin[axis]) / ray.direction[axis];
    const double b = (box.max()[axis] - ray.origin[axis]) / ray.direction[axis];
    first = std::max(first, std::min(a, b)), last = std::min(last, std::max(a, b));
  }
  return {first, last};
}

bool is_seen(const RandomLattices& scene, const Eigen::Vector3d& point) {
  return std::any_of(scene.lattices.begin(), scene.lattices.end(),
                     [&](const VisibilityMesh& lattice) { return lattice.sees(point); });
}

bool same_bits(const UnseenHits& a, const UnseenHits& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

}  // namespace

TEST_CASE("without lattices a ray meets the box's face, or is in the unseen from the start") {
  const UnobservedSpace space({}, kUnitBox);
  CHECK(space.lattice_count() == 0);
  CHECK(space.box().max() == kUnitBox.max());
  const auto expect_face = [&](const UnseenPixel& pixel, double t) {
    CHECK((pixel.t == t || std::abs(pixel.t - t) < 1e-6));
    CHECK(pixel.source == UnseenHits::kNoSource);
    CHECK(pixel.facing == 0);
  };
  const double infinity = std::numeric_limits<double>::infinity();
  expect_face(middle_pixel(space, viewer_at({2, 0, 0.5}, {0, 0, 0.5})), 1.5);
  expect_face(middle_pixel(space, viewer_at({0, 0, 3}, {0, 0, 0})), 2);
  expect_face(middle_pixel(space, viewer_at({0.1, 0, 0.5}, {0, 0, 0.5})), 0);
  expect_face(middle_pixel(space, viewer_at({2, 0, 0.5}, {3, 0, 0.5})), infinity);
  expect_face(middle_pixel(space, viewer_at({2, 0, 0.5}, {0, 0, 0.5}, 1.4)), infinity);
}

TEST_CASE("a ray goes on to where the last volume ends, and gets the facing there") {
  const VisibilityMesh lattices[] = {looks_down(0.5), looks_down(0.2)};
  const UnobservedSpace space(lattices, kUnitBox);
  const auto expect_hit = [&](const PinholeCamera& camera, double t, std::uint32_t source,
                              double facing) {
    const UnseenPixel pixel = middle_pixel(space, camera);
    CHECK(pixel.t == doctest::Approx(t));
    CHECK(pixel.source == source);
    CHECK(pixel.facing == doctest::Approx(facing));
  };
  // From above, from the side, from within, and from where the cameras stood.
  expect_hit(viewer_at({0, 0, 3}, {0, 0, 0}), 2.8, 1, 1);
  expect_hit(viewer_at({2, 0, 2.2}, {0, 0, 0.2}), std::sqrt(8), 1, 1);
  expect_hit(viewer_at({0, 0, 0.6}, {0, 0.3, 0.2}), 0.5, 1, 1.8 / std::hypot(1.8, 0.3));
  expect_hit(viewer_at({0, 0, 2}, {0, 0, 0}), 1.8, 1, 1);
  // From below there is the floor, which is unseen; from the side the same.
  expect_hit(viewer_at({0, 0, -1}, {0, 0, 0.5}), 1, UnseenHits::kNoSource, 0);
  expect_hit(viewer_at({1.5, 0, 0.1}, {0, 0, 0.1}), 1, UnseenHits::kNoSource, 0);
  // Above 0.2 m the side is seen: through and out at the other one.
  const UnseenPixel through = middle_pixel(space, viewer_at({1.5, 0, 0.7}, {0, 0, 0.7}));
  CHECK(std::isinf(through.t));
  CHECK(through.source == UnseenHits::kNoSource);
}

TEST_CASE("a floor that was measured where the box ends is not met") {
  const VisibilityMesh lattices[] = {looks_down(0)};
  const UnobservedSpace space(lattices, kUnitBox);
  std::size_t on_box = 0;
  for (const UnseenPixel& pixel : unseen_pixels(space, viewer_at({0.4, 0.3, 2.5}, {0, 0, 0}))) {
    CAPTURE(pixel.u);
    CAPTURE(pixel.v);
    const auto [first, last] = ends(kUnitBox, pixel.ray, 10);
    CHECK(std::isinf(pixel.t));
    on_box += first < last;
  }
  CHECK(on_box > 300);
}

TEST_CASE("the same camera twice shows what it shows once, and one without depth nothing") {
  for (std::uint32_t seed = 0; seed < scene_count(30); ++seed) {
    CAPTURE(seed);
    RandomLattices scene = random_lattices(seed);
    const UnobservedSpace once(scene.lattices, scene.box);
    const std::vector<VisibilityMesh> lattices = scene.lattices;
    for (const VisibilityMesh& lattice : lattices) {
      scene.lattices.push_back(lattice);
      scene.lattices.push_back(lattice);
      std::fill(scene.lattices.back().depth.begin(), scene.lattices.back().depth.end(), kNaN);
    }
    const UnobservedSpace twice(scene.lattices, scene.box);
    Random random(seed);
    const PinholeCamera viewer = random_viewer(random, scene, ViewerPlace::outside);
    const auto a = unseen_pixels(once, viewer), b = unseen_pixels(twice, viewer);
    for (std::size_t i = 0; i < a.size(); ++i) {
      CAPTURE(i);
      CHECK((a[i].t == b[i].t || std::abs(a[i].t - b[i].t) < 2e-5));
    }
  }
}

TEST_CASE("rays do not stop at the border between two halves of an image") {
  std::size_t surfaces = 0;
  for (std::uint32_t seed = 0; seed < scene_count(60); ++seed) {
    CAPTURE(seed);
    RandomLattices whole = random_lattices(seed);
    if (whole.lattices.empty()) continue;
    whole.lattices.erase(whole.lattices.begin() + 1, whole.lattices.end());
    const VisibilityMesh& lattice = whole.lattices[0];
    const std::size_t middle = lattice.width() / 2;
    if (middle == 0 || middle + 1 == lattice.width()) continue;
    std::vector<VisibilityMesh> halves = {lattice, lattice};
    halves[0].columns.resize(middle + 1);
    halves[1].columns.erase(halves[1].columns.begin(),
                            halves[1].columns.begin() + std::ptrdiff_t(middle));
    for (VisibilityMesh& half : halves) half.depth.clear();
    for (std::size_t i = 0; i < lattice.depth.size(); ++i) {
      if (i % lattice.width() <= middle) halves[0].depth.push_back(lattice.depth[i]);
      if (i % lattice.width() >= middle) halves[1].depth.push_back(lattice.depth[i]);
    }
    Random random(seed);
    const PinholeCamera viewer = random_viewer(random, whole, ViewerPlace::inside);
    const auto a = unseen_pixels(UnobservedSpace(whole.lattices, whole.box), viewer);
    const auto b = unseen_pixels(UnobservedSpace(halves, whole.box), viewer);
    for (std::size_t i = 0; i < a.size(); ++i) {
      CAPTURE(i);
      CHECK((a[i].t == b[i].t || std::abs(a[i].t - b[i].t) < 2e-5));
      surfaces += a[i].source != UnseenHits::kNoSource;
    }
  }
  CHECK(surfaces >= enough(2000));
}

TEST_CASE("what lies before a hit is seen, what lies behind it is not") {
  std::size_t before = 0, behind = 0, wrong = 0;
  for (std::uint32_t seed = 0; seed < scene_count(200); ++seed) {
    CAPTURE(seed);
    const RandomLattices scene = random_lattices(seed);
    const UnobservedSpace space(scene.lattices, scene.box);
    Random random(seed);
    const PinholeCamera viewer =
        random_viewer(random, scene, seed % 2 == 0 ? ViewerPlace::outside : ViewerPlace::inside);
    for (const UnseenPixel& pixel : unseen_pixels(space, viewer)) {
      const auto [first, last] = ends(scene.box, pixel.ray, viewer.range().far_m);
      const double t = std::min(pixel.t, last);
      if (first >= last) {
        CHECK(std::isinf(pixel.t));
        continue;
      }
      CHECK(t >= first - 1e-5);
      for (int i = 0; i < 4 && t > first + 1e-5; ++i, ++before) {
        wrong += !is_seen(scene, pixel.at(first + (t - first) * random.uniform(0, 1)));
      }
      if (std::isinf(pixel.t)) continue;
      ++behind;
      wrong += is_seen(scene, pixel.at(t + 3e-5));
    }
  }
  CHECK(before >= enough(50000));
  CHECK(behind >= enough(20000));
  // Layers of 10 µm and rays that graze a surface.
  CHECK(wrong <= (before + behind) / 2000);
}

TEST_CASE("a tile's pixels depend neither on other tiles nor on the threads") {
  const tbb::global_control really(tbb::global_control::max_allowed_parallelism, 4);
  for (std::uint32_t seed = 0; seed < scene_count(20); ++seed) {
    CAPTURE(seed);
    const RandomLattices scene = random_lattices(seed);
    tbb::task_arena one(1), four(4);
    std::unique_ptr<UnobservedSpace> space, other;
    one.execute([&] { space = std::make_unique<UnobservedSpace>(scene.lattices, scene.box); });
    four.execute([&] { other = std::make_unique<UnobservedSpace>(scene.lattices, scene.box); });
    Random random(seed);
    const PinholeCamera viewer = random_viewer(random, scene, ViewerPlace::inside);
    const std::vector<PixelTile> tiles = image_tiles(viewer.intrinsics());
    std::vector<UnseenHits> together(tiles.size()), apart(tiles.size());
    space->first_unseen(viewer, tiles, together);
    four.execute([&] {
      tbb::parallel_for(std::size_t(0), tiles.size(), [&](std::size_t i) {
        const std::size_t last = tiles.size() - 1 - i;
        other->first_unseen(viewer, {&tiles[last], 1}, {&apart[last], 1});
      });
    });
    for (std::size_t i = 0; i < tiles.size(); ++i) CHECK(same_bits(together[i], apart[i]));
  }
}

TEST_CASE("a seen space refuses what Embree must not see, and says which lattice it is") {
  const VisibilityMesh good = looks_down(0);
  const auto expect_refusal = [&](const VisibilityMesh& bad, const char* message) {
    const VisibilityMesh lattices[] = {good, bad};
    expect_bad_input("depth lattice 1", message,
                     [&] { UnobservedSpace space(lattices, kUnitBox); });
  };
  VisibilityMesh bad = good;
  bad.depth[2] = -1;
  expect_refusal(bad, "the depth at column 2, row 0 is -1");
  bad.depth[2] = 1e30f;
  expect_refusal(bad, "from the origin; expected 1e9 m at most");
  bad = good;
  bad.camera = bad.camera.moved_to(Pose::from_translation({0, 2e9, 0}));
  expect_refusal(bad, "it reaches 2e+09 m from the origin; expected 1e9 m at most");
  expect_bad_input("box", "it reaches 3e+09 m", [] {
    UnobservedSpace space({}, Box({0, 0, -3e9}, {1, 1, 1}));
  });

  const UnobservedSpace space({&good, 1}, kUnitBox);
  const std::vector<PixelTile> tiles(3);
  std::vector<UnseenHits> hits(3);
  expect_bad_input("camera", "centre is [0, 2000000000, 0]", [&] {
    space.first_unseen({{8, 8, 100, 100, 4, 4}, Pose::from_translation({0, 2e9, 0})}, tiles, hits);
  });
  hits.resize(2);
  expect_bad_input("batch", "hits has 2 elements; expected 3", [&] {
    space.first_unseen(viewer_at({0, 0, 5}, {0, 0, 0}), tiles, hits);
  });
}
