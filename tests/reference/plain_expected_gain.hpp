#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "vantage/planner/advanced/planning_scene.hpp"
#include "vantage/planner/expected_gain.hpp"
#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/world_model.hpp"

namespace vantage::test {

/// What `ExpectedScorer` documents, by one ray after the other, in double, without pruning: for
/// grids of at most 128 voxels along each edge, given images of at most 160 pixels across, and
/// views with at most 384 voxels in sight.
class PlainExpectedGain {
 public:
  PlainExpectedGain(const PlanningScene& scene, const WorldModel& world,
                    const VolumeOptions& volume, const ExpectedGainOptions& options);

  /// Voxels that the view is expected to turn from shadow to free or occupied.
  double voxels(const PinholeCamera& view) const;

  /// How many of them it has in sight, surfaces being as thick as they are measured.
  std::size_t voxels_in_sight(const PinholeCamera& view) const;

 private:
  struct Image {
    PinholeCamera camera;
    const DepthImage* depth;
    std::vector<double> known, width;  ///< by pixel

    std::size_t pixel(int u, int v) const {
      return std::size_t(v) * std::size_t(camera.intrinsics().width) + std::size_t(u);
    }
  };
  struct Floor {
    double readings = 0, pixels = 0;
  };

  bool unknown(const Image& image, int u, int v) const;
  double run_width(const Image& image, int u, int v, int du, int dv) const;
  double solid(const Eigen::Vector3d& point) const;
  void learn();
  double floor_rate(const Eigen::Vector2d& at) const;
  bool in_sight(const PinholeCamera& view, const Eigen::Vector3f& point) const;
  double reading(const PinholeCamera& view, double u, const Eigen::Vector3d& direction,
                 const Hit* hit) const;
  double reached(const Eigen::Vector3d& from, const Eigen::Vector3d& direction, double in,
                 double step, int steps) const;
  double half_band_m(double depth_m) const;

  PlanningScene scene_;
  VolumeOptions volume_;
  ExpectedGainOptions options_;
  double voxel_m_;
  std::shared_ptr<const Scene> known_, measured_, surfaces_;
  ObjectId background_;
  std::vector<Image> images_;
  std::vector<double> solid_;  ///< by voxel, z fastest; 0 where there is no shadow
  double hazard_per_m_ = 0;
  std::vector<Floor> floor_;
  Floor all_floor_, beyond_;
};

}  // namespace vantage::test
