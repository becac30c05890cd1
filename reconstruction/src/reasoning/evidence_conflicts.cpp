#include "reasoning/evidence_conflicts.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/raycore/detail/mesh_measures.hpp"

namespace vantage::reconstruction::detail {
namespace {

constexpr std::size_t kMostCorners = 3;  ///< of a marker's four, to say that it is hidden
constexpr double kImpossible = -40;      ///< outweighs any number of features
constexpr double kInsideSolid = -6;      ///< structures may be off by more than objects are
constexpr std::size_t kBodyPoints = 16;

/// Whether the way from the eye to most of these points is blocked before they are reached.
bool is_hidden(const Scene& scene, const Eigen::Vector3d& eye,
               std::span<const Eigen::Vector3d> points, double slack_m) {
  const auto blocked = std::ranges::count_if(points, [&](const Eigen::Vector3d& point) {
    const Eigen::Vector3d way = point - eye;
    const double length = way.norm();
    if (length <= slack_m) return false;
    const Eigen::Vector3d end = eye + way * (1 - slack_m / length);
    return scene.occluded(eye.cast<float>(), end.cast<float>());
  });
  return std::size_t(blocked) >= std::min(points.size(), kMostCorners) && blocked > 0;
}

/// Whether a line of sight comes near enough to a sphere that what is in it may block it.
bool may_block(const Eigen::Vector3d& centre, double radius_m, const Eigen::Vector3d& eye,
               const Eigen::Vector3d& point, double beside_m) {
  const Eigen::Vector3d way = point - eye;
  const double share = std::clamp((centre - eye).dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (eye + share * way - centre).norm() <= radius_m + beside_m;
}

double extent_of(std::span<const Eigen::Vector3d> points) {
  double extent = 0;
  for (const Eigen::Vector3d& point : points) {
    extent = std::max(extent, (point - points.front()).norm());
  }
  return extent;
}

std::vector<Eigen::Vector3d> placed_points(const ReconstructedObject& object, std::size_t feature) {
  std::vector<Eigen::Vector3d> points = object.type->features[feature].points();
  for (Eigen::Vector3d& point : points) point = object.T_world_object * point;
  return points;
}

}  // namespace

double slack_of(const ReconstructedObject& object) {
  constexpr double kContact_m = 0.004, kSigmas = 3;
  if (!object.covariance) return kContact_m;
  return kContact_m + kSigmas * std::sqrt(object.covariance->topLeftCorner<3, 3>().trace() / 3);
}

Conflicts::Conflicts(std::span<const CameraView> views, const SceneKnowledge& knowledge,
                     std::span<const ReconstructedObject> objects)
    : views_(views), knowledge_(knowledge) {
  for (const KnownObject& solid : knowledge.solids) {
    SceneBuilder builder;
    builder.add_instance(solid.mesh, solid.T_world_object);
    solids_.push_back({&solid, builder.build(), raycore::detail::bounds_of(*solid.mesh)});
  }
  for (const ReconstructedObject& object : objects) {
    const Eigen::AlignedBox3d bounds = raycore::detail::bounds_of(*object.type->mesh);
    Placed placed;
    placed.object = &object;
    placed.slack_m = slack_of(object);
    placed.centre = object.T_world_object.translation();
    if (!bounds.isEmpty()) {
      placed.centre = object.T_world_object * bounds.center();
      placed.radius_m = bounds.diagonal().norm() / 2;
    }
    placed.body = Body(object, placed.slack_m).scene();
    for (const Support& support : object.support) {
      placed.seen.push_back(placed_points(object, support.feature));
    }
    placed_.push_back(std::move(placed));
  }
}

const Eigen::Vector3d& Conflicts::eye(std::size_t view) const {
  return views_[view].T_world_cam->translation();
}

Contradiction Conflicts::hidden_by_solid(std::size_t object) const {
  const Placed& placed = placed_[object];
  for (std::size_t s = 0; s < placed.seen.size(); ++s) {
    if (placed.seen[s].empty()) continue;
    const std::size_t view = placed.object->support[s].id.view;
    for (const Solid& solid : solids_) {
      // A camera's own housing, which it looks out of, hides nothing.
      if (solid.bounds.contains(solid.object->T_world_object.inverse() * eye(view))) continue;
      if (!is_hidden(*solid.scene, eye(view), placed.seen[s], placed.slack_m)) continue;
      return {fmt::format("a {} there would be hidden from image {} by {}",
                          placed.object->type->name, views_[view].name, solid.object->name),
              kImpossible};
    }
  }
  return {};
}

Contradiction Conflicts::hides_board(std::size_t object) const {
  const Placed& placed = placed_[object];
  if (placed.body == nullptr) return {};
  for (std::size_t v = 0; v < knowledge_.seen_points.size(); ++v) {
    if (!views_[v].T_world_cam) continue;
    const std::span<const Eigen::Vector3d> points = knowledge_.seen_points[v];
    for (std::size_t i = 0; i + 4 <= points.size(); i += 4) {
      const auto marker = points.subspan(i, 4);
      if (!may_block(placed.centre, placed.radius_m, eye(v), marker[0], extent_of(marker)) ||
          !is_hidden(*placed.body, eye(v), marker, placed.slack_m)) {
        continue;
      }
      return {fmt::format("a {} there would hide a marker of the board that image {} sees",
                          placed.object->type->name, views_[v].name),
              kImpossible};
    }
  }
  return {};
}

Contradiction Conflicts::inside_solid(std::size_t object) const {
  const Placed& placed = placed_[object];
  const TriangleMesh mesh = Body(*placed.object, placed.slack_m).mesh();
  if (mesh.empty()) return {};
  const std::size_t step = std::max<std::size_t>(1, mesh.vertices().size() / kBodyPoints);
  for (const Solid& solid : solids_) {
    const Pose T_solid_world = solid.object->T_world_object.inverse();
    const auto is_inside = [&](const Eigen::Vector3d& p_world) {
      return solid.bounds.contains(T_solid_world * p_world) && solid.scene->encloses(p_world);
    };
    bool inside = is_inside(placed.centre);
    for (std::size_t v = 0; v < mesh.vertices().size() && !inside; v += step) {
      inside = is_inside(mesh.vertices()[v].cast<double>());
    }
    if (!inside) continue;
    return {fmt::format("a {} there would reach into {}", placed.object->type->name,
                        solid.object->name),
            kInsideSolid};
  }
  return {};
}

std::optional<std::size_t> Conflicts::view_that_sees_through(const Placed& front,
                                                             const Placed& back) const {
  if (front.body == nullptr) return std::nullopt;
  for (std::size_t s = 0; s < back.seen.size(); ++s) {
    const std::vector<Eigen::Vector3d>& points = back.seen[s];
    if (points.empty()) continue;
    const std::size_t view = back.object->support[s].id.view;
    if (!may_block(front.centre, front.radius_m, eye(view), points[0], extent_of(points))) continue;
    if (is_hidden(*front.body, eye(view), points, front.slack_m + back.slack_m)) return view;
  }
  return std::nullopt;
}

std::string Conflicts::exclusion(std::size_t object, std::size_t other) const {
  const Placed &a = placed_[object], &b = placed_[other];
  const std::string &type = a.object->type->name, &other_type = b.object->type->name;
  if (const auto view = view_that_sees_through(a, b)) {
    return fmt::format("a {} there would hide a feature of a {} that image {} sees", type,
                       other_type, views_[*view].name);
  }
  if (const auto view = view_that_sees_through(b, a)) {
    return fmt::format("a {} there would be hidden from image {} by a {}", type, views_[*view].name,
                       other_type);
  }
  const bool near = (a.centre - b.centre).norm() < a.radius_m + b.radius_m;
  if (near && overlap(*a.object, *b.object, a.slack_m + b.slack_m)) {
    return fmt::format("a {} there would stand inside a {} for which there is more evidence", type,
                       other_type);
  }
  return {};
}

}  // namespace vantage::reconstruction::detail
