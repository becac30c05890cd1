#include "support/hidden_supports.hpp"

#include <algorithm>

namespace vantage::reconstruction::detail {
namespace {

constexpr double kFacesDown = -0.3;  ///< z of a normal
constexpr double kInwards = 0.1;     ///< of the way from a corner to the middle of its face
constexpr double kBelow_m = 0.003;   ///< what is nearer may be the body itself
constexpr std::size_t kMostPlaces = 48;

std::vector<Eigen::Vector3d> underside(const SupportBody& body) {
  std::vector<Eigen::Vector3d> points;
  const std::vector<Triangle>& triangles = body.mesh->triangles();
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (body.normals[t].z() > kFacesDown) continue;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const std::uint32_t corner : triangles[t]) middle += body.vertices[corner] / 3;
    points.push_back(middle);
    for (const std::uint32_t corner : triangles[t]) {
      points.push_back(body.vertices[corner] + kInwards * (middle - body.vertices[corner]));
    }
  }
  if (points.size() <= kMostPlaces) return points;
  std::vector<Eigen::Vector3d> kept;
  for (std::size_t i = 0; i < kMostPlaces; ++i) {
    kept.push_back(points[i * points.size() / kMostPlaces]);
  }
  return kept;
}

}  // namespace

std::vector<HiddenPlace> hidden_places(std::span<const SupportBody> bodies, std::size_t body,
                                       const SpaceProbe& space, const SupportOptions& options) {
  std::vector<HiddenPlace> places;
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  for (const Eigen::Vector3d& point : underside(bodies[body])) {
    const double below = kBelow_m + contact_slack(bodies[body], nullptr, point, up, options);
    const SpaceState state = space ? space(point - below * up) : SpaceState::unseen;
    if (state == SpaceState::empty) continue;
    const double cost = state == SpaceState::occupied ? 1 : 1.5;
    places.push_back({{body, point, cost}, state});
  }
  return places;
}

Eigen::AlignedBox3d region_under(std::span<const HiddenPlace> places, const SupportBody& body,
                                 const SupportOptions& options) {
  Eigen::AlignedBox3d region;
  for (const HiddenPlace& place : places) region.extend(place.support.point);
  const double height = body.bounds.sizes().z();
  const double ground = options.floor_z_m.value_or(region.min().z() - height);
  region.min().z() = std::min(region.min().z() - options.slack_m, ground);
  return region;
}

}  // namespace vantage::reconstruction::detail
