#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "simulator/placement/collision.hpp"
#include "simulator/placement/placement.hpp"
#include "simulator/scene/sample_hash.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

constexpr std::uint64_t kTries = 2000;
constexpr double kMinGap = 1e-6;
const double kUprightCosine = std::cos(std::numbers::pi / 180);

using MeshPointer = std::shared_ptr<const TriangleMesh>;
using ShapePointer = std::shared_ptr<const CollisionShape>;

// What the tries of all bodies of one mesh share.
struct Kind {
  ShapePointer shape;
  std::vector<RestingPose> poses;
  std::optional<RestingPose> upright;
};

struct Placed {
  ShapePointer shape;
  Pose T_world_body;
};

// Random numbers of one try, told apart by what they are for.
struct Dice {
  std::uint64_t seed, body, attempt;
  double turn() const {
    return 2 * std::numbers::pi * to_unit(sample_hash(seed, body, attempt, 0));
  }
  double x() const { return to_unit(sample_hash(seed, body, attempt, 1)); }
  double y() const { return to_unit(sample_hash(seed, body, attempt, 2)); }
  double pose() const { return to_unit(sample_hash(seed, body, attempt, 3)); }
  double upright() const { return to_unit(sample_hash(seed, body, 0, 4)); }  // whatever the try
};

void check(const PlacementOptions& options) {
  if (!(options.gap_m >= kMinGap && std::isfinite(options.gap_m))) {
    throw bad_input(
        "gap_m", fmt::format("found {} m; expected {} m or more, the finest gap that rays resolve",
                             options.gap_m, kMinGap));
  }
  if (!(options.upright_share >= 0 && options.upright_share <= 1)) {
    throw bad_input("upright_share",
                    fmt::format("found {}; expected 0 to 1", options.upright_share));
  }
}

Kind make_kind(const TriangleMesh& mesh) {
  Kind kind{std::make_shared<CollisionShape>(mesh), resting_poses(mesh), {}};
  for (const RestingPose& pose : kind.poses) {
    if (!kind.upright && pose.rotation(2, 2) >= kUprightCosine) kind.upright = pose;
  }
  return kind;
}

// One for each mesh; bodies that share a pointer share it.
std::map<const TriangleMesh*, Kind> kinds_of(std::span<const MeshPointer> bodies) {
  std::map<const TriangleMesh*, Kind> kinds;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const std::string where = fmt::format("body {}", i);
    if (bodies[i] == nullptr) throw bad_input(where, "it has no mesh");
    if (kinds.contains(bodies[i].get())) continue;
    try {
      kinds.emplace(bodies[i].get(), make_kind(*bodies[i]));
    } catch (const Error& error) {
      throw Error(error.code(), where, error.message());
    }
  }
  return kinds;
}

std::vector<Placed> obstacles(std::span<const KnownObject> fixed) {
  std::map<const TriangleMesh*, ShapePointer> shapes;
  std::vector<Placed> placed;
  for (const KnownObject& object : fixed) {
    ShapePointer& shape = shapes[object.mesh.get()];
    if (!shape) shape = std::make_shared<CollisionShape>(*object.mesh);
    placed.push_back({shape, object.T_world_object});
  }
  return placed;
}

const RestingPose& choose(const Kind& kind, const Dice& dice, double upright_share) {
  if (kind.upright && dice.upright() < upright_share) return *kind.upright;
  double left = dice.pose();
  for (const RestingPose& pose : kind.poses) {
    left -= pose.share;
    if (left < 0) return pose;
  }
  return kind.poses.back();  // shares sum to 1 only to rounding
}

// Somewhere in the area; nothing if the body, turned so, does not fit in.
std::optional<Pose> throw_dice(const Kind& kind, const Dice& dice,
                               const PlacementOptions& options) {
  const RestingPose& pose = choose(kind, dice, options.upright_share);
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(dice.turn(), Eigen::Vector3d::UnitZ()).toRotationMatrix() * pose.rotation;
  Eigen::AlignedBox3d reach;
  for (const Eigen::Vector3d& point : kind.shape->points()) reach.extend(rotation * point);
  const Eigen::Vector3d room = options.area.size() - reach.sizes();
  if (room.x() < 0 || room.y() < 0) return std::nullopt;
  const Eigen::Vector3d corner = options.area.min() - reach.min();
  return Pose::from_rotation(rotation,
                             {corner.x() + dice.x() * room.x(), corner.y() + dice.y() * room.y(),
                              options.area.min().z() + pose.height_m});
}

bool is_free(const ShapePointer& shape, const Pose& T_world_body, const std::vector<Placed>& placed,
             double gap_m) {
  for (const Placed& other : placed) {
    if (closer_than(gap_m, *shape, T_world_body, *other.shape, other.T_world_body)) return false;
  }
  return true;
}

std::optional<Pose> place(const Kind& kind, std::size_t body, const std::vector<Placed>& placed,
                          const PlacementOptions& options) {
  for (std::uint64_t attempt = 0; attempt < kTries; ++attempt) {
    const auto pose = throw_dice(kind, {options.seed, body, attempt}, options);
    if (pose && is_free(kind.shape, *pose, placed, options.gap_m)) return pose;
  }
  return std::nullopt;
}

}  // namespace

std::vector<Pose> place_at_rest(std::span<const MeshPointer> bodies,
                                std::span<const KnownObject> fixed,
                                const PlacementOptions& options) {
  check(options);
  const std::map<const TriangleMesh*, Kind> kinds = kinds_of(bodies);
  std::vector<Placed> placed = obstacles(fixed);
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Kind& kind = kinds.at(bodies[i].get());
    const std::optional<Pose> pose = place(kind, i, placed, options);
    if (!pose) {
      throw bad_input(
          "area",
          fmt::format("{} of {} bodies were placed; {} tries found no free spot of {} x {} m for "
                      "the next one. Enlarge the area, or place fewer or smaller bodies",
                      i, bodies.size(), kTries, options.area.size().x(), options.area.size().y()));
    }
    placed.push_back({kind.shape, *pose});
    poses.push_back(*pose);
  }
  return poses;
}

}  // namespace vantage
