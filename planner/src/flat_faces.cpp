#include "flat_faces.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace vantage::detail {
namespace {

constexpr std::size_t kMostTriangles = 10'000;  // of an object
constexpr std::size_t kMostFaces = 1000;        // of a scene

struct SizedFace {
  double area_m2;
  std::array<Eigen::Vector3d, 4> corners;
};

double area_m2(const std::array<Eigen::Vector3d, 4>& c) {
  return 0.5 * (c[2] - c[0]).cross(c[3] - c[1]).norm();
}

/// Two triangles abc and acd of one plane are a face abcd if that is a rectangle.
bool are_rectangle(const std::array<Eigen::Vector3d, 3>& abc,
                   const std::array<Eigen::Vector3d, 3>& acd) {
  return abc[0] == acd[0] && abc[2] == acd[1] && abc[0] + abc[2] == abc[1] + acd[2];
}

void add_faces(const Scene& scene, ObjectId object, std::vector<SizedFace>& faces) {
  const std::size_t count = scene.triangle_count(object);
  if (count > kMostTriangles) return;
  for (std::size_t i = 0; i < count; ++i) {
    const auto abc = scene.corners(object, i);
    std::array<Eigen::Vector3d, 4> corners{abc[0], abc[1], abc[2], abc[2]};
    if (i + 1 < count && are_rectangle(abc, scene.corners(object, i + 1))) {
      corners[3] = scene.corners(object, ++i)[2];
    }
    faces.push_back({area_m2(corners), corners});
  }
}

}  // namespace

void FlatFaces::add(const std::array<Eigen::Vector3d, 4>& corners) {
  Face face;
  for (std::size_t i = 0; i < 4; ++i) {
    face.corners[i] = std::uint32_t(x.size());
    x.push_back(corners[i].x()), y.push_back(corners[i].y()), z.push_back(corners[i].z());
    largest_coordinate_m = std::max(largest_coordinate_m, corners[i].cwiseAbs().maxCoeff());
  }
  face.normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).stableNormalized();
  face.offset_m = face.normal.dot(corners[0]);
  list.push_back(face);
}

FlatFaces rectangles_of(const TriangleMesh& faces) {
  FlatFaces result;
  for (const Eigen::Vector3f& corner : faces.vertices()) {
    const Eigen::Vector3d c = corner.cast<double>();
    result.x.push_back(c.x()), result.y.push_back(c.y()), result.z.push_back(c.z());
    result.largest_coordinate_m = std::max(result.largest_coordinate_m, c.cwiseAbs().maxCoeff());
  }
  for (std::size_t i = 0; i + 1 < faces.triangles().size(); i += 2) {
    const Triangle &abc = faces.triangles()[i], &acd = faces.triangles()[i + 1];
    const Eigen::Vector3d a = faces.vertices()[abc[0]].cast<double>();
    const Eigen::Vector3d ab = faces.vertices()[abc[1]].cast<double>() - a;
    const Eigen::Vector3d ac = faces.vertices()[abc[2]].cast<double>() - a;
    const Eigen::Vector3d normal = ab.cross(ac).stableNormalized();
    result.list.push_back({{abc[0], abc[1], abc[2], acd[2]}, normal, normal.dot(a)});
  }
  return result;
}

FlatFaces largest_faces_of(const Scene& scene) {
  std::vector<SizedFace> faces;
  for (ObjectId object = 0; object < scene.object_count(); ++object) {
    add_faces(scene, object, faces);
  }
  std::stable_sort(faces.begin(), faces.end(),
                   [](const SizedFace& a, const SizedFace& b) { return a.area_m2 > b.area_m2; });
  FlatFaces result;
  for (std::size_t i = 0; i < std::min(faces.size(), kMostFaces); ++i) result.add(faces[i].corners);
  return result;
}

}  // namespace vantage::detail
