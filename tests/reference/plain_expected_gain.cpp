#include "reference/plain_expected_gain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "reference/for_each_voxel.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/volume/advanced/classify.hpp"

namespace vantage::test {
namespace {

constexpr double kFarAway = std::numeric_limits<double>::infinity();
constexpr int kFloorCells = 48;
constexpr double kFloorCellM = 0.25;

/// Where a line is in a box: nothing if nowhere in front.
std::optional<std::pair<double, double>> inside(const Eigen::Vector3d& from,
                                                const Eigen::Vector3d& direction, const Box& box) {
  double in = 0, out = kFarAway;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (box.min()[axis] - from[axis]) / direction[axis];
    const double b = (box.max()[axis] - from[axis]) / direction[axis];
    in = std::max(in, std::min(a, b)), out = std::min(out, std::max(a, b));
  }
  if (!(out > in)) return std::nullopt;
  return std::pair(in, out);
}

}  // namespace

PlainExpectedGain::PlainExpectedGain(const PlanningScene& scene, const WorldModel& world,
                                     const VolumeOptions& volume,
                                     const ExpectedGainOptions& options)
    : scene_(scene),
      volume_(volume),
      options_(options),
      voxel_m_(scene.grid().geometry().voxel_size_m()),
      known_(known_scene(world)),
      measured_(occluder_scene({}, scene.grid(), OccluderMode::mesh)),
      floor_(std::size_t(kFloorCells * kFloorCells)) {
  for (const DepthCamera& given : world.cameras) {
    if (given.depth == nullptr) continue;
    Image image{given.camera, given.depth.get(), {}, {}};
    const Intrinsics& k = given.camera.intrinsics();
    const DepthImage known = known_->render_depth(given.camera);
    for (const float z : known.metres()) image.known.push_back(std::isnan(z) ? kFarAway : z);
    for (int v = 0; v < k.height; ++v) {
      for (int u = 0; u < k.width; ++u) {
        image.width.push_back(std::min(run_width(image, u, v, 1, 0), run_width(image, u, v, 0, 1)));
      }
    }
    images_.push_back(std::move(image));
  }
  learn();
  std::vector<Eigen::Vector3f> points;
  std::vector<Triangle> triangles;
  for (const Image& image : images_) {
    const Intrinsics& k = image.camera.intrinsics();
    for (int v = 0; v + 2 < k.height; v += 2) {
      for (int u = 0; u + 2 < k.width; u += 2) {
        const std::array<std::array<int, 2>, 4> at{
            {{u, v}, {u, v + 2}, {u + 2, v}, {u + 2, v + 2}}};
        for (const auto& corners : {std::array{0, 1, 2}, std::array{2, 1, 3}}) {
          std::vector<double> z;
          for (const int c : corners)
            z.push_back(image.depth->at(at[std::size_t(c)][0], at[std::size_t(c)][1]));
          const auto [near, far] = std::minmax_element(z.begin(), z.end());
          if (std::isnan(z[0] + z[1] + z[2]) || *far > double(1.2f) * *near) continue;
          const auto first = std::uint32_t(points.size());
          for (int i = 0; i < 3; ++i) {
            const auto& pixel = at[std::size_t(corners[std::size_t(i)])];
            points.push_back(
                image.camera.unproject(pixel[0], pixel[1], z[std::size_t(i)]).cast<float>());
          }
          triangles.push_back({first, first + 1, first + 2});
        }
      }
    }
  }
  SceneBuilder builder;
  add_occluders(world, scene.grid(), OccluderMode::mesh, builder);
  background_ = builder.add_mesh(TriangleMesh(std::move(points), std::move(triangles)));
  surfaces_ = builder.build();
  const GridGeometry& grid = scene.grid().geometry();
  solid_.resize(grid.voxel_count());
  std::size_t index = 0;
  for_each_voxel(grid, [&](const Eigen::Vector3i& voxel) {
    if (scene.grid().at(voxel) == VoxelState::shadow) solid_[index] = solid(grid.centre(voxel));
    ++index;
  });
}

bool PlainExpectedGain::unknown(const Image& image, int u, int v) const {
  const double z = image.depth->at(u, v);
  return image.known[image.pixel(u, v)] > z + 3 * volume_.noise.sigma_m(z) + voxel_m_;
}

double PlainExpectedGain::run_width(const Image& image, int u, int v, int du, int dv) const {
  if (!unknown(image, u, v)) return kFarAway;
  const Intrinsics& k = image.camera.intrinsics();
  double sum = image.depth->at(u, v);
  int count = 1;
  for (const int way : {-1, 1}) {
    for (int a = u + way * du, b = v + way * dv;
         a >= 0 && b >= 0 && a < k.width && b < k.height && unknown(image, a, b);
         a += way * du, b += way * dv) {
      const float here = image.depth->at(a, b),
                  before = image.depth->at(a - way * du, b - way * dv);
      if (std::abs(here - before) > 0.04f * std::min(here, before)) break;
      sum += double(here), ++count;
    }
  }
  return sum / (du == 1 ? k.fx : k.fy);
}

double PlainExpectedGain::solid(const Eigen::Vector3d& point) const {
  if (options_.unknown_depth == 0) return 0;
  double free = 1;
  for (const Image& image : images_) {
    const auto at = image.camera.project(point);
    const Intrinsics& k = image.camera.intrinsics();
    if (!at || at->u < -0.5 || at->v < -0.5 || at->u >= k.width - 0.5 || at->v >= k.height - 0.5) {
      continue;
    }
    const int u = int(at->u + 0.5), v = int(at->v + 0.5);
    const double z = image.depth->at(u, v);
    if (!(z < at->depth) || z > image.camera.range().far_m || !unknown(image, u, v)) continue;
    const double width = std::min(image.width[image.pixel(u, v)], 0.3);
    free *= 1 - std::exp(-std::pow((at->depth - z) / (options_.unknown_depth * width), 2));
  }
  return 1 - free;
}

void PlainExpectedGain::learn() {
  const Box area = scene_.grid().geometry().box();
  const Eigen::Vector2d corner =
      area.centre().head<2>() - Eigen::Vector2d::Constant(0.5 * kFloorCells * kFloorCellM);
  double length = 0, stops = 0;
  for (const Image& image : images_) {
    const Intrinsics& k = image.camera.intrinsics();
    const DepthRange& range = image.camera.range();
    for (int v = 0; v < k.height; v += 2) {
      for (int u = 0; u < k.width; u += 2) {
        const PixelRay ray = image.camera.pixel_ray(u, v);
        const double z = image.depth->at(u, v), known = image.known[image.pixel(u, v)];
        const auto crossing = inside(ray.origin, ray.direction, area);
        if (!std::isnan(z) && crossing) {
          const double end = std::min({z, known, crossing->second});
          if (end > crossing->first) {
            length += (end - crossing->first) * ray.direction.norm();
            const double height = (ray.origin + z * ray.direction).z() - area.min().z();
            stops += z < crossing->second && unknown(image, u, v) &&
                     height > 3 * volume_.noise.sigma_m(z) + voxel_m_;
          }
        }
        if (std::isfinite(known)) continue;
        const double floor = -ray.origin.z() / ray.direction.z();
        if (!(ray.direction.z() < 0 && floor >= range.near_m && floor <= range.far_m)) {
          ++beyond_.pixels, beyond_.readings += z <= range.far_m;
          continue;
        }
        const double tolerance = 3 * volume_.noise.sigma_m(floor) + 0.02;
        if (z < floor - tolerance || -ray.direction.normalized().z() < 0.2) continue;
        const bool reading = z < floor + tolerance;
        ++all_floor_.pixels, all_floor_.readings += reading;
        const Eigen::Vector2d cell =
            ((ray.origin + floor * ray.direction).head<2>() - corner) / kFloorCellM;
        if (cell.minCoeff() < 0 || cell.maxCoeff() >= kFloorCells) continue;
        Floor& there = floor_[std::size_t(cell.x()) * kFloorCells + std::size_t(cell.y())];
        ++there.pixels, there.readings += reading;
      }
    }
  }
  if (stops > 0 && options_.unknown_depth > 0) hazard_per_m_ = stops / length;
}

double PlainExpectedGain::floor_rate(const Eigen::Vector2d& at) const {
  const Box area = scene_.grid().geometry().box();
  const Eigen::Vector2d cell =
      (at - area.centre().head<2>()) / kFloorCellM + Eigen::Vector2d::Constant(0.5 * kFloorCells);
  const Floor* floor = &all_floor_;
  if (cell.minCoeff() >= 0 && cell.maxCoeff() < kFloorCells) {
    const Floor& there = floor_[std::size_t(cell.x()) * kFloorCells + std::size_t(cell.y())];
    if (there.pixels >= 4) floor = &there;
  }
  return floor->pixels > 0 ? floor->readings / floor->pixels : 0.5;
}

double PlainExpectedGain::half_band_m(double depth_m) const {
  return std::max(0.5 * voxel_m_, 0.5 * volume_.band_sigmas * volume_.noise.sigma_m(depth_m));
}

bool PlainExpectedGain::in_sight(const PinholeCamera& view, const Eigen::Vector3f& point) const {
  if (!view.in_view(point)) return false;
  const Eigen::Vector3d from = point.cast<double>(), way = view.centre() - from;
  const double distance = way.norm();
  const auto hidden = [&](const Scene& obstacles, double band_m) {
    const Eigen::Vector3d start = from + std::min(0.5, band_m / distance) * way;
    return obstacles.occluded(start.cast<float>(), view.centre().cast<float>());
  };
  const double noise = 0.5 * volume_.band_sigmas * volume_.noise.sigma_m(distance);
  return !hidden(*known_, std::max(0.5 * voxel_m_, noise)) &&
         !hidden(*measured_, std::max(2 * voxel_m_, 2 * noise));
}

double PlainExpectedGain::reading(const PinholeCamera& view, double u,
                                  const Eigen::Vector3d& direction, const Hit* hit) const {
  const StereoSensor& sensor = options_.sensor;
  const Intrinsics& k = view.intrinsics();
  const Eigen::Vector3d centre = view.centre();
  const auto steep = [&](const Eigen::Vector3d& normal) {
    return std::abs(normal.dot(direction.normalized())) >=
           std::cos(sensor.max_incidence_rad) - 1e-9;
  };
  const double z = hit != nullptr ? double(hit->t) : -centre.z() / direction.z();
  if (hit == nullptr && !(direction.z() < 0 && z <= view.range().far_m)) {
    return beyond_.pixels > 0 ? beyond_.readings / beyond_.pixels : 0;
  }
  const double border = sensor.border_px;
  if (u < border || u > k.width - 1 - border) return 0;
  if (sensor.second_imager && u - k.fx * sensor.noise.baseline_m / z < border) return 0;
  if (sensor.noise.focal_px * sensor.noise.baseline_m / z > sensor.max_disparity_px) return 0;
  const Eigen::Vector3d at = centre + z * direction;
  if (hit == nullptr) return steep(Eigen::Vector3d::UnitZ()) ? floor_rate(at.head<2>()) : 0;
  if (z < view.range().near_m || z > view.range().far_m) return 0;
  if (hit->object == background_) {
    return std::abs(at.z()) > 0.05 || steep(Eigen::Vector3d::UnitZ()) ? 1 : 0;
  }
  const Eigen::Vector3d normal = hit->normal.cast<double>();
  if (!steep(normal)) return 0;
  const double off = hit->object + 1 == background_ ? voxel_m_ : 1e-4 * std::max(z, 0.1);
  const Eigen::Vector3d start = at + (normal.dot(direction) > 0 ? -off : off) * normal;
  const Eigen::Vector3d x = view.T_world_cam().rotation().col(0);
  for (const double along : {sensor.noise.baseline_m, sensor.projector_m}) {
    if (surfaces_->occluded(start.cast<float>(), (centre + along * x).cast<float>())) return 0;
  }
  return 1;
}

double PlainExpectedGain::reached(const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
                                  double in, double step, int steps) const {
  const GridGeometry& grid = scene_.grid().geometry();
  double unseen_m = 0, most_solid = 0;
  for (int i = 0; i < steps; ++i) {
    const Eigen::Vector3d at =
        (from + (in + (i + 0.5) * step) * direction - grid.origin()) / voxel_m_;
    Eigen::Vector3i voxel;
    for (int axis = 0; axis < 3; ++axis) {
      voxel[axis] = std::clamp(int(at[axis]), 0, grid.size()[axis] - 1);
    }
    if (scene_.grid().at(voxel) != VoxelState::shadow) continue;
    unseen_m += step * direction.norm();
    const auto index =
        std::size_t((voxel.x() * grid.size().y() + voxel.y()) * grid.size().z() + voxel.z());
    most_solid = std::max(most_solid, solid_[index]);
  }
  return std::exp(-hazard_per_m_ * unseen_m) * (1 - most_solid);
}

std::size_t PlainExpectedGain::voxels_in_sight(const PinholeCamera& view) const {
  std::size_t count = 0;
  const PointsView shadow = scene_.shadow_centres();
  for (std::size_t i = 0; i < shadow.size; ++i) count += in_sight(view, shadow[i]);
  return count;
}

double PlainExpectedGain::voxels(const PinholeCamera& view) const {
  constexpr int kSteps = 32;
  const Box area = scene_.grid().geometry().box();
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(3 * voxel_m_);
  const Box around(area.min() - margin, area.max() + margin);
  const PointsView shadow = scene_.shadow_centres();
  double sum = 0;
  for (std::size_t i = 0; i < shadow.size; ++i) {
    if (!in_sight(view, shadow[i])) continue;
    const ImagePoint at = view.project(shadow[i].cast<double>()).value();
    const Eigen::Vector3d direction = view.pixel_ray(at.u, at.v).direction;
    const auto hit = surfaces_->closest_hit({view.centre().cast<float>(), direction.cast<float>()});
    double surface_m = hit ? double(hit->t) : kFarAway;
    if (hit && hit->object == background_) {
      const bool inside_area = around.contains(view.centre() + surface_m * direction);
      if (!inside_area && at.depth > 1.02 * surface_m) continue;
      if (inside_area) surface_m = kFarAway;
    }
    const double p = reading(view, at.u, direction, hit ? &*hit : nullptr);
    const auto crossing = inside(view.centre(), direction, area);
    const double end = crossing ? std::min(crossing->second, surface_m) : 0;
    if (!crossing || !(end > crossing->first)) {
      sum += p;
      continue;
    }
    const double step = (end - crossing->first) / kSteps;
    const double voxel = (at.depth - half_band_m(at.depth) - crossing->first) / step;
    const int slice = std::clamp(int(voxel), 0, kSteps - 1);
    const double here = reached(view.centre(), direction, crossing->first, step, slice + 1);
    const double last = reached(view.centre(), direction, crossing->first, step, kSteps);
    sum += last * p + (here - last) * 0.85;
  }
  return sum;
}

}  // namespace vantage::test
