#include "support/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/facing_triangles.hpp"

namespace vantage::reconstruction::detail {
namespace {

constexpr double kFlat_rad = 0.02;  ///< faces that are tilted by less lie flat, whatever the poses
constexpr double kSteepest_rad = 0.5;  ///< none that is tilted by more does
constexpr double kDeepShare = 0.25;    ///< of the thinner body: deeper in it nothing is its surface
constexpr double kOneNormal = 0.996;   ///< cosine; normals that differ by less are one
constexpr std::size_t kMostPairs = 400000;  ///< of triangles, to be looked at one by one

double thickness_of(const SupportBody& body) {
  return body.bounds.isEmpty() ? 0 : body.bounds.sizes().minCoeff();
}

double flat_cosine_of(const SupportBody& upper, const SupportBody* lower,
                      const SupportOptions& options) {
  const double sigma = std::hypot(upper.tilt_sigma, lower ? lower->tilt_sigma : 0);
  return std::cos(std::min(kSteepest_rad, kFlat_rad + options.sigmas * sigma));
}

/// A body's triangles in a box; every so many if there are very many.
std::vector<FacingTriangle> triangles_in(const SupportBody& body, const Eigen::AlignedBox3d& box) {
  std::vector<FacingTriangle> result;
  const std::vector<Triangle>& triangles = body.mesh->triangles();
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    FacingTriangle triangle;
    for (std::size_t i = 0; i < 3; ++i) {
      triangle.corners[i] = body.vertices[triangles[t][i]];
      triangle.bounds.extend(triangle.corners[i]);
    }
    if (!triangle.bounds.intersects(box)) continue;
    triangle.normal = body.normals[t];
    result.push_back(triangle);
  }
  return result;
}

Eigen::AlignedBox3d grown(const Eigen::AlignedBox3d& box, double by_m) {
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(by_m);
  return {box.min() - margin, box.max() + margin};
}

void thin_out(std::vector<FacingTriangle>& triangles, std::size_t most) {
  if (triangles.size() <= most) return;
  std::vector<FacingTriangle> kept;
  const std::size_t step = (triangles.size() + most - 1) / most;
  for (std::size_t i = 0; i < triangles.size(); i += step) kept.push_back(triangles[i]);
  triangles = std::move(kept);
}

/// Corners of the touching areas, by the normals.
std::vector<ContactPoint> corners_of(std::vector<ContactPoint> points) {
  std::vector<ContactPoint> result;
  std::stable_partition(points.begin(), points.end(),
                        [](const ContactPoint& p) { return p.is_flat; });
  while (!points.empty()) {
    const ContactPoint first = points.front();
    std::vector<ContactPoint> group, rest;
    for (const ContactPoint& point : points) {
      const bool same =
          point.normal.dot(first.normal) > kOneNormal && point.is_flat == first.is_flat;
      (same ? group : rest).push_back(point);
    }
    for (const ContactPoint& corner : outermost(group)) result.push_back(corner);
    points = std::move(rest);
  }
  return result;
}

ContactPatch patch_of(std::size_t upper, std::size_t lower, std::vector<ContactPoint> points) {
  return {upper, lower, corners_of(std::move(points)), 0};
}

/// How far the upper body may be off sideways.
double sideways_slack(const SupportBody& upper, const SupportBody* lower, const ContactPatch& patch,
                      const SupportOptions& options) {
  double slack = options.slack_m;
  if (patch.points.empty()) return slack;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const ContactPoint& point : patch.points) middle += point.point;
  middle /= double(patch.points.size());
  for (const Eigen::Vector3d& axis : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0)}) {
    slack = std::max(slack, contact_slack(upper, lower, middle, axis, options));
  }
  return slack;
}

void add_floor_contact(std::span<const SupportBody> bodies, std::size_t upper, double floor_z_m,
                       const SupportOptions& options, std::vector<ContactPatch>& patches) {
  const SupportBody& body = bodies[upper];
  const double reach = options.slack_m + options.sigmas * body.most_sigma_m;
  if (body.bounds.isEmpty() || body.bounds.min().z() > floor_z_m + reach) return;
  const double cosine = flat_cosine_of(body, nullptr, options);
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  std::vector<ContactPoint> points;
  const std::vector<Triangle>& triangles = body.mesh->triangles();
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (body.normals[t].z() > -0.05) continue;
    for (const std::uint32_t corner : triangles[t]) {
      const Eigen::Vector3d& p = body.vertices[corner];
      const double gap = p.z() - floor_z_m;
      if (gap > reach || gap > contact_slack(body, nullptr, p, up, options)) continue;
      points.push_back({p, up, gap, -body.normals[t].z() >= cosine, body.normals[t]});
    }
  }
  if (points.empty()) return;
  ContactPatch patch = patch_of(upper, bodies.size(), std::move(points));
  patch.slack_m = sideways_slack(body, nullptr, patch, options);
  patches.push_back(std::move(patch));
}

void add_body_contact(std::span<const SupportBody> bodies, std::size_t upper, std::size_t lower,
                      const SupportOptions& options, std::vector<ContactPatch>& patches) {
  const SupportBody &a = bodies[upper], &b = bodies[lower];
  const double reach =
      options.slack_m + options.sigmas * std::hypot(a.most_sigma_m, b.most_sigma_m);
  const Eigen::AlignedBox3d both = grown(a.bounds, reach).intersection(grown(b.bounds, reach));
  if (both.isEmpty()) return;
  std::vector<FacingTriangle> of_a = triangles_in(a, both), of_b = triangles_in(b, both);
  const double crowd = double(of_a.size()) * double(of_b.size());
  if (crowd > double(kMostPairs)) {
    const double keep = std::sqrt(double(kMostPairs) / crowd);
    thin_out(of_a, std::max<std::size_t>(64, std::size_t(keep * double(of_a.size()))));
    thin_out(of_b, std::max<std::size_t>(64, std::size_t(keep * double(of_b.size()))));
  }
  const double deepest = std::max(reach, kDeepShare * std::min(thickness_of(a), thickness_of(b)));
  const GapLimits limits{deepest, reach, flat_cosine_of(a, &b, options)};
  std::vector<ContactPoint> points;
  for (const FacingTriangle& mine : of_a) {
    const Eigen::AlignedBox3d near = grown(mine.bounds, deepest);
    for (const FacingTriangle& other : of_b) {
      if (near.intersects(other.bounds)) add_contacts(mine, other, limits, points);
    }
  }
  std::erase_if(points, [&](const ContactPoint& p) {
    return p.gap_m > contact_slack(a, &b, p.point, p.normal, options);
  });
  if (points.empty()) return;
  ContactPatch patch = patch_of(upper, lower, std::move(points));
  patch.slack_m = sideways_slack(a, &b, patch, options);
  patches.push_back(std::move(patch));
}

}  // namespace

double contact_slack(const SupportBody& upper, const SupportBody* lower,
                     const Eigen::Vector3d& point, const Eigen::Vector3d& direction,
                     const SupportOptions& options) {
  double variance = upper.variance_at(point, direction);
  if (lower != nullptr) variance += lower->variance_at(point, direction);
  return options.slack_m + options.sigmas * std::sqrt(variance);
}

std::vector<ContactPoint> outermost(std::span<const ContactPoint> points) {
  constexpr int kDirections = 16;
  if (points.empty()) return {};
  const Eigen::Vector3d u = points.front().normal.unitOrthogonal();
  const Eigen::Vector3d v = points.front().normal.cross(u);
  std::vector<std::size_t> chosen;
  for (int d = 0; d < kDirections; ++d) {
    const double angle = 2 * std::numbers::pi * (d + 0.3) / kDirections;
    const Eigen::Vector3d direction = std::cos(angle) * u + std::sin(angle) * v;
    const auto farthest = std::ranges::max_element(
        points, {}, [&](const ContactPoint& p) { return direction.dot(p.point); });
    chosen.push_back(std::size_t(farthest - points.begin()));
  }
  std::vector<ContactPoint> result;
  for (const std::size_t i : chosen) {
    const bool is_there = std::ranges::any_of(result, [&](const ContactPoint& p) {
      return (p.point - points[i].point).squaredNorm() < 1e-12;
    });
    if (!is_there) result.push_back(points[i]);
  }
  return result;
}

std::vector<ContactPatch> find_contacts(std::span<const SupportBody> bodies,
                                        const SupportOptions& options) {
  std::vector<ContactPatch> patches;
  for (std::size_t a = 0; a < bodies.size() && !bodies[a].is_fixed; ++a) {
    if (options.floor_z_m) add_floor_contact(bodies, a, *options.floor_z_m, options, patches);
    for (std::size_t b = a + 1; b < bodies.size(); ++b) {
      const bool is_upper =
          bodies[b].is_fixed || bodies[a].bounds.center().z() >= bodies[b].bounds.center().z();
      add_body_contact(bodies, is_upper ? a : b, is_upper ? b : a, options, patches);
    }
  }
  return patches;
}

ContactScene contact_scene(std::span<const ReconstructedObject> objects,
                           std::span<const KnownObject> structures, const SupportOptions& options) {
  ContactScene scene{support_bodies(objects, structures), {}};
  scene.patches = find_contacts(scene.bodies, options);
  return scene;
}

}  // namespace vantage::reconstruction::detail
