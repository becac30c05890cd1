#include "plan/report/plan_shapes.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "vantage/volume/advanced/voxel_surface.hpp"

namespace vantage {

TriangleMesh joined(const std::vector<TriangleMesh>& meshes) {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Triangle> triangles;
  for (const TriangleMesh& mesh : meshes) {
    const std::uint32_t first = std::uint32_t(vertices.size());
    vertices.insert(vertices.end(), mesh.vertices().begin(), mesh.vertices().end());
    for (const Triangle& t : mesh.triangles()) {
      triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
  }
  return {std::move(vertices), std::move(triangles), "joined meshes"};
}

TriangleMesh rod(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius_m) {
  constexpr std::uint32_t kSides = 10;
  const Eigen::Vector3d axis = (b - a).normalized();
  const Eigen::Vector3d side = axis.unitOrthogonal(), up = axis.cross(side);
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    const Eigen::Vector3d offset = radius_m * (std::cos(angle) * side + std::sin(angle) * up);
    vertices.push_back((a + offset).cast<float>());
    vertices.push_back((b + offset).cast<float>());
    const std::uint32_t here = 2 * i, next = 2 * ((i + 1) % kSides);
    triangles.push_back({here, next, here + 1});
    triangles.push_back({next, next + 1, here + 1});
  }
  return {std::move(vertices), std::move(triangles), "rod"};
}

TriangleMesh box_edges(const Box& box, double radius_m) {
  std::vector<TriangleMesh> rods;
  for (int axis = 0; axis < 3; ++axis) {
    for (int corner = 0; corner < 4; ++corner) {
      Eigen::Vector3d a = box.min();
      if (corner & 1) a[(axis + 1) % 3] = box.max()[(axis + 1) % 3];
      if (corner & 2) a[(axis + 2) % 3] = box.max()[(axis + 2) % 3];
      Eigen::Vector3d b = a;
      b[axis] = box.max()[axis];
      rods.push_back(rod(a, b, radius_m));
    }
  }
  return joined(rods);
}

std::vector<Eigen::Vector3d> frustum_corners(const PinholeCamera& camera, double depth_m) {
  const double right = camera.intrinsics().width - 0.5, bottom = camera.intrinsics().height - 0.5;
  return {camera.unproject(-0.5, -0.5, depth_m), camera.unproject(right, -0.5, depth_m),
          camera.unproject(right, bottom, depth_m), camera.unproject(-0.5, bottom, depth_m)};
}

TriangleMesh camera_shape(const PinholeCamera& camera, double body_width_m, double frustum_m,
                          double rod_radius_m) {
  const Eigen::Vector3d half = body_width_m * Eigen::Vector3d(0.5, 0.17, 0.17);
  const Box body(Eigen::Vector3d(-half.x(), -half.y(), -2 * half.z()),
                 Eigen::Vector3d(half.x(), half.y(), 0));
  std::vector<TriangleMesh> parts;
  parts.push_back(TriangleMesh::from_box(body).transformed(camera.T_world_cam()));
  const std::vector<Eigen::Vector3d> corners = frustum_corners(camera, frustum_m);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    parts.push_back(rod(camera.centre(), corners[i], rod_radius_m));
    parts.push_back(rod(corners[i], corners[(i + 1) % corners.size()], rod_radius_m));
  }
  return joined(parts);
}

namespace {

const Eigen::Vector3f kOccupied(0.42f, 0.70f, 0.36f);
const Eigen::Vector3f kShadow(0.86f, 0.24f, 0.20f);
const Eigen::Vector3f kRevealed(0.16f, 0.76f, 0.82f);
const Eigen::Vector3f kGivenCamera(0.50f, 0.52f, 0.55f);
const Eigen::Vector3f kSuggestedCamera(0.90f, 0.08f, 0.06f);
const Eigen::Vector3f kWorkArea(0.35f, 0.37f, 0.40f);
const Eigen::Vector3f kStructure(0.55f, 0.58f, 0.66f);

/// Structures stand in front of the subject, too.
constexpr float kStructureOpacity = 0.3f;

/// How much of the light the revealed voxels keep back: one sees what stands inside them.
constexpr double kRevealedOpacity = 0.4;

constexpr double kBodyWidth = 0.22;  // of a camera; the work area's scale is 1

TriangleMesh shape_of(const PinholeCamera& camera, const Plan& plan, double size = 1) {
  const double scale = size * scale_of(plan);
  const double distance = (camera.centre() - plan.request.work_area.centre()).norm();
  return camera_shape(camera, kBodyWidth * scale, 0.35 * size * distance, 0.006 * scale);
}

/// Whether a box holds everything that the overview is about.
bool surrounds(const Eigen::AlignedBox3d& box, const Plan& plan, const WorldModel& world) {
  const auto inside = [&](const DepthCamera& given) { return box.contains(given.camera.centre()); };
  const auto holds = [&](const PinholeCamera& camera) { return box.contains(camera.centre()); };
  return box.contains(plan.request.work_area.min()) && box.contains(plan.request.work_area.max()) &&
         std::ranges::all_of(world.cameras, inside) &&
         std::ranges::all_of(suggested_cameras(plan), holds);
}

/// Many cameras are drawn small: else their frusta are all that one sees.
double size_among(std::size_t cameras) {
  return std::min(1.0, 2 / std::sqrt(double(std::max<std::size_t>(1, cameras))));
}

}  // namespace

double scale_of(const Plan& plan) {
  return 0.5 * plan.request.work_area.size().norm();
}

double floor_height(const Plan& plan) {
  return std::min(0.0, plan.request.work_area.min().z()) - 1e-3 * scale_of(plan);
}

std::vector<PinholeCamera> suggested_cameras(const Plan& plan) {
  std::vector<PinholeCamera> cameras;
  for (const NextView& next : plan.views) {
    cameras.emplace_back(plan.request.intrinsics, next.view.T_world_cam, plan.request.range);
  }
  return cameras;
}

std::vector<ColoredMesh> voxel_meshes(const StateGrid& grid) {
  return {
      {"occupied", voxel_faces(grid, VoxelState::occupied), kOccupied},
      {"shadow", voxel_faces(grid, VoxelState::shadow), kShadow},
      {"revealed", voxel_faces(grid, VoxelState::revealed), kRevealed, float(kRevealedOpacity)}};
}

std::vector<ColoredMesh> camera_meshes(const Plan& plan, const WorldModel& world) {
  std::vector<ColoredMesh> meshes{
      {"work area", box_edges(plan.request.work_area, 0.004 * scale_of(plan)), kWorkArea}};
  for (const DepthCamera& observer : world.cameras) {
    meshes.push_back({"camera " + observer.name,
                      shape_of(observer.camera, plan, size_among(world.cameras.size())),
                      kGivenCamera});
  }
  const std::vector<PinholeCamera> suggested = suggested_cameras(plan);
  for (std::size_t i = 0; i < suggested.size(); ++i) {
    meshes.push_back({i == 0 ? "suggested camera" : fmt::format("suggested camera {}", i + 1),
                      shape_of(suggested[i], plan, size_among(suggested.size())),
                      kSuggestedCamera});
  }
  return meshes;
}

std::vector<Eigen::Vector3d> suggested_bodies(const Plan& plan) {
  std::vector<Eigen::Vector3d> bodies;
  const std::vector<PinholeCamera> cameras = suggested_cameras(plan);
  for (const PinholeCamera& camera : cameras) {
    const double width = kBodyWidth * size_among(cameras.size()) * scale_of(plan);
    bodies.push_back(camera.T_world_cam() * Eigen::Vector3d(0, 0, -0.17 * width));
  }
  return bodies;
}

std::vector<ColoredMesh> structure_meshes(const Plan& plan, const WorldModel& world) {
  std::vector<ColoredMesh> meshes;
  const double floor = floor_height(plan);
  // Voxels show what is within, and a little more is not worth it.
  const Eigen::Vector3d little = Eigen::Vector3d::Constant(0.05 * scale_of(plan));
  const Eigen::AlignedBox3d area(plan.request.work_area.min() - little,
                                 plan.request.work_area.max() + little);
  const auto add = [&](const KnownObject& object) {
    TriangleMesh mesh = object.mesh->transformed(object.T_world_object);
    Eigen::AlignedBox3d all, visible;
    for (const Eigen::Vector3f& p : mesh.vertices()) {
      all.extend(p.cast<double>());
      visible.extend(Eigen::Vector3d(p.x(), p.y(), std::max(double(p.z()), floor)));
    }
    if (mesh.empty() || all.max().z() <= floor) return;
    if (area.contains(visible) || surrounds(all, plan, world)) return;
    meshes.push_back({object.name, std::move(mesh), kStructure, kStructureOpacity});
  };
  for (const KnownObject& structure : world.static_structures) add(structure);
  for (const KnownObject& object : world.objects) add(object);
  return meshes;
}

PlanColors plan_colors() {
  return {kOccupied, kShadow, kRevealed, kGivenCamera, kSuggestedCamera, kStructure};
}

}  // namespace vantage
