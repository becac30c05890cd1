#include "simulator/placement/random_stack.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

#include "simulator/placement/mass_properties.hpp"
#include "simulator/placement/placement.hpp"
#include "simulator/scene/sample_hash.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

constexpr std::uint64_t kStackTries = 20000;
constexpr double kSamePlane_m = 1e-5;
constexpr double kFullFace = 0.98;      ///< of its hull: without holes that another may fall into
constexpr double kLeastArea_m2 = 1e-4;  ///< of contact where one is shifted: it still lies there

/// The face of turned vertices at one height, if it fills its convex hull; else nothing.
FlatPolygon full_face(const TriangleMesh& mesh, const Eigen::Matrix3d& rotation, double height) {
  std::vector<Eigen::Vector2d> points;
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    Eigen::Matrix3d corners;
    for (int i = 0; i < 3; ++i) corners.col(i) = rotation * mesh.corner(t, i).cast<double>();
    if ((corners.row(2).array() - height).abs().maxCoeff() > kSamePlane_m) continue;
    for (int i = 0; i < 3; ++i) points.push_back(corners.col(i).head<2>());
    area += 0.5 * (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)).norm();
  }
  FlatPolygon hull = hull_of(points);
  if (hull.size() < 3 || area < kFullFace * area_of(hull)) return {};
  return hull;
}

FlatPolygon moved(const FlatPolygon& polygon, double turn, const Eigen::Vector2d& by) {
  FlatPolygon result;
  const Eigen::Rotation2Dd rotation(turn);
  for (const Eigen::Vector2d& corner : polygon) result.push_back(rotation * corner + by);
  return result;
}

/// Random numbers of one try.
struct StackDice {
  std::uint64_t seed, attempt;
  double draw(std::uint64_t level, std::uint64_t what) const {
    return to_unit(sample_hash(seed, attempt, level, what));
  }
};

}  // namespace

/// A part where it lies.
struct StackMaker::Level {
  const Part* part = nullptr;
  double turn = 0, bottom_z_m = 0;
  Eigen::Vector2d at = Eigen::Vector2d::Zero();

  double top_z_m() const { return bottom_z_m + part->below_m + part->above_m; }
  FlatPolygon bottom() const { return moved(part->bottom, turn, at); }
  FlatPolygon top() const { return moved(part->top, turn, at); }
  Eigen::Vector2d centre() const { return Eigen::Rotation2Dd(turn) * part->centre + at; }
  StackedBody body() const {
    const Eigen::Matrix3d rotation =
        Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()).toRotationMatrix() * part->rotation;
    return {part->mesh,
            Pose::from_rotation(rotation, {at.x(), at.y(), bottom_z_m + part->below_m})};
  }

  /// Of these and all above them.
  static Eigen::Vector2d common_centre(std::span<const Level> levels) {
    Eigen::Vector2d moment = Eigen::Vector2d::Zero();
    double volume = 0;
    for (const Level& level : levels) {
      moment += level.part->volume_m3 * level.centre();
      volume += level.part->volume_m3;
    }
    return moment / volume;
  }
  /// How far inside the contact of level `i` with the one below the centre of mass above lies.
  static double margin_m(std::span<const Level> levels, std::size_t i) {
    return depth_inside(common_part(levels[i].bottom(), levels[i - 1].top()),
                        common_centre(levels.subspan(i)));
  }
};

StackMaker::StackMaker(std::span<const std::shared_ptr<const TriangleMesh>> meshes) {
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const MassProperties mass = mass_properties(*meshes[m]);
    for (const RestingPose& pose : resting_poses(*meshes[m])) {
      double highest = 0;
      for (const Eigen::Vector3d& point : surface_points(*meshes[m])) {
        highest = std::max(highest, (pose.rotation * point).z() + pose.height_m);
      }
      Part part;
      part.mesh = m;
      part.rotation = pose.rotation;
      part.below_m = pose.height_m;
      part.above_m = highest - pose.height_m;
      part.volume_m3 = mass.volume_m3;
      part.centre = (pose.rotation * mass.centre).head<2>();
      part.bottom = full_face(*meshes[m], pose.rotation, -pose.height_m);
      part.top = full_face(*meshes[m], pose.rotation, part.above_m);
      if (!part.bottom.empty() && !part.top.empty()) parts_.push_back(std::move(part));
    }
  }
  if (parts_.empty()) {
    throw bad_input("types",
                    "none of them has flat faces at top and bottom when it is at rest; "
                    "expected one that others can stand on, such as a box");
  }
}

std::optional<std::vector<StackMaker::Level>> StackMaker::try_levels(
    std::size_t count, std::uint64_t seed, const Eigen::Vector2d& place,
    const RandomStackOptions& options) const {
  for (std::uint64_t attempt = 0; attempt < kStackTries; ++attempt) {
    const StackDice dice{seed, attempt};
    std::vector<Level> levels;
    for (std::size_t i = 0; i < count; ++i) {
      Level level{&parts_[std::size_t(dice.draw(i, 0) * double(parts_.size()))]};
      level.turn = 2 * std::numbers::pi * dice.draw(i, 1);
      level.bottom_z_m = levels.empty() ? options.floor_z_m : levels.back().top_z_m();
      level.at = place;
      const double reach = 0.05;
      if (i > 0) level.at += reach * Eigen::Vector2d(dice.draw(i, 2) - 0.5, dice.draw(i, 3) - 0.5);
      levels.push_back(level);
    }
    bool stands = depth_inside(levels[0].bottom(), Level::common_centre(levels)) > options.inside_m;
    for (std::size_t i = 1; i < count && stands; ++i) {
      stands = Level::margin_m(levels, i) > options.inside_m;
    }
    if (stands) return levels;
  }
  return std::nullopt;
}

RandomStack StackMaker::make(StackFault fault, std::uint64_t seed, const Eigen::Vector2d& place,
                             const RandomStackOptions& options) const {
  const int range = options.highest - options.lowest + 1;
  for (std::uint64_t round = 0; round < 100; ++round) {
    const auto random = [&](int what) { return to_unit(sample_hash(seed, round, 77, what)); };
    const auto height = std::size_t(options.lowest + int(random(0) * range));
    const std::size_t count = height + (fault == StackFault::removed ? 1 : 0);
    const auto levels = try_levels(count, sample_hash(seed, round), place, options);
    if (!levels) continue;
    std::vector<Level> made = *levels;
    RandomStack stack{fault, {}, count};
    if (fault == StackFault::removed) {
      stack.broken_at = std::size_t(random(1) * double(count - 1));
      // What stays below must not have needed the weight that is gone.
      const std::span<const Level> below(made.data(), stack.broken_at);
      bool stands = true;
      for (std::size_t i = 1; i < below.size(); ++i) {
        stands = stands && Level::margin_m(below, i) > options.inside_m;
      }
      if (!stands) continue;
      made.erase(made.begin() + std::ptrdiff_t(stack.broken_at));
    }
    if (fault == StackFault::shifted) {
      stack.broken_at = 1 + std::size_t(random(1) * double(count - 1));
      const double angle = 2 * std::numbers::pi * random(2);
      const double wanted =
          options.outside_m + (options.farthest_outside_m - options.outside_m) * random(3);
      const Eigen::Vector2d step = 0.001 * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      for (int i = 0; i < 200 && Level::margin_m(made, stack.broken_at) > -wanted; ++i) {
        for (std::size_t k = stack.broken_at; k < made.size(); ++k) made[k].at += step;
      }
      const double contact =
          area_of(common_part(made[stack.broken_at].bottom(), made[stack.broken_at - 1].top()));
      if (contact < kLeastArea_m2) continue;
      // What is shifted may be too much for a joint further down.
      for (std::size_t i = made.size() - 1; i > 0; --i) {
        if (Level::margin_m(made, i) < 0) stack.broken_at = i;
      }
    }
    for (const Level& level : made) stack.bodies.push_back(level.body());
    return stack;
  }
  throw bad_input("types", "found no stack of them; expected bodies that can lie on each other");
}

}  // namespace vantage
