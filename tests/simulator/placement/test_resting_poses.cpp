#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulator/placement/mass_properties.hpp"
#include "simulator/placement/placement.hpp"
#include "simulator/resting_bodies.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"

namespace vantage::test {
namespace {

using Eigen::Vector3d;
constexpr double kPi = std::numbers::pi;

// Of all directions, those that meet a rectangle whose middle is straight below, at that distance.
double rectangle_share(double a_m, double b_m, double distance_m) {
  const double a = a_m / 2, b = b_m / 2, d = distance_m;
  return std::asin(a * b / std::sqrt((a * a + d * d) * (b * b + d * d))) / kPi;
}

double sum_of_shares(const std::vector<RestingPose>& poses) {
  double sum = 0;
  for (const RestingPose& pose : poses) sum += pose.share;
  return sum;
}

// The direction in the body that points up when it rests so.
Vector3d up_in_body(const RestingPose& pose) {
  return pose.rotation.row(2);
}

const RestingPose* find_up(const std::vector<RestingPose>& poses, const Vector3d& up) {
  const auto found = std::find_if(poses.begin(), poses.end(), [&](const RestingPose& pose) {
    return (up_in_body(pose) - up).norm() < 1e-5;
  });
  return found == poses.end() ? nullptr : &*found;
}

// How far the centre of mass is above the lowest point.
double energy(const Eigen::Matrix3d& rotation, const std::vector<Vector3d>& points,
              const Vector3d& mass_centre) {
  double lowest = 1e9;
  for (const Vector3d& p : points) lowest = std::min(lowest, (rotation * p).z());
  return (rotation * mass_centre).z() - lowest;
}

// How far the centre of mass, seen from above, is inside the polygon of the points that touch the
// floor; negative if it is outside.
double support_margin(const RestingPose& pose, const std::vector<Vector3d>& points,
                      const Vector3d& mass_centre) {
  std::vector<Eigen::Vector2d> feet;
  for (const Vector3d& p : points) {
    const Vector3d q = pose.rotation * (p - mass_centre);
    if ((pose.rotation * p).z() + pose.height_m < 1e-7) feet.push_back(q.head<2>());
  }
  std::sort(feet.begin(), feet.end(), [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return std::atan2(a.y(), a.x()) < std::atan2(b.y(), b.x());
  });
  double margin = feet.size() >= 3 ? 1e9 : -1;
  for (std::size_t i = 0; i < feet.size(); ++i) {
    const Eigen::Vector2d a = feet[i], b = feet[(i + 1) % feet.size()];
    margin = std::min(margin, (a.x() * b.y() - a.y() * b.x()) / (b - a).norm());
  }
  return margin;
}

void check_at_rest(const RestingPose& pose, const std::vector<Vector3d>& points,
                   const Vector3d& mass_centre, Random& random) {
  const Eigen::Matrix3d& R = pose.rotation;
  CHECK((R * R.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-12);
  CHECK(R.determinant() > 0);
  double lowest = 1e9;
  for (const Vector3d& p : points) lowest = std::min(lowest, (R * p).z() + pose.height_m);
  CHECK(std::abs(lowest) < 1e-12);

  const double margin = support_margin(pose, points, mass_centre);
  const double before = energy(R, points, mass_centre);
  REQUIRE(margin > 0);
  // By half a degree, or half as far as it takes to topple it.
  const double angle = std::min(kPi / 360, margin / before);
  for (int i = 0; i < 8; ++i) {
    const double heading = random.uniform(0, 2 * kPi);
    const Eigen::AngleAxisd tilt(angle, Vector3d(std::cos(heading), std::sin(heading), 0));
    CHECK(energy(tilt * R, points, mass_centre) > before);
  }
}

// Faces of a convex mesh over which the centre of mass lies.
std::size_t count_stable(const TriangleMesh& mesh, const Vector3d& mass_centre) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < mesh.triangles().size(); ++i) {
    const Vector3d a = mesh.corner(i, 0).cast<double>(), b = mesh.corner(i, 1).cast<double>(),
                   c = mesh.corner(i, 2).cast<double>();
    Eigen::Matrix3d frame;
    frame << b - a, c - a, (b - a).cross(c - a);
    const Vector3d weights = frame.inverse() * (mass_centre - a);
    count += weights.x() > 0 && weights.y() > 0 && weights.x() + weights.y() < 1;
  }
  return count;
}

}  // namespace

TEST_CASE("resting poses: a cube has six, all alike") {
  const std::vector<RestingPose> poses = resting_poses(cuboid(0.05, 0.05, 0.05));
  REQUIRE(poses.size() == 6);
  for (const RestingPose& pose : poses) {
    CHECK(pose.share == doctest::Approx(1.0 / 6));
    CHECK(pose.height_m == doctest::Approx(0.025));
  }
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(find_up(poses, Vector3d::Unit(axis)) != nullptr);
    CHECK(find_up(poses, -Vector3d::Unit(axis)) != nullptr);
  }
  const RestingPose* upright = find_up(poses, Vector3d::UnitZ());
  CHECK((upright->rotation - Eigen::Matrix3d::Identity()).norm() < 1e-12);
}

TEST_CASE("resting poses: a box's shares are its sides' solid angles") {
  const Vector3d size(0.3, 0.2, 0.05);
  const std::vector<RestingPose> poses = resting_poses(cuboid(size.x(), size.y(), size.z()));
  REQUIRE(poses.size() == 6);
  CHECK(poses.front().share > poses.back().share);
  for (int axis = 0; axis < 3; ++axis) {
    const double share =
        rectangle_share(size[(axis + 1) % 3], size[(axis + 2) % 3], size[axis] / 2);
    for (const double sign : {-1, 1}) {
      const RestingPose* pose = find_up(poses, sign * Vector3d::Unit(axis));
      REQUIRE(pose != nullptr);
      CHECK(pose->share == doctest::Approx(share).epsilon(1e-5));
      CHECK(pose->height_m == doctest::Approx(size[axis] / 2));
    }
  }
}

TEST_CASE("resting poses: a cylinder stands on two ends or lies on any side") {
  const double radius = 0.03, height = 0.1;
  const std::vector<RestingPose> poses = resting_poses(rod(radius, height, 48));
  REQUIRE(poses.size() == 50);
  const double end = (1 - height / 2 / std::hypot(radius, height / 2)) / 2;  // of a round one
  for (const RestingPose& pose : poses) {
    const bool stands = std::abs(up_in_body(pose).z()) > 0.5;
    CHECK(pose.share == doctest::Approx(stands ? end : (1 - 2 * end) / 48).epsilon(0.01));
    CHECK(pose.height_m == doctest::Approx(stands ? height / 2 : radius).epsilon(0.01));
  }
  CHECK(find_up(poses, Vector3d::UnitZ()) != nullptr);
  CHECK(find_up(poses, -Vector3d::UnitZ()) != nullptr);
  CHECK(sum_of_shares(poses) == doctest::Approx(1));
}

TEST_CASE("resting poses: a ball rests anywhere, as high as its radius") {
  const std::vector<RestingPose> poses = resting_poses(icosphere(0.04, 4));
  CHECK(poses.size() > 1000);
  CHECK(sum_of_shares(poses) == doctest::Approx(1));
  for (const RestingPose& pose : poses) {
    CHECK(pose.height_m == doctest::Approx(0.04).epsilon(0.01));
    CHECK(pose.share < 0.01);
  }
}

TEST_CASE("resting poses: what leans too far rolls over, and gives its share away") {
  // Seen from the front a parallelogram whose top is shifted by more than its foot is wide: neither
  // foot nor top carries it, it falls to the side to which it leans.
  const double width = 0.04, height = 0.05, shift = 0.06, depth = 0.08;
  const TriangleMesh leaning =
      prism({{0, 0}, {width, 0}, {width + shift, height}, {shift, height}}, depth);
  const std::vector<RestingPose> poses = resting_poses(leaning);
  REQUIRE(poses.size() == 4);
  const Vector3d side = Vector3d(height, -shift, 0).normalized();  // outwards, of the long sides
  for (const double sign : {-1, 1}) {
    const RestingPose* lying = find_up(poses, sign * side);
    const RestingPose* ends = find_up(poses, sign * Vector3d::UnitZ());
    REQUIRE(lying != nullptr);
    REQUIRE(ends != nullptr);
    // By symmetry each side gets half of what the ends leave.
    CHECK(lying->share + ends->share == doctest::Approx(0.5).epsilon(1e-6));
    CHECK(lying->share > 2 * ends->share);
  }
}

TEST_CASE("resting poses: the mass of the body counts, not that of its hull") {
  // A heavy head on a thin mast: the hull's middle is over the foot, the mass is not.
  const Box boxes[] = {{{0, 0, 0}, {0.1, 0.1, 0.002}},
                       {{0.098, 0.04, 0.002}, {0.1, 0.06, 0.1}},
                       {{0.1, 0, 0.05}, {0.16, 0.1, 0.1}}};
  const std::vector<RestingPose> poses = resting_poses(TriangleMesh::from_boxes(boxes));
  CHECK(find_up(poses, Vector3d::UnitZ()) == nullptr);
  CHECK(sum_of_shares(poses) == doctest::Approx(1));

  // The same outline, but the foot as heavy as the head.
  const Box steady[] = {{{0, 0, 0}, {0.1, 0.1, 0.05}},
                        {{0.098, 0.04, 0.05}, {0.1, 0.06, 0.1}},
                        {{0.1, 0, 0.05}, {0.16, 0.1, 0.1}}};
  CHECK(find_up(resting_poses(TriangleMesh::from_boxes(steady)), Vector3d::UnitZ()) != nullptr);
}

TEST_CASE("resting poses: random bodies are at rest, and lowest there") {
  Random random(31);
  for (std::uint32_t i = 0; i < scene_count(200); ++i) {
    CAPTURE(i);
    const TriangleMesh mesh = random_convex_body(random);
    const Vector3d mass_centre = mass_properties(mesh).centre;
    const std::vector<Vector3d> points = surface_points(mesh);
    const std::vector<RestingPose> poses = resting_poses(mesh);
    CHECK(poses.size() == count_stable(mesh, mass_centre));
    CHECK(sum_of_shares(poses) == doctest::Approx(1));
    CHECK(std::is_sorted(poses.begin(), poses.end(),
                         [](const auto& a, const auto& b) { return a.share > b.share; }));
    for (const RestingPose& pose : poses) check_at_rest(pose, points, mass_centre, random);
  }
}

TEST_CASE("resting poses: a body that lies askew in its own frame rests the same") {
  Random random(32);
  for (std::uint32_t i = 0; i < scene_count(40); ++i) {
    const TriangleMesh box = cuboid(0.12, 0.08, 0.05), round = rod(0.02, 0.07, 32);
    const Pose pose = random.pose(0.5);
    for (const TriangleMesh& mesh : {box, round}) {
      const std::vector<RestingPose> straight = resting_poses(mesh);
      const std::vector<RestingPose> askew = resting_poses(mesh.transformed(pose));
      REQUIRE(askew.size() == straight.size());
      for (std::size_t k = 0; k < askew.size(); ++k) {
        CHECK(askew[k].share == doctest::Approx(straight[k].share).epsilon(1e-3));
      }
    }
  }
}

TEST_CASE("resting poses: meshes without volume are refused") {
  expect_bad_input("mesh", "no triangles", [] { resting_poses({}); });
  const std::vector<Eigen::Vector3f> square = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  expect_bad_input("mesh", "volume", [&] { resting_poses({square, {{0, 1, 2}, {0, 2, 1}}}); });
  // A box, and outside of it a larger part of its volume that is turned inside out.
  const TriangleMesh box = cuboid(0.1, 0.1, 0.1);
  const TriangleMesh hollow =
      cuboid(0.09, 0.09, 0.09).transformed(Pose::from_translation({0.2, 0, 0}));
  std::vector<Eigen::Vector3f> vertices = box.vertices();
  vertices.insert(vertices.end(), hollow.vertices().begin(), hollow.vertices().end());
  std::vector<Triangle> triangles = box.triangles();
  for (const auto& [a, b, c] : hollow.triangles()) triangles.push_back({a + 8, c + 8, b + 8});
  expect_bad_input("mesh", "centre of mass lies outside", [&] {
    resting_poses({vertices, triangles});
  });
}

}  // namespace vantage::test
