#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <set>

#include "reference/random_scene.hpp"
#include "support/expect_error.hpp"
#include "support/non_finite.hpp"
#include "vantage/planner/view_candidates.hpp"

namespace vantage::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
const Box kArea({-0.2, -0.5, 0}, {0.4, 0.1, 0.1});  // centre (0.1, -0.2, 0.05)
const Eigen::Vector3d kCentre(0.1, -0.2, 0.05);

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

bool same_place(const ViewCandidate& a, const ViewCandidate& b) {
  return std::memcmp(a.T_world_cam.translation().data(), b.T_world_cam.translation().data(),
                     3 * sizeof(double)) == 0;
}

/// Ids count up from 0, and nobody comes back to a position that others were at in between.
/// @returns how many views each position has, in their order.
std::vector<int> expect_runs(const std::vector<ViewCandidate>& views) {
  std::vector<int> runs;
  std::set<std::array<double, 3>> places;
  for (std::size_t i = 0; i < views.size(); ++i) {
    REQUIRE(views[i].id == int(i));
    if (i > 0 && same_place(views[i - 1], views[i])) {
      ++runs.back();
      continue;
    }
    runs.push_back(1);
    const Eigen::Vector3d& p = views[i].T_world_cam.translation();
    REQUIRE(places.insert({p.x(), p.y(), p.z()}).second);
  }
  return runs;
}

/// Of all rotations with this optical axis none has its image's up closer to world +z.
void expect_upright(const Pose& pose) {
  const Eigen::Vector3d forward = pose.rotation().col(2), up = -pose.rotation().col(1);
  const double best = std::sqrt(1 - forward.z() * forward.z());
  REQUIRE(up.z() == doctest::Approx(best));
  REQUIRE((pose.rotation().transpose() * pose.rotation()).isIdentity(1e-12));
  REQUIRE(pose.rotation().determinant() > 0);
}

void expect_looks_at(const Pose& pose, const Eigen::Vector3d& target) {
  REQUIRE(angle_between(pose.rotation().col(2), target - pose.translation()) < 1e-9);
  expect_upright(pose);
}

/// One fan: its first view looks at the target, the others surround it.
void expect_fan(std::span<const ViewCandidate> views, const ViewFan& fan,
                const Eigen::Vector3d& target) {
  expect_looks_at(views.front().T_world_cam, target);
  const Eigen::Vector3d straight = views.front().T_world_cam.rotation().col(2);
  std::map<long, std::vector<Eigen::Vector3d>> rings;
  for (const ViewCandidate& view : views) {
    expect_upright(view.T_world_cam);
    const Eigen::Vector3d forward = view.T_world_cam.rotation().col(2);
    const double steps = angle_between(straight, forward) / fan.step_rad;
    REQUIRE(std::abs(steps - std::round(steps)) < 1e-6);
    rings[std::lround(steps)].push_back(forward);
  }
  REQUIRE(rings.size() == std::size_t(fan.rings) + 1);
  for (const auto& [ring, directions] : rings) {
    REQUIRE(directions.size() == std::size_t(std::max(8 * ring, 1L)));
    Eigen::Vector3d sum(0, 0, 0);
    for (const Eigen::Vector3d& direction : directions) sum += direction;
    // Evenly around: only what is along the axis is left.
    REQUIRE((sum - sum.dot(straight) * straight).norm() < 1e-9);
  }
}

}  // namespace

TEST_CASE("a half-sphere has exactly the requested number of directions, all above the horizon") {
  for (int count = 1; count <= 300; ++count) {
    CAPTURE(count);
    const auto directions = half_sphere_directions(count);
    REQUIRE(directions.size() == std::size_t(count));
    for (const Eigen::Vector3d& d : directions) {
      REQUIRE(d.norm() == doctest::Approx(1));
      REQUIRE(d.z() > 0);
    }
  }
}

TEST_CASE("twenty directions are Deserno's rings of 3, 7 and 10") {
  const auto directions = half_sphere_directions(20);
  const auto on_ring = [&](double degrees) {
    return std::count_if(directions.begin(), directions.end(), [&](const Eigen::Vector3d& d) {
      return std::abs(std::acos(d.z()) * 180 / std::numbers::pi - degrees) < 1e-9;
    });
  };
  CHECK(on_ring(15) == 3);
  CHECK(on_ring(45) == 7);
  CHECK(on_ring(75) == 10);
}

TEST_CASE("every ring gets its share of the directions, rounded up or down") {
  for (int count = 1; count <= 300; ++count) {
    std::map<double, int> rings;  // by z
    for (const Eigen::Vector3d& d : half_sphere_directions(count)) ++rings[d.z()];
    double circumferences = 0;
    const double spacing =
        std::numbers::pi / 2 / std::max(1.0, std::round(std::sqrt(std::numbers::pi * count / 8)));
    for (double polar = spacing / 2; polar < std::numbers::pi / 2; polar += spacing) {
      circumferences += std::sin(polar);
    }
    CAPTURE(count);
    for (const auto& [z, points] : rings) {
      REQUIRE(std::abs(points - count * std::sqrt(1 - z * z) / circumferences) < 1);
    }
  }
}

TEST_CASE("directions are spread evenly") {
  for (const int count : {20, 100, 456, 1369}) {
    CAPTURE(count);
    const auto directions = half_sphere_directions(count);
    const double spacing = std::sqrt(2 * std::numbers::pi / count);  // of a square with one point
    for (std::size_t i = 0; i < directions.size(); ++i) {
      double nearest = 10;
      for (std::size_t j = 0; j < directions.size(); ++j) {
        if (i != j) nearest = std::min(nearest, (directions[i] - directions[j]).norm());
      }
      REQUIRE(nearest > 0.6 * spacing);
      REQUIRE(nearest < 1.4 * spacing);
    }
  }
}

TEST_CASE("candidates count up over the half-spheres and look at the centre") {
  const auto candidates = view_candidates(HalfSpheres{{0.5, 0.9}, {20}}, kArea);
  CHECK(expect_runs(candidates) == std::vector<int>(40, 1));
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Pose& pose = candidates[i].T_world_cam;
    CHECK((pose.translation() - kCentre).norm() == doctest::Approx(i < 20 ? 0.5 : 0.9));
    CHECK(pose.translation().z() > kCentre.z());
    expect_looks_at(pose, kCentre);
  }
}

TEST_CASE("the production set is 2 x 20 views, at the default radii") {
  const auto views = view_candidates(production_views(), kArea);
  REQUIRE(views.size() == 40);
  CHECK(expect_runs(views).size() == 40);
  const double half_diagonal = kArea.size().norm() / 2;
  for (std::size_t i = 0; i < 40; ++i) {
    const double radius = (views[i].T_world_cam.translation() - kCentre).norm();
    CHECK(radius == doctest::Approx((i < 20 ? 1.5 : 2.5) * half_diagonal));
  }
}

TEST_CASE("the full set is 1,369 positions on three half-spheres with 25 views each") {
  const auto views = view_candidates(full_views(), kArea);
  REQUIRE(views.size() == 34225);
  CHECK(expect_runs(views) == std::vector<int>(1369, 25));
  std::map<long, int> by_radius;  // in 1e-6 of half the diagonal
  for (std::size_t i = 0; i < views.size(); i += 25) {
    const double radius = (views[i].T_world_cam.translation() - kCentre).norm();
    ++by_radius[std::lround(1e6 * radius / (kArea.size().norm() / 2))];
    expect_fan({&views[i], 25}, {2, 10 * kDegree}, kCentre);
  }
  CHECK(by_radius == std::map<long, int>{{1'500'000, 456}, {2'000'000, 456}, {2'500'000, 457}});
}

TEST_CASE("radii follow from the work area's size") {
  const double half_diagonal = kArea.size().norm() / 2;
  CHECK(default_radii_m(kArea, 1) == std::vector{2 * half_diagonal});
  CHECK(default_radii_m(kArea) == std::vector{1.5 * half_diagonal, 2.5 * half_diagonal});
  const auto five = default_radii_m(kArea, 5);
  REQUIRE(five.size() == 5);
  for (int i = 0; i < 5; ++i) {
    CHECK(five[std::size_t(i)] == doctest::Approx((1.5 + 0.25 * i) * half_diagonal));
  }
  CHECK(view_candidates(HalfSpheres{{}, {3, 4, 5, 6}}, kArea).size() == 18);
  CHECK(view_candidates(HalfSpheres{{0.4}, {7}}, kArea).size() == 7);
  CHECK(view_candidates(HalfSpheres{{0.4, 0.5, 0.6}, {7}}, kArea).size() == 21);
  CHECK(view_candidates(HalfSpheres{{0.4, 0.5}, {7, 1}}, kArea).size() == 8);
}

TEST_CASE("fans of any size, wherever they look") {
  Random random(5);
  for (int rings = 0; rings < 5; ++rings) {
    const ViewFan fan{rings, random.uniform(0.05, 0.7)};
    const std::size_t size = 1 + 4 * std::size_t(rings) * std::size_t(rings + 1);
    const auto views = view_candidates(HalfSpheres{{0.4}, {13}, fan}, kArea);
    CHECK(expect_runs(views) == std::vector<int>(13, int(size)));
    for (std::size_t i = 0; i < 13; ++i) expect_fan({&views[i * size], size}, fan, kCentre);
  }
}

TEST_CASE("a box grid goes from face to face, and looks at the centre") {
  const Box box({0.5, -1, 0.2}, {0.9, 1, 0.8});
  const auto views = view_candidates(BoxGrid{box, {3, 4, 1}, {1, 0.2}}, kArea);
  CHECK(expect_runs(views) == std::vector<int>(12, 9));
  std::set<double> along[3];
  for (std::size_t i = 0; i < views.size(); i += 9) {
    expect_fan({&views[i], 9}, {1, 0.2}, kCentre);
    for (int axis = 0; axis < 3; ++axis) {
      along[axis].insert(views[i].T_world_cam.translation()[axis]);
    }
  }
  REQUIRE(along[0].size() == 3);
  CHECK(*along[0].begin() == 0.5);
  CHECK(*std::next(along[0].begin()) == doctest::Approx(0.7));
  CHECK(*along[0].rbegin() == 0.9);
  REQUIRE(along[1].size() == 4);
  CHECK(*along[1].begin() == -1);
  CHECK(*along[1].rbegin() == 1);
  CHECK(along[2] == std::set{0.5});  // the middle
}

TEST_CASE("a position in the work area's centre looks down") {
  const auto views = view_candidates(BoxGrid{kArea, {3, 3, 3}}, kArea);
  REQUIRE(views.size() == 27);
  const Pose& middle = views[13].T_world_cam;
  REQUIRE((middle.translation() - kArea.centre()).norm() < 1e-15);
  CHECK(angle_between(middle.rotation().col(2), -Eigen::Vector3d::UnitZ()) < 1e-9);
}

TEST_CASE("views around a path") {
  const Pose begin = Pose::looking_at({0, 0, 0.5}, {0, 1, 0.5});
  const Pose corner = Pose::looking_at({0.3, 0, 0.5}, {1.3, 0, 0.5});
  const Pose end = Pose::looking_at({0.3, 0.12, 0.5}, {1.3, 0.12, 0.5});
  const auto views = view_candidates(AroundPath{{begin, corner, end}, 0.1, 0.04, 6}, kArea);
  // 0.42 m of way: at 0, 0.1, 0.2, 0.3 (the corner), 0.4 and 0.42.
  REQUIRE(views.size() == 6 * 7);
  CHECK(expect_runs(views) == std::vector<int>(42, 1));
  const double x[] = {0, 0.1, 0.2, 0.3, 0.3, 0.3}, y[] = {0, 0, 0, 0, 0.1, 0.12};
  for (std::size_t place = 0; place < 6; ++place) {
    const Pose& on_path = views[7 * place].T_world_cam;
    const Eigen::Vector3d at = on_path.translation();
    CHECK((at - Eigen::Vector3d(x[place], y[place], 0.5)).norm() < 1e-12);
    // It turns by 90 degrees up to the corner, evenly.
    const double turned = 90 * kDegree * std::min(x[place] / 0.3, 1.0);
    const Eigen::Vector3d looks(std::sin(turned), std::cos(turned), 0);
    CHECK(angle_between(on_path.rotation().col(2), looks) < 1e-9);
    Eigen::Vector3d sum(0, 0, 0);
    for (std::size_t i = 1; i < 7; ++i) {
      const Pose& around = views[7 * place + i].T_world_cam;
      CHECK((around.translation() - at).norm() == doctest::Approx(0.04));
      sum += around.translation() - at;
      expect_looks_at(around, kCentre);
    }
    CHECK(sum.norm() < 1e-9);  // above as well as below
  }
}

TEST_CASE("paths of one pose, and steps that divide the way or exceed it") {
  const Pose begin = Pose::from_translation({0, 0, 1}), end = Pose::from_translation({0, 0.3, 1});
  CHECK(view_candidates(AroundPath{{begin}, 0.1, 0.1, 2}, kArea).size() == 3);
  CHECK(view_candidates(AroundPath{{begin, end}, 0.1, 0.1, 2}, kArea).size() == 4 * 3);
  CHECK(view_candidates(AroundPath{{begin, end}, 5, 0.1, 2}, kArea).size() == 2 * 3);
}

TEST_CASE("a list of poses is taken as it is") {
  Random random(3);
  ViewList list;
  for (int i = 0; i < 10; ++i) list.poses.push_back(random.pose(1));
  const auto views = view_candidates(list, kArea);
  REQUIRE(views.size() == 10);
  for (std::size_t i = 0; i < 10; ++i) {
    CHECK(views[i].id == int(i));
    CHECK(views[i].T_world_cam.rotation() == list.poses[i].rotation());
    CHECK(views[i].T_world_cam.translation() == list.poses[i].translation());
  }
}

TEST_CASE("views are counted as they are made") {
  Random random(5);
  const auto below = [&](std::uint32_t n) { return int(random.below(n)); };
  for (int i = 0; i < 200; ++i) {
    CAPTURE(i);
    const ViewFan fan{below(4), 0.1};
    AroundPath around{{}, random.uniform(0.02, 0.4), 0.1, 1 + below(5)};
    for (int pose = 0; pose <= below(4); ++pose) around.path.push_back(random.pose(1));
    for (const CandidateSet& set :
         {CandidateSet(HalfSpheres{{}, {1 + below(30), 1 + below(30)}, fan}),
          CandidateSet(HalfSpheres{{0.4, 0.5, 0.6}, {1 + below(30)}, fan}),
          CandidateSet(BoxGrid{kArea, {1 + below(3), 1 + below(4), 1 + below(5)}, fan}),
          CandidateSet(around), CandidateSet(ViewList{around.path})}) {
      CHECK(view_count(set, kArea) == view_candidates(set, kArea).size());
    }
  }
  CHECK(view_count(full_views(), kArea) == 34'225);
}

TEST_CASE("impossible candidates are refused with the value") {
  const auto refuses = [](const CandidateSet& set, std::string_view message) {
    expect_bad_input("candidates", message, [&] { view_candidates(set, kArea); });
    if (message.starts_with("view ")) return;  // positions are not looked at to count
    expect_bad_input("candidates", message, [&] { (void)view_count(set, kArea); });
  };
  expect_bad_input("candidates", "0 positions", [] { half_sphere_directions(0); });
  expect_bad_input("candidates", "0 half-spheres", [] { default_radii_m(kArea, 0); });
  refuses(HalfSpheres{{-0.5}}, "-0.5 m");
  refuses(HalfSpheres{{kInfinity}}, "inf m");
  refuses(HalfSpheres{{0.5}, {}}, "no count");
  refuses(HalfSpheres{{0.5}, {-3}}, "-3 positions");
  refuses(HalfSpheres{{0.5}, {1'000'001}}, "1000001 positions");
  refuses(HalfSpheres{{0.5, 0.6}, {20, 20, 20}}, "3 counts of positions for 2");
  refuses(HalfSpheres{{0.5}, {20}, {-1, 0.1}}, "-1 rings");
  refuses(HalfSpheres{{0.5}, {20}, {51, 0.01}}, "51 rings");
  refuses(HalfSpheres{{0.5}, {20}, {2, 0}}, "0 rad apart");
  refuses(HalfSpheres{{0.5}, {20}, {2, std::nan("")}}, "nan rad");
  refuses(HalfSpheres{{0.5}, {20}, {4, 0.8}}, "within π");
  refuses(HalfSpheres{{0.5}, {200'000}, {2}}, "200000 positions with 25 views each");
  refuses(BoxGrid{kArea, {3, 0, 3}}, "3 x 0 x 3");
  refuses(BoxGrid{kArea, {20'000, 20'000, 20'000}}, "8000000000000 positions");
  refuses(BoxGrid{kArea, {1, 1, 1}, {1, 4}}, "within π");
  refuses(ViewList{}, "a list without poses");
  refuses(ViewList{{Pose(), Pose::from_translation({0, 0, 2e6})}}, "view 1 is at [0, 0, 2000000]");
  refuses(HalfSpheres{{1e300}, {1}}, "view 0 is at");
  const std::vector<Pose> way = {Pose(), Pose::from_translation({0, 0, 1})};
  refuses(AroundPath{}, "no poses");
  refuses(AroundPath{way, 0}, "a step along the path of 0 m");
  refuses(AroundPath{way, 1e-9}, "use longer steps");
  refuses(AroundPath{way, 0.1, -1}, "radius of -1 m");
  refuses(AroundPath{way, 0.1, 0.1, 0}, "0 positions");
  refuses(AroundPath{way, 1e-4, 0.1, 1000}, "10001 positions with 1001 views each");
}

}  // namespace vantage::test
