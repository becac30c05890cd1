#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "raycore/seen_tiles.hpp"
#include "reference/random_lattices.hpp"
#include "support/scene_count.hpp"

using namespace vantage;
using namespace vantage::test;

namespace {

/// Two parts of a box, with a gap between them, along an axis.
std::vector<Box> halves(const Box& box, int axis) {
  Eigen::Vector3d low_end = box.max(), high_start = box.min();
  low_end[axis] -= 0.6 * box.size()[axis];
  high_start[axis] += 0.55 * box.size()[axis];
  return {Box(box.min(), low_end), Box(high_start, box.max())};
}

TriangleMesh shell_of(const std::vector<Box>& boxes) {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Triangle> triangles;
  for (const Box& box : boxes) {
    const TriangleMesh mesh = TriangleMesh::from_box(box);
    const auto first = std::uint32_t(vertices.size());
    for (const Eigen::Vector3f& vertex : mesh.vertices()) vertices.push_back(vertex);
    for (const Triangle& t : mesh.triangles()) {
      triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
  }
  return {std::move(vertices), std::move(triangles)};
}

Box grown(const Box& box, double by) {
  return Box(box.min().array() - by, box.max().array() + by);
}

}  // namespace

TEST_CASE("within a shell of two boxes, rays meet what they meet first in either box alone") {
  std::size_t rays = 0, hits = 0, close_calls = 0;
  for (std::uint32_t seed = 0; seed < scene_count(60); ++seed) {
    CAPTURE(seed);
    const RandomLattices scene = random_lattices(seed);
    const std::vector<Box> parts = halves(scene.box, int(seed % 3));
    const TriangleMesh shell = shell_of(parts);
    const UnobservedSpace space(scene.lattices, scene.box, &shell);
    const UnobservedSpace low(scene.lattices, parts[0]), high(scene.lattices, parts[1]);
    Random random(seed);
    const auto place = seed % 2 == 0 ? ViewerPlace::outside : ViewerPlace::inside;
    const PinholeCamera viewer = random_viewer(random, scene, place);
    const auto both = unseen_pixels(space, viewer), a = unseen_pixels(low, viewer),
               b = unseen_pixels(high, viewer);
    for (std::size_t i = 0; i < both.size(); ++i) {
      const UnseenPixel& first = b[i].t < a[i].t ? b[i] : a[i];
      ++rays;
      hits += std::isfinite(first.t);
      const bool same = both[i].t == first.t || std::abs(both[i].t - first.t) < 2e-5;
      const bool same_end = both[i].end == first.end || std::abs(both[i].end - first.end) < 2e-5;
      close_calls += !(same && same_end && std::abs(both[i].facing - first.facing) < 1e-3);
    }
  }
  CHECK(hits > rays / 10);
  CHECK(close_calls <= rays / 5000);
}

TEST_CASE("a shell around the whole box changes nothing, and one around nothing rules out all") {
  for (std::uint32_t seed = 0; seed < scene_count(30); ++seed) {
    CAPTURE(seed);
    const RandomLattices scene = random_lattices(seed);
    const TriangleMesh around = shell_of({grown(scene.box, 0.1)}), nothing;
    const UnobservedSpace plain(scene.lattices, scene.box);
    const UnobservedSpace within(scene.lattices, scene.box, &around);
    const UnobservedSpace without(scene.lattices, scene.box, &nothing);
    Random random(seed);
    const PinholeCamera viewer = random_viewer(random, scene, ViewerPlace::outside);
    const auto a = unseen_pixels(plain, viewer), b = unseen_pixels(within, viewer),
               c = unseen_pixels(without, viewer);
    for (std::size_t i = 0; i < a.size(); ++i) {
      CHECK(a[i].t == b[i].t);
      CHECK(a[i].end == b[i].end);
      CHECK(a[i].facing == b[i].facing);
      CHECK(a[i].source == b[i].source);
      CHECK(std::isinf(c[i].t));
    }
  }
}
