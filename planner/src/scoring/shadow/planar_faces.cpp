#include "scoring/shadow/planar_faces.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "scoring/voxel/point_hierarchy.hpp"

namespace vantage::planner::detail {
namespace {

constexpr std::size_t kMaxTriangles = 10'000;  // of an object
constexpr std::size_t kMaxOccluders = 100;     // of a scene

FaceCorners face_of(const std::array<Eigen::Vector3d, 4>& c) {
  return {c, (c[1] - c[0]).cross(c[2] - c[0]).stableNormalized()};
}

struct SizedFace {
  double area_m2;
  FaceCorners face;
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
  if (count > kMaxTriangles) return;
  for (std::size_t i = 0; i < count; ++i) {
    const auto abc = scene.corners(object, i);
    std::array<Eigen::Vector3d, 4> corners{abc[0], abc[1], abc[2], abc[2]};
    if (i + 1 < count && are_rectangle(abc, scene.corners(object, i + 1))) {
      corners[3] = scene.corners(object, ++i)[2];
    }
    faces.push_back({area_m2(corners), face_of(corners)});
  }
}

/// Which of the six half axes a normal is nearest to: faces on different sides of something are
/// rarely seen together.
int side_of(const Eigen::Vector3d& normal) {
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  return 2 * axis + (normal[axis] > 0 ? 1 : 0);
}

}  // namespace

FlatFaces::FlatFaces(const std::vector<FaceCorners>& faces) {
  Points middles;
  for (const FaceCorners& face : faces) {
    middles.push_back((0.5 * (face.corners[0] + face.corners[2])).cast<float>());
  }
  std::vector<std::uint32_t> order = z_curve_order(middles);
  const auto side = [&](std::uint32_t i) { return side_of(faces[i].normal); };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return side(a) < side(b); });
  for (std::size_t first = 0; first < order.size();) {
    std::size_t last = first;
    while (last < std::min(first + kMaxFaces, order.size()) &&
           side(order[last]) == side(order[first])) {
      ++last;
    }
    add_group(faces, std::span(order).subspan(first, last - first));
    first = last;
  }
  boxes = BoxLanes(groups.size());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    Eigen::AlignedBox3d box;
    for (std::uint32_t c = groups[i].first_corner; c < groups[i].last_corner; ++c) {
      box.extend(Eigen::Vector3d(x[c], y[c], z[c]));
    }
    boxes.set(i, box.min(), box.max());
  }
}

void FlatFaces::add_group(const std::vector<FaceCorners>& faces,
                          std::span<const std::uint32_t> members) {
  Group group{std::uint32_t(list.size()), 0, std::uint32_t(x.size()), 0, true, 1e300, -1e300};
  const auto corner = [&](const Eigen::Vector3d& p) {
    std::uint32_t i = group.first_corner;
    while (i < x.size() && Eigen::Vector3d(x[i], y[i], z[i]) != p) ++i;
    if (i < x.size()) return i;
    x.push_back(p.x()), y.push_back(p.y()), z.push_back(p.z());
    largest_coordinate_m = std::max(largest_coordinate_m, p.cwiseAbs().maxCoeff());
    return i;
  };
  for (const std::uint32_t member : members) {
    const FaceCorners& face = faces[member];
    const double offset_m = face.normal.dot(face.corners[0]);
    list.push_back({{}, face.normal, offset_m});
    for (std::size_t i = 0; i < 4; ++i) list.back().corners[i] = corner(face.corners[i]);
    group.parallel &= face.normal == faces[members.front()].normal;
    group.lowest_m = std::min(group.lowest_m, offset_m);
    group.highest_m = std::max(group.highest_m, offset_m);
  }
  group.last_face = std::uint32_t(list.size());
  group.last_corner = std::uint32_t(x.size());
  groups.push_back(group);
}

FlatFaces rectangles_of(const TriangleMesh& faces) {
  std::vector<FaceCorners> rectangles;
  const auto corner = [&](std::uint32_t i) { return faces.vertices()[i].cast<double>(); };
  for (std::size_t i = 0; i + 1 < faces.triangles().size(); i += 2) {
    const Triangle &abc = faces.triangles()[i], &acd = faces.triangles()[i + 1];
    rectangles.push_back(face_of({corner(abc[0]), corner(abc[1]), corner(abc[2]), corner(acd[2])}));
  }
  return FlatFaces(rectangles);
}

FlatFaces largest_faces_of(const Scene& scene) {
  std::vector<SizedFace> sized;
  for (ObjectId object = 0; object < scene.object_count(); ++object) {
    add_faces(scene, object, sized);
  }
  std::stable_sort(sized.begin(), sized.end(),
                   [](const SizedFace& a, const SizedFace& b) { return a.area_m2 > b.area_m2; });
  std::vector<FaceCorners> faces;
  for (std::size_t i = 0; i < std::min(sized.size(), kMaxOccluders); ++i) {
    faces.push_back(sized[i].face);
  }
  return FlatFaces(faces);
}

}  // namespace vantage::planner::detail
