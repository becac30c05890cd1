#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "raycore/seen_tiles.hpp"
#include "reference/plain_seen_space.hpp"
#include "reference/random_lattices.hpp"
#include "support/scene_count.hpp"

using namespace vantage;
using namespace vantage::test;

namespace {

constexpr double kTolerance = 2e-5;  // along a ray, in scenes that are two metres wide

bool agree(const UnseenPixel& pixel, const PlainUnseen& plain) {
  const bool is_face = pixel.source == UnseenHits::kNoSource;
  if (is_face && pixel.facing != 0) return false;
  if (std::isinf(pixel.t) || std::isinf(plain.t)) return is_face && pixel.t == plain.t;
  if (std::abs(pixel.t - plain.t) > kTolerance) return false;
  if (is_face) return plain.at_start;
  return std::any_of(
      plain.sources.begin(), plain.sources.end(), [&](const PlainUnseen::Source& source) {
        return source.lattice == pixel.source && std::abs(source.facing - pixel.facing) < 1e-3;
      });
}

/// Whether a ray that is off by a few millionths, or a gap of a hundred-thousandth, has this
/// outcome. By less, too: a ray at the outer border's vertex is inside on one side only, where the
/// steep triangle that it ends in may be that thin.
bool nearly_agree(const UnseenPixel& pixel, const PlainSeenSpace& plain, double t_far) {
  constexpr double kAngles[] = {1e-7, 1e-6, 1e-5};
  Random random(1);
  for (int i = 0; i < 90; ++i) {
    const double angle = i == 0 ? 0 : kAngles[i % 3];
    const Eigen::Vector3d turned = pixel.ray.direction + angle * random.direction();
    for (const double thinnest : {1e-7, kTolerance}) {
      if (agree(pixel, plain.first_unseen(pixel.ray.origin, turned, t_far, thinnest))) return true;
    }
  }
  return false;
}

struct Tally {
  std::size_t rays = 0, surfaces = 0, faces = 0, misses = 0, close_calls = 0, wrong = 0;
};

void compare(const PinholeCamera& viewer, const UnobservedSpace& space, const PlainSeenSpace& plain,
             bool may_be_wrong, Tally& tally) {
  const double t_far = viewer.range().far_m;
  for (const UnseenPixel& pixel : unseen_pixels(space, viewer)) {
    CAPTURE(pixel.u);
    CAPTURE(pixel.v);
    CAPTURE(pixel.t);
    ++tally.rays;
    ++(std::isinf(pixel.t)                     ? tally.misses
       : pixel.source == UnseenHits::kNoSource ? tally.faces
                                               : tally.surfaces);
    const PlainUnseen truth =
        plain.first_unseen(pixel.ray.origin, pixel.ray.direction, t_far, 1e-6);
    if (agree(pixel, truth)) continue;
    ++tally.close_calls;
    CAPTURE(truth.t);
    const bool is_near = nearly_agree(pixel, plain, t_far);
    tally.wrong += !is_near;
    if (may_be_wrong) continue;
    CHECK(is_near);
  }
}

/// @param beside_m how far in front of the chosen place the viewer may stand
Tally compare_views(ViewerPlace place, std::uint32_t first_seed, double beside_m = 0) {
  Tally tally;
  for (std::uint32_t seed = first_seed, end = seed + scene_count(60); seed < end; ++seed) {
    CAPTURE(seed);
    RandomLattices scene = random_lattices(seed);
    if (beside_m > 0) scene.box = Box({-1, -1, -1}, {1, 1, 1});  // so that rays begin at the viewer
    const UnobservedSpace space(scene.lattices, scene.box);
    const PlainSeenSpace plain(scene.lattices, scene.box);
    Random random(seed);
    for (int view = 0; view < 2; ++view) {
      const PinholeCamera viewer = random_viewer(random, scene, place);
      const Pose& pose = viewer.T_world_cam();
      const Eigen::Vector3d forwards = pose.rotation().col(2) + 0.2 * random.direction();
      const Eigen::Vector3d shift = beside_m * std::pow(10, -random.uniform(0, 3)) * forwards;
      compare(viewer.moved_to(Pose::from_rotation(pose.rotation(), pose.translation() + shift)),
              space, plain, beside_m > 0, tally);
    }
  }
  return tally;
}

}  // namespace

TEST_CASE("the unseen begins where the union of the lattices' tetrahedra ends") {
  for (const ViewerPlace place : {ViewerPlace::outside, ViewerPlace::inside, ViewerPlace::apex}) {
    CAPTURE(int(place));
    const Tally tally = compare_views(place, 100 * std::uint32_t(place));
    CHECK(tally.close_calls <= tally.rays / 10000);
    CHECK(tally.surfaces >= enough(500));
    CHECK(tally.faces >= enough(3000));
    CHECK(tally.misses >= enough(2000));
  }
}

TEST_CASE("the same from where a lattice's camera stands, through its very pixels") {
  // Here rays lie in the planes of borders and meet the surface in its edges and vertices.
  const Tally tally = compare_views(ViewerPlace::lattice_camera, 1000);
  CHECK(tally.close_calls <= tally.rays / 50);
  CHECK(tally.surfaces >= enough(10000));
}

TEST_CASE("the same from close in front of a lattice's camera") {
  // Rays begin at as little as a ten-thousandth of the depth that they get to. Where cells are a
  // twentieth of a pixel wide, a hit is a few hundred-thousandths off.
  const Tally tally = compare_views(ViewerPlace::lattice_camera, 2000, 0.03);
  CHECK(tally.wrong <= tally.rays / 5000);
  // One of the first scenes has nearly all of them.
  CHECK(tally.close_calls <= tally.rays / (kAllScenes ? 100 : 20));
  CHECK(tally.surfaces > enough(10000));
}
