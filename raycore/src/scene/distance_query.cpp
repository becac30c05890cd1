// What is close to a point or a box, by Embree's point queries.

#include <fmt/format.h>

#include "geometry/coordinates.hpp"
#include "geometry/triangle_distance.hpp"
#include "scene/packet.hpp"
#include "scene/scene_impl.hpp"
#include "vantage/raycore/box_projector.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/raycore/scene.hpp"

namespace vantage {
namespace detail {
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
}  // namespace detail

bool Scene::closer_than(double distance_m, const Eigen::Vector3d& p_world, ObjectId object) const {
  detail::check_query(p_world, distance_m);
  const double squared = distance_m * distance_m;
  return detail::any_near(*impl_, p_world, distance_m, object,
                          [&](const detail::TriangleCorners& triangle) {
                            return detail::squared_distance(p_world, triangle) < squared;
                          });
}

bool Scene::closer_than(double distance_m, const Box& box, const Pose& T_world_box,
                        ObjectId object) const {
  const Eigen::Vector3d half = 0.5 * box.size(), centre = T_world_box * box.centre();
  detail::check_query(centre, distance_m);
  const Eigen::Matrix3d R_box_world = T_world_box.rotation().transpose();
  return detail::any_near(*impl_, centre, half.norm() + distance_m, object,
                          [&](detail::TriangleCorners triangle) {
                            for (Eigen::Vector3d& corner : triangle)
                              corner = R_box_world * (corner - centre);
                            return detail::closer_to_box_than(distance_m, half, triangle);
                          });
}

}  // namespace vantage
