#include "scoring/expected/unseen_model.hpp"

#include <algorithm>
#include <cmath>

#include "scoring/expected/given_depth.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/volume/advanced/classify.hpp"

namespace vantage::planner::detail {
namespace {

constexpr double kMaxCells = 128;  // along the longest side
constexpr double kUnknownFloor = 0.5;
constexpr std::uint32_t kEnoughPixels = 4;

}  // namespace

ShadowCells::ShadowCells(const GridGeometry& grid) : origin(grid.origin()) {
  voxel_m = grid.voxel_size_m();
  const int voxels = int(std::ceil(double(grid.size().maxCoeff()) / kMaxCells));
  cell_m = voxels * voxel_m;
  size = (grid.size().array() + voxels - 1) / voxels;
  unseen.resize(std::size_t(size.x()) * std::size_t(size.y()) * std::size_t(size.z()));
  solid.resize(unseen.size());
}

std::size_t ShadowCells::index_of(const Eigen::Vector3d& p_world) const {
  const Eigen::Vector3d at = (p_world - origin) / cell_m;
  const auto cell = [&](int axis) {
    return std::size_t(std::clamp(int(at[axis]), 0, size[axis] - 1));
  };
  return (cell(0) * std::size_t(size.y()) + cell(1)) * std::size_t(size.z()) + cell(2);
}

FloorRates::FloorRates(const Eigen::Vector2d& middle)
    : corner_(middle - Eigen::Vector2d::Constant(0.5 * kCells * kCellM)),
      cells_(std::size_t(kCells) * std::size_t(kCells)) {}

std::optional<std::size_t> FloorRates::cell_of(const Eigen::Vector2d& at) const {
  const Eigen::Vector2d cell = (at - corner_) / kCellM;
  if (!(cell.minCoeff() >= 0 && cell.maxCoeff() < kCells)) return std::nullopt;
  return std::size_t(cell.x()) * std::size_t(kCells) + std::size_t(cell.y());
}

void FloorRates::add(const Eigen::Vector2d& at, bool reading) {
  const auto count = [&](ReadingRate& rate) { rate.readings += reading, ++rate.pixels; };
  count(all_);
  if (const auto cell = cell_of(at)) count(cells_[*cell]);
}

double FloorRates::at(const Eigen::Vector2d& place) const {
  const auto cell = cell_of(place);
  const bool enough = cell && cells_[*cell].pixels >= kEnoughPixels;
  return (enough ? cells_[*cell] : all_).share(kUnknownFloor);
}

UnseenModel::UnseenModel(const PlanningScene& scene, const WorldModel& world,
                         const VolumeOptions& volume, const ExpectedGainOptions& options)
    : sensor(options.sensor),
      cells(scene.grid().geometry()),
      rates{0, FloorRates(Eigen::Vector2d::Zero()), {}},
      voxel_m(scene.grid().geometry().voxel_size_m()),
      floor_z_m(options.floor_z_m),
      half_band_1m(0.5 * volume.band_sigmas * volume.noise.sigma_m(1)),
      ideal(options.sensor == StereoSensor::ideal()) {
  const Box area = scene.grid().geometry().box();
  const std::vector<GivenDepth> images = given_depths(world, volume, voxel_m);
  rates = learned_rates(images, area, floor_z_m);
  if (options.unknown_depth == 0) rates.hazard_per_m = 0;
  fill_cells(scene.shadow_centres(), images, options.unknown_depth, cells);
  nothing_unknown = rates.hazard_per_m == 0 &&
                    std::ranges::all_of(cells.solid, [](std::uint8_t p) { return p == 0; });
  SceneBuilder builder;
  add_occluders(world, scene.grid(), volume.occluders, builder);
  background = builder.add_mesh(background_mesh(images));
  if (volume.occluders == OccluderMode::mesh && background > 0) measured = background - 1;
  surfaces = builder.build();
}

}  // namespace vantage::planner::detail
