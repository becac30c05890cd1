#include "simulator/markers/marked_face.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "simulator/markers/flat_face.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage::simulator::detail {
namespace {

constexpr double kMaxDistance = 1e-4;    // metres, of a marker from its face
constexpr double kMaxAngle = 0.01;       // radians, between their normals
constexpr double kAreaTolerance = 1e-6;  // what floats cannot tell, as a part of a marker's area

void check_size(const Marker& marker, const std::string& place) {
  if (std::isfinite(marker.size_m) && marker.size_m > 2 * kMaxDistance) return;
  throw bad_input(place, fmt::format("size_m is {}; expected a finite length above {} m",
                                     marker.size_m, 2 * kMaxDistance));
}

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// The largest triangle on which the marker's centre lies: it knows its normal best.
std::uint32_t triangle_under(const TriangleMesh& mesh, const Marker& marker,
                             const std::string& place) {
  const Eigen::Vector3d centre = marker.T_object_marker.translation();
  const Eigen::Vector3d normal = marker.T_object_marker.rotation().col(2);
  double min_distance = std::numeric_limits<double>::infinity();
  double min_angle = std::numbers::pi, largest_area = 0;
  std::uint32_t best = 0;
  for (std::uint32_t t = 0; t < mesh.triangles().size(); ++t) {
    const double distance = distance_to(mesh, t, centre);
    min_distance = std::min(min_distance, distance);
    if (distance > kMaxDistance) continue;
    const double angle = angle_between(normal_of(mesh, t), normal);
    min_angle = std::min(min_angle, angle);
    if (angle > kMaxAngle || area_of(mesh, t) <= largest_area) continue;
    largest_area = area_of(mesh, t);
    best = t;
  }
  if (largest_area > 0) return best;
  if (min_distance > kMaxDistance) {
    throw bad_input(place, fmt::format("its centre is {:.3g} mm from the nearest face; expected it "
                                       "on a face (0.1 mm at most): correct its position",
                                       1000 * min_distance));
  }
  throw bad_input(place, fmt::format("its z axis is {:.3g} degrees off the face's outward normal; "
                                     "expected 0.57 at most: correct its rotation",
                                     min_angle * 180 / std::numbers::pi));
}

/// With z along the face's normal, and x along the marker's as far as the face goes.
Pose face_frame(const TriangleMesh& mesh, std::uint32_t seed, const Marker& marker) {
  const Eigen::Vector3d z = normal_of(mesh, seed);
  const Eigen::Vector3d y = z.cross(marker.T_object_marker.rotation().col(0)).normalized();
  Eigen::Matrix3d rotation;
  rotation << y.cross(z), y, z;
  const Eigen::Vector3d centre = marker.T_object_marker.translation();
  const double height = z.dot(centre - mesh.corner(seed, 0).cast<double>());
  return Pose::from_rotation(rotation, centre - height * z);
}

/// How much of a square around the marker's centre the face covers.
double covered_area(const TriangleMesh& mesh, const MarkedFace& face, const Marker& marker,
                    double half_side) {
  const Pose T_marker_object = marker.T_object_marker.inverse();
  double area = 0;
  for (const std::uint32_t t : face.triangles) {
    std::array<Eigen::Vector2d, 3> corners;
    for (int i = 0; i < 3; ++i) {
      corners[std::size_t(i)] = (T_marker_object * mesh.corner(t, i).cast<double>()).head<2>();
    }
    area += area_inside_square(corners, half_side);
  }
  return area;
}

void check_inside(const TriangleMesh& mesh, const MarkedFace& face, const Marker& marker,
                  const std::string& place) {
  const double half_side = marker.size_m / 2 - kMaxDistance;
  const double missing =
      1 - covered_area(mesh, face, marker, half_side) / (4 * half_side * half_side);
  if (missing <= kAreaTolerance) return;
  throw bad_input(place, fmt::format("{:.3g} % of its square of {} m lie beyond the face's edge; "
                                     "expected all of it on the face: move it or make it smaller",
                                     100 * missing, marker.size_m));
}

void check_free(const PrintedMarker& other, const Marker& marker, const Pose& T_object_face,
                const std::string& place) {
  std::array<Eigen::Vector2d, 4> p;  // the marker's corners, as the other one sees them
  const Pose T_other_object = other.T_marker_face * T_object_face.inverse();
  const auto corners = marker.corners();
  for (std::size_t i = 0; i < 4; ++i) p[i] = (T_other_object * corners[i]).head<2>();
  const double shared = area_inside_square({p[0], p[1], p[2]}, other.size_m / 2) +
                        area_inside_square({p[0], p[2], p[3]}, other.size_m / 2);
  if (shared <= kAreaTolerance * marker.size_m * marker.size_m) return;
  throw bad_input(place, fmt::format("it lies on {}; markers must not overlap", other.place));
}

}  // namespace

std::vector<MarkedFace> marked_faces(const TriangleMesh& mesh, std::span<const Marker> markers,
                                     const std::string& where) {
  const FaceFinder finder(mesh);
  std::vector<MarkedFace> faces;
  for (const Marker& marker : markers) {
    const std::string place =
        fmt::format("{}, marker {} of {}", where, marker.id, marker.dictionary);
    check_size(marker, place);
    const std::uint32_t seed = triangle_under(mesh, marker, place);
    auto face = std::find_if(faces.begin(), faces.end(), [&](const MarkedFace& f) {
      return std::binary_search(f.triangles.begin(), f.triangles.end(), seed);
    });
    if (face == faces.end()) {
      faces.push_back({finder.flat_face(seed), face_frame(mesh, seed, marker), {}});
      face = faces.end() - 1;
    }
    check_inside(mesh, *face, marker, place);
    for (const PrintedMarker& other : face->markers) {
      check_free(other, marker, face->T_object_face, place);
    }
    face->markers.push_back({place, marker.size_m,
                             marker_cells(marker.dictionary, marker.id, place),
                             marker.T_object_marker.inverse() * face->T_object_face});
  }
  return faces;
}

}  // namespace vantage::simulator::detail
