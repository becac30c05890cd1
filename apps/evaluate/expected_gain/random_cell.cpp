#include "evaluate/expected_gain/random_cell.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "simulator/depth/depth_sensor.hpp"
#include "simulator/placement/placement.hpp"
#include "simulator/scene/sample_hash.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/raycore/solids.hpp"

namespace vantage {
namespace {

/// Random numbers of one cell, in the order in which they are asked for.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : seed_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * to_unit(sample_hash(seed_, next_++));
  }
  int one_of(int count) { return int(between(0, count)); }
  bool chance(double p) { return between(0, 1) < p; }

 private:
  std::uint64_t seed_, next_ = 0;
};

/// A cell in the making.
class CellBuilder {
 public:
  explicit CellBuilder(std::uint64_t seed)
      : seed_(seed), dice_(scatter(seed)), area_(random_area()) {
    add_support();
    add_room();
    add_bin();
    add_objects();
  }

  PlanningCell build() {
    SimulatedScene scene(std::move(bodies_));
    const StereoNoise noise{.subpixel_px = dice_.between(0.04, 0.14)};
    add_cameras(scene, noise);
    PlanRequest request{.work_area = area_, .intrinsics = intrinsics()};
    request.voxel_size_m = dice_.between(0.006, 0.014);
    request.candidates = production_views();
    request.volume.noise = noise;
    request.gain.sensor.noise = noise;
    return {fmt::format("random {}: {}, {} cameras", seed_, contents_, world_.cameras.size()),
            "noisy",
            world_,
            world_,
            request,
            std::move(scene),
            {}};
  }

 private:
  using MeshPtr = std::shared_ptr<const TriangleMesh>;

  Box random_area() {
    const Eigen::Vector3d half(dice_.between(0.2, 0.4), dice_.between(0.15, 0.3), 0);
    return Box(-half, half + Eigen::Vector3d(0, 0, dice_.between(0.15, 0.35)), "random work area");
  }

  void add(const std::string& name, const MeshPtr& mesh, const Pose& pose, bool known,
           std::vector<KnownObject>& list) {
    bodies_.push_back(
        {name, std::make_shared<const TexturedMesh>(TexturedMesh{.mesh = *mesh}), pose});
    if (known) list.push_back({name, mesh, pose});
  }

  void add_structure(const std::string& name, const TriangleMesh& mesh, const Pose& pose,
                     bool known) {
    add(name, std::make_shared<const TriangleMesh>(mesh), pose, known, world_.static_structures);
  }

  /// A table that is known, a floor that is not, or a table as large as the work area and nothing
  /// around it.
  void add_support() {
    const int kind = dice_.one_of(4);
    Eigen::Vector3d size = area_.size();
    size.head<2>() = kind == 3 ? Eigen::Vector2d(1.02 * size.head<2>())
                               : Eigen::Vector2d::Constant(dice_.between(1.2, 3.0));
    size.z() = 0.03;
    add_structure("table", box_solid(size), Pose::from_translation({0, 0, -0.016}), kind != 2);
    contents_ = kind == 3 ? "small table" : kind == 2 ? "unknown floor" : "table";
  }

  void add_room() {
    const int kind = dice_.one_of(4);
    contents_ += std::array{", no room", ", unknown room", ", room", ", room"}[std::size_t(kind)];
    if (kind == 0) return;
    const double side = dice_.between(2.4, 5);
    add_structure("room", bin_solid({side, side, 2.8}, 0.05), Pose::from_translation({0, 0, 0.6}),
                  kind != 1);
  }

  void add_bin() {
    if (!dice_.chance(0.25)) return;
    contents_ += ", bin";
    Eigen::Vector3d size = 0.85 * area_.size();
    size.z() = std::min(size.z(), dice_.between(0.08, 0.2));
    add_structure("bin", bin_solid(size, 0.006),
                  Pose::from_translation({0, 0, 0.5 * size.z() + 1e-3}), true);
  }

  TriangleMesh random_solid() {
    const auto size = [&] { return dice_.between(0.03, 0.14); };
    switch (dice_.one_of(6)) {
      case 0:
        return cylinder_solid(0.5 * size(), size());
      case 1:
        return sphere_solid(0.4 * size() + 0.01, 32);
      case 2:
        return wedge_solid({size(), size(), size()});
      case 3:
        return cup_solid(0.03 + 0.3 * size(), 0.04 + size(), 0.005);
      default:
        return box_solid({size(), size(), size()});
    }
  }

  /// As many as there is room for, up to a number; a share of them is known.
  void add_objects() {
    const int count = 2 + dice_.one_of(12);
    const double known = std::array{1.0, 0.7, 0.3, 0.0}[std::size_t(dice_.one_of(4))];
    std::vector<MeshPtr> meshes;
    for (int i = 0; i < count; ++i) {
      meshes.push_back(std::make_shared<const TriangleMesh>(random_solid()));
    }
    const std::vector<Pose> poses = place(meshes);
    contents_ += fmt::format(", {} objects, {:.0f} % known", poses.size(), 100 * known);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      add(fmt::format("object {}", i), meshes[i], poses[i], dice_.chance(known), world_.objects);
    }
  }

  std::vector<Pose> place(std::vector<MeshPtr>& meshes) const {
    std::vector<KnownObject> fixed;
    for (const KnownObject& structure : world_.static_structures) {
      if (structure.name == "bin") fixed.push_back(structure);
    }
    Eigen::Vector3d low = area_.min(), high = area_.max();
    low.z() = fixed.empty() ? 0.0 : 0.0075;
    while (!meshes.empty()) {
      try {
        return place_at_rest(
            meshes, fixed, {.area = Box(low, high), .seed = scatter(seed_), .upright_share = 0.5});
      } catch (const Error&) {
        meshes.pop_back();  // no room for so many
      }
    }
    return {};
  }

  Intrinsics intrinsics() {
    const double f = dice_.between(480, 640);
    return {640, 480, f, f, 319.5, 239.5};
  }

  void add_cameras(const SimulatedScene& scene, const StereoNoise& noise) {
    const int count = 1 + dice_.one_of(4);
    const Eigen::Vector3d middle = area_.centre();
    for (int i = 0; i < count; ++i) {
      const double azimuth = dice_.between(0, 2 * std::numbers::pi);
      const double elevation = dice_.between(0.35, 1.4);
      const double distance = area_.size().head<2>().norm() * dice_.between(0.8, 1.5);
      const Eigen::Vector3d way(std::cos(azimuth) * std::cos(elevation),
                                std::sin(azimuth) * std::cos(elevation), std::sin(elevation));
      const std::string name = fmt::format("{}", i);
      const PinholeCamera camera(intrinsics(), Pose::looking_at(middle + distance * way, middle));
      StereoSensor sensor;
      sensor.noise = noise;
      world_.cameras.push_back({name, camera,
                                std::make_shared<const DepthImage>(simulate_depth(
                                    scene.rays(), camera, sensor, sample_hash(seed_, i)))});
    }
  }

  std::uint64_t seed_;
  Dice dice_;
  Box area_;
  std::string contents_;  ///< in words
  std::vector<SimulatedBody> bodies_;
  WorldModel world_;
};

}  // namespace

PlanningCell random_planning_cell(std::uint64_t seed) {
  return CellBuilder(seed).build();
}

}  // namespace vantage
