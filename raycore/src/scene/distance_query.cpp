// What is close to a point or a box, by Embree's point queries; and whether a point is inside a
// solid.
#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "geometry/coordinates.hpp"
#include "geometry/triangle_distance.hpp"
#include "scene/ray_packet.hpp"
#include "scene/scene_impl.hpp"
#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/detail/box_projector.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace raycore::detail {
namespace {

/// A search for one triangle that passes a test.
template <class Test>
struct Search {
  const SceneImpl& scene;
  ObjectId object;  ///< that counts; kNoObject: all do
  const Test& test;
  bool found = false;
};

template <class Test>
bool visit(RTCPointQueryFunctionArguments* arguments) {
  Search<Test>& search = *static_cast<Search<Test>*>(arguments->userPtr);
  const bool in_instance = arguments->context->instStackSize > 0;
  const ObjectId object = in_instance ? arguments->context->instID[0] : arguments->geomID;
  const bool counts = search.object == kNoObject || search.object == object;
  if (search.found || !counts) return false;
  if (!search.test(search.scene.triangles[object].corners(arguments->primID))) return false;
  search.found = true;
  arguments->query->radius = 0;  // leaves nothing more to visit
  return true;
}

/// Whether a triangle within `radius_m` of a point passes the test. Triangles that are a little
/// farther away may be tested, too.
template <class Test>
bool any_near(const SceneImpl& scene, const Eigen::Vector3d& p_world, double radius_m,
              ObjectId object, const Test& test) {
  // Embree computes in float.
  const double farthest = p_world.cwiseAbs().maxCoeff() + radius_m;
  RTCPointQuery query{};
  query.x = float(p_world.x()), query.y = float(p_world.y()), query.z = float(p_world.z());
  query.radius = float(radius_m + kRoundingOfRays * farthest);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  Search<Test> search{scene, object, test};
  rtcPointQuery(scene.top, &query, &context, visit<Test>, &search);
  return search.found;
}

void check_query(const Eigen::Vector3d& p_world, double distance_m) {
  if (!in_reach(float(p_world.x()), float(p_world.y()), float(p_world.z()))) {
    throw bad_input("point",
                    fmt::format("it is at {} m; expected finite coordinates within 1e9 m of the "
                                "origin",
                                to_text(p_world)));
  }
  if (!(distance_m >= 0 && distance_m <= double(kFarthestCoordinate))) {
    throw bad_input("distance",
                    fmt::format("it is {} m; expected a number from 0 to 1e9", distance_m));
  }
}

}  // namespace
}  // namespace raycore::detail

bool Scene::closer_than(double distance_m, const Eigen::Vector3d& p_world, ObjectId object) const {
  raycore::detail::check_query(p_world, distance_m);
  const double squared = distance_m * distance_m;
  return raycore::detail::any_near(
      *impl_, p_world, distance_m, object, [&](const raycore::detail::TriangleCorners& triangle) {
        return raycore::detail::squared_distance(p_world, triangle) < squared;
      });
}

bool Scene::closer_than(double distance_m, const Box& box, const Pose& T_world_box,
                        ObjectId object) const {
  const Eigen::Vector3d half = 0.5 * box.size(), centre = T_world_box * box.centre();
  raycore::detail::check_query(centre, distance_m);
  const Eigen::Matrix3d R_box_world = T_world_box.rotation().transpose();
  return raycore::detail::any_near(*impl_, centre, half.norm() + distance_m, object,
                                   [&](raycore::detail::TriangleCorners triangle) {
                                     for (Eigen::Vector3d& corner : triangle)
                                       corner = R_box_world * (corner - centre);
                                     return raycore::detail::closer_to_box_than(distance_m, half,
                                                                                triangle);
                                   });
}

namespace {

/// Not quite along the axes, as the edges of boxes are.
const Eigen::Vector3f kDirections[] = {
    {0.0131f, 0.0247f, 1}, {1, 0.0173f, 0.0291f}, {0.0263f, 1, 0.0119f}};

struct Crossings {
  bool any = false;
  std::vector<ObjectId> left;  ///< more often than entered
};

Crossings crossings_along(const Scene& scene, const Eigen::Vector3f& from,
                          const Eigen::Vector3f& direction) {
  std::vector<std::pair<ObjectId, int>> counts;  // exits less entries
  Ray ray{from, direction};
  while (const std::optional<Hit> hit = scene.closest_hit(ray)) {
    auto known = std::find_if(counts.begin(), counts.end(),
                              [&](const auto& entry) { return entry.first == hit->object; });
    if (known == counts.end()) known = counts.insert(known, {hit->object, 0});
    known->second += hit->normal.dot(direction) > 0 ? 1 : -1;
    const float size = std::max({hit->t, from.cwiseAbs().maxCoeff(), 1e-3f});
    ray.t_near = hit->t + 1e-6f * size;  // past this hit, rounding included
  }
  Crossings crossings{!counts.empty(), {}};
  for (const auto& [object, count] : counts) {
    if (count > 0) crossings.left.push_back(object);
  }
  return crossings;
}

bool share_one(const std::vector<ObjectId>& some, const std::vector<ObjectId>& others) {
  return std::find_first_of(some.begin(), some.end(), others.begin(), others.end()) != some.end();
}

}  // namespace

bool Scene::encloses(const Eigen::Vector3d& p_world) const {
  const Eigen::Vector3f point = p_world.cast<float>();
  int votes = 0;
  for (const Eigen::Vector3f& direction : kDirections) {
    const Crossings forth = crossings_along(*this, point, direction);
    if (!forth.any) return false;  // a way out into the open: certain
    const Crossings back = crossings_along(*this, point, -direction);
    if (!back.any) return false;
    votes += share_one(forth.left, back.left);
  }
  return votes >= 2;
}

}  // namespace vantage
