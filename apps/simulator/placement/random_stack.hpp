#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "simulator/placement/flat_polygon.hpp"
#include "vantage/raycore/pose.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage {

/// A body of a stack.
struct StackedBody {
  std::size_t mesh = 0;  ///< which one of the given meshes
  Pose T_world_body;
};

/// What is wrong with a stack.
enum class StackFault {
  none,
  removed,  ///< one that carries others was taken away, and those stay in the air
  shifted,  ///< one is pushed aside, with all that it carries, until they would fall
};

/// Bodies on each other, the lowest first, on a floor.
struct RandomStack {
  StackFault fault = StackFault::none;
  std::vector<StackedBody> bodies;
  /// The first body that cannot be at rest; `bodies.size()` for a stack without fault.
  std::size_t broken_at = 0;
};

struct RandomStackOptions {
  int lowest = 2, highest = 4;  ///< bodies; at a fault there is one more before
  double floor_z_m = 0;
  /// How far the centre of mass of what lies above lies inside the area of contact in every joint
  /// of a stack that stands, at least; and how far outside where one is shifted.
  double inside_m = 0.002, outside_m = 0.015, farthest_outside_m = 0.03;
};

/// Makes stacks of bodies that have horizontal faces at top and bottom when they are at rest. Which
/// of them stand follows from two rules: in every joint the centre of mass of all that is above has
/// to lie over the area of contact; and a stack begins on the floor.
class StackMaker {
 public:
  /// @throws Error bad_input if no mesh has a resting pose with a flat top.
  explicit StackMaker(std::span<const std::shared_ptr<const TriangleMesh>> meshes);

  /// A random stack around a place on the floor. The same seed gives the same bits.
  RandomStack make(StackFault fault, std::uint64_t seed, const Eigen::Vector2d& place,
                   const RandomStackOptions& options = {}) const;

 private:
  /// A way in which a mesh can be a part of a stack; its frame is turned, not moved.
  struct Part {
    std::size_t mesh = 0;
    Eigen::Matrix3d rotation;
    double below_m = 0,
           above_m = 0;  ///< the origin's heights over the bottom, and the top's over it
    double volume_m3 = 0;
    Eigen::Vector2d centre;  ///< of mass, from the origin
    FlatPolygon bottom, top;
  };
  struct Level;

  std::optional<std::vector<Level>> try_levels(std::size_t count, std::uint64_t seed,
                                               const Eigen::Vector2d& place,
                                               const RandomStackOptions& options) const;

  std::vector<Part> parts_;
};

}  // namespace vantage
