#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "simulator/placement/convex_hull.hpp"
#include "simulator/placement/mass_properties.hpp"
#include "simulator/placement/placement.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

// How far inside a face the centre of mass has to lie, of its own height above the face: less, and
// a breath would topple the body.
constexpr double kMargin = 1e-6;

// What the floor sees when the body lies on this face.
struct Stance {
  double height_m = 0;   // of the centre of mass
  double share = 0;      // of the directions seen from the centre of mass
  std::size_t ends = 0;  // the face on which it comes to rest
};

// Of a triangle seen from `eye`: van Oosterom and Strackee, "The solid angle of a plane triangle",
// 1983, equation 8.
double solid_angle(const Eigen::Vector3d& eye, Eigen::Vector3d a, Eigen::Vector3d b,
                   Eigen::Vector3d c) {
  a = (a - eye).normalized(), b = (b - eye).normalized(), c = (c - eye).normalized();
  return 2 * std::atan2(std::abs(a.dot(b.cross(c))), 1 + a.dot(b) + b.dot(c) + c.dot(a));
}

Stance look_at(const HullFace& face, const Eigen::Vector3d& mass_centre) {
  Stance stance;
  stance.height_m = face.normal.dot(face.centre - mass_centre);
  for (const HullEdge& edge : face.edges) {
    stance.share += solid_angle(mass_centre, face.centre, edge.a, edge.b);
  }
  return stance;
}

// The edge that the centre of mass, dropped on the face's plane, is farthest beyond; null if it is
// inside.
const HullEdge* tipping_edge(const HullFace& face, const Eigen::Vector3d& mass_centre,
                             double margin_m) {
  const HullEdge* tipping = nullptr;
  double least = margin_m;
  for (const HullEdge& edge : face.edges) {
    const Eigen::Vector3d inwards = face.normal.cross(edge.b - edge.a).normalized();
    const double inside = inwards.dot(mass_centre - edge.a);
    if (inside < least) least = inside, tipping = &edge;
  }
  return tipping;
}

// Rolling lowers the centre of mass. So every face rolls over to a lower one, whose end is known if
// the lowest faces come first; one that would roll upwards is flat to rounding, and stays.
void roll(const std::vector<HullFace>& faces, const Eigen::Vector3d& mass_centre,
          std::vector<Stance>& stances) {
  std::vector<std::size_t> order(faces.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return stances[a].height_m < stances[b].height_m;
  });
  for (const std::size_t i : order) {
    Stance& here = stances[i];
    const HullEdge* edge = tipping_edge(faces[i], mass_centre, kMargin * here.height_m);
    const bool rolls = edge != nullptr && stances[edge->beyond].height_m < here.height_m;
    here.ends = rolls ? stances[edge->beyond].ends : i;
  }
}

RestingPose rest_on(const HullFace& face, const std::vector<Eigen::Vector3d>& points) {
  RestingPose pose;
  pose.rotation =
      rotation_between(face.normal, -Eigen::Vector3d::UnitZ()).normalized().toRotationMatrix();
  const Eigen::RowVector3d upwards = pose.rotation.row(2);
  double lowest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& point : points) lowest = std::min(lowest, upwards.dot(point));
  pose.height_m = -lowest;
  return pose;
}

}  // namespace

std::vector<RestingPose> resting_poses(const TriangleMesh& mesh) {
  const Eigen::Vector3d mass_centre = mass_properties(mesh).centre;
  const std::vector<Eigen::Vector3d> points = surface_points(mesh);
  const std::vector<HullFace> faces = convex_hull_faces(points);

  std::vector<Stance> stances;
  double all = 0;
  for (const HullFace& face : faces) {
    stances.push_back(look_at(face, mass_centre));
    if (stances.back().height_m <= 0) {
      throw bad_input("mesh",
                      "its centre of mass lies outside its surface; expected closed surfaces whose "
                      "faces all point outwards");
    }
    all += stances.back().share;
  }
  roll(faces, mass_centre, stances);

  std::vector<double> shares(faces.size());
  for (const Stance& stance : stances) shares[stance.ends] += stance.share / all;
  std::vector<RestingPose> poses;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (stances[i].ends != i) continue;
    poses.push_back(rest_on(faces[i], points));
    poses.back().share = shares[i];
  }
  std::stable_sort(poses.begin(), poses.end(),
                   [](const RestingPose& a, const RestingPose& b) { return a.share > b.share; });
  return poses;
}

}  // namespace vantage
