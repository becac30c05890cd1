#include "scoring/expected/reading_rays.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace vantage::planner::detail {
namespace {

constexpr int kSteps = 32;  // along a ray through the unseen volume
// Share of the rays stopped by something unknown that have a reading: the rest meet it at too flat
// an angle, or where one of the sensor's other devices does not see it.
constexpr double kUnknownReading = 0.85;
constexpr double kBehind = 1.02;       // of the depth of a background that is measured roughly
constexpr double kLevelFloorM = 0.05;  // the background near the floor is taken for level

/// The first hits of a view's rays, and whether the sensor's devices find them.
class SensorRays {
 public:
  SensorRays(const UnseenModel& model, const PinholeCamera& view, const Points& directions)
      : model_(model), view_(view), directions_(directions) {
    model.surfaces->closest_hits(view.centre().cast<float>(), directions, hits_,
                                 RayOrder::incoherent);
    if (model.ideal) return;
    hide_from(model.sensor.second_imager, model.sensor.noise.baseline_m);
    hide_from(model.sensor.projector, model.sensor.projector_m);
  }

  double depth(std::size_t i) const { return double(hits_.t[i]); }
  bool background(std::size_t i) const { return hits_.object[i] == model_.background; }

  /// The probability of a reading, if nothing unknown is in the way.
  double reading(std::size_t i, double u) const {
    if (model_.ideal) return 1;
    const Eigen::Vector3d direction = directions_[i].cast<double>();
    const DepthRange& range = view_.range();
    if (!hits_.hit(i)) return reading_of_nothing(direction, u);
    const double z = depth(i);
    if (!(z >= range.near_m && z <= range.far_m) || !in_both_images(z, u)) return 0;
    if (!hidden_.empty() && hidden_[i]) return 0;
    return steep(i, direction) ? 1 : 0;
  }

 private:
  double reading_of_nothing(const Eigen::Vector3d& direction, double u) const {
    const Eigen::Vector3d& centre = view_.centre();
    const double z = (model_.floor_z_m.value_or(0) - centre.z()) / direction.z();
    const bool floor = model_.floor_z_m && direction.z() < 0 && z <= view_.range().far_m;
    if (!floor) return model_.rates.beyond.share(0);
    if (!in_both_images(z, u) || !steep(direction, Eigen::Vector3d::UnitZ())) return 0;
    return model_.rates.floor.at((centre + z * direction).head<2>());
  }

  /// Whether the second imager has it in its image, and both find it in their search range.
  bool in_both_images(double z, double u) const {
    const StereoSensor& sensor = model_.sensor;
    const double border = sensor.border_px, last = view_.intrinsics().width - 1 - border;
    const double disparity = view_.intrinsics().fx * sensor.noise.baseline_m / z;
    if (u < border || u > last || (sensor.second_imager && u - disparity < border)) return false;
    return sensor.max_disparity_px == 0 ||
           sensor.noise.focal_px * sensor.noise.baseline_m / z <= sensor.max_disparity_px;
  }

  bool steep(const Eigen::Vector3d& direction, const Eigen::Vector3d& normal) const {
    const double cosine = std::abs(normal.dot(direction.normalized()));
    return cosine >= std::cos(model_.sensor.max_incidence_rad) - 1e-9;
  }

  bool steep(std::size_t i, const Eigen::Vector3d& direction) const {
    if (!background(i)) return steep(direction, hits_.normal[i].cast<double>());
    // Neighbouring depths are too noisy for a normal.
    if (!model_.floor_z_m) return true;
    const double height = view_.centre().z() + depth(i) * direction.z() - *model_.floor_z_m;
    return std::abs(height) > kLevelFloorM || steep(direction, Eigen::Vector3d::UnitZ());
  }

  /// Marks the hits that another of the sensor's devices does not see.
  void hide_from(bool device, double along_x_m) {
    if (!device) return;
    std::vector<std::size_t> found;
    Points from;
    for (std::size_t i = 0; i < hits_.size(); ++i) {
      if (!hits_.hit(i) || background(i)) continue;
      found.push_back(i), from.push_back(in_front_of(i));
    }
    std::vector<std::uint8_t> blocked(found.size());
    const Eigen::Vector3d device_m =
        view_.centre() + along_x_m * view_.T_world_cam().rotation().col(0);
    if (!found.empty()) {
      model_.surfaces->occluded(from, device_m.cast<float>(), blocked);
    }
    hidden_.resize(hits_.size());
    for (std::size_t k = 0; k < found.size(); ++k) hidden_[found[k]] |= blocked[k];
  }

  /// A point off the surface, towards the camera; measured voxels have steps that hide nothing.
  Eigen::Vector3f in_front_of(std::size_t i) const {
    const Eigen::Vector3f direction = directions_[i], normal = hits_.normal[i];
    const float sign = normal.dot(direction) > 0 ? -1.0f : 1.0f;
    const float off = hits_.object[i] == model_.measured ? float(model_.voxel_m)
                                                         : 1e-4f * std::max(hits_.t[i], 0.1f);
    return view_.centre().cast<float>() + hits_.t[i] * direction + sign * off * normal;
  }

  const UnseenModel& model_;
  const PinholeCamera& view_;
  const Points& directions_;
  Hits hits_;
  std::vector<std::uint8_t> hidden_;
};

/// Depths between which a ray is in the cells' box: none of it if the first is above the second.
std::array<double, 2> crossing(const ShadowCells& cells, const Eigen::Vector3d& origin,
                               const Eigen::Vector3d& direction) {
  double in = 0, out = std::numeric_limits<double>::infinity();
  const Eigen::Vector3d last = cells.corner();
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (cells.origin[axis] - origin[axis]) / direction[axis];
    const double b = (last[axis] - origin[axis]) / direction[axis];
    in = std::max(in, std::min(a, b)), out = std::min(out, std::max(a, b));
  }
  return {in, out};
}

/// A ray from the view's centre through a voxel's.
struct VoxelRay {
  Eigen::Vector3d origin, direction;
  double voxel_m, surface_m;  ///< depths of the voxel, and of what hides all behind it
};

/// The probability that a ray comes as far as the voxel, and as far as the surface behind it:
/// nothing unknown is in the way.
std::array<double, 2> reached(const UnseenModel& model, const VoxelRay& ray) {
  const auto [in, out] = crossing(model.cells, ray.origin, ray.direction);
  const double end = std::min(out, ray.surface_m);
  if (model.nothing_unknown || !(end > in)) return {1, 1};
  const double step = (end - in) / kSteps;
  const double fade = model.rates.hazard_per_m * step * ray.direction.norm() / 255;
  // What is this close behind a surface is measured as a part of it.
  const double band = std::max(0.5 * model.voxel_m, model.half_band_1m * ray.voxel_m * ray.voxel_m);
  const int voxel = std::clamp(int((ray.voxel_m - band - in) / step), 0, kSteps - 1);
  std::array<double, 2> probability{1, 1};
  double unseen = 0;
  int solid = 0;
  for (int k = 0; k < kSteps; ++k) {
    const std::size_t cell =
        model.cells.index_of(ray.origin + (in + (k + 0.5) * step) * ray.direction);
    unseen += model.cells.unseen[cell];
    solid = std::max(solid, int(model.cells.solid[cell]));
    if (k == voxel || k == kSteps - 1) {
      probability[1] = std::exp(-fade * unseen) * (1 - solid / 255.0);
      if (k == voxel) probability[0] = probability[1];
    }
  }
  return probability;
}

}  // namespace

std::vector<std::uint8_t> reading_probabilities(const UnseenModel& model, const PinholeCamera& view,
                                                PointsView points) {
  const std::size_t size = points.size;
  std::vector<float> u(size), v(size), depth(size);
  view.project(points, u, v, depth);
  Points directions(size);
  const Eigen::Vector3f centre = view.centre().cast<float>();
  for (std::size_t i = 0; i < size; ++i) directions.set(i, (points[i] - centre) / depth[i]);
  const SensorRays rays(model, view, directions);
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(3 * model.voxel_m);
  const Box around(model.cells.origin - margin, model.cells.corner() + margin);
  std::vector<std::uint8_t> probabilities(size);
  for (std::size_t i = 0; i < size; ++i) {
    VoxelRay ray{view.centre(), directions[i].cast<double>(), double(depth[i]), rays.depth(i)};
    if (rays.background(i)) {
      const bool inside = around.contains(ray.origin + ray.surface_m * ray.direction);
      if (!inside && ray.voxel_m > kBehind * ray.surface_m) continue;  // a wall is in the way
      // In the work area, measured voxels are what hides; noise makes these triangles too rough.
      if (inside) ray.surface_m = std::numeric_limits<double>::infinity();
    }
    const auto [voxel, surface] = reached(model, ray);
    const double reading = rays.reading(i, double(u[i]));
    const double p = surface * reading + (voxel - surface) * kUnknownReading;
    probabilities[i] = std::uint8_t(std::lround(255 * (model.ideal ? voxel : p)));
  }
  return probabilities;
}

}  // namespace vantage::planner::detail
