#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "vantage/raycore/box.hpp"
#include "vantage/raycore/depth_image.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/points.hpp"

namespace vantage {

/// Number of an object in its scene: 0, 1, 2 … in the order of adding.
using ObjectId = std::uint32_t;
inline constexpr ObjectId kNoObject = 0xFFFFFFFFu;

/// A ray from `origin`; hits count where t_near <= t <= t_far, in units of `direction`'s length.
struct Ray {
  Eigen::Vector3f origin;
  Eigen::Vector3f direction;
  float t_near = 0;
  float t_far = std::numeric_limits<float>::infinity();
};

/// Where a ray first meets a surface: at `origin + t * direction`.
struct Hit {
  float t = std::numeric_limits<float>::infinity();
  ObjectId object = kNoObject;
  std::uint32_t triangle = 0;  ///< index into the object's mesh
  float u = 0;                 ///< barycentric weight of the triangle's corner 1
  float v = 0;                 ///< barycentric weight of the triangle's corner 2
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< world frame, unit length, outwards
};

/// N hits, one array per field; fields as in Hit. A miss has t = +infinity, object = kNoObject.
struct Hits {
  std::vector<float> t, u, v;
  std::vector<ObjectId> object;
  std::vector<std::uint32_t> triangle;
  Points normal;

  VANTAGE_API void resize(std::size_t size);
  std::size_t size() const noexcept { return t.size(); }
  bool hit(std::size_t i) const { return object[i] != kNoObject; }
};

/// What the rays of a batch have in common. It changes the speed, never the result's meaning.
enum class RayOrder {
  incoherent,  ///< many directions or origins, e.g. from voxels to a camera
  coherent,    ///< neighbouring pixels of one camera
};

/// A square of 4 × 4 pixels of an image, aligned to it: pixels (4 column + i % 4, 4 row + i / 4)
/// for i = 0 … 15. At the image's borders some may lie outside it.
struct PixelTile {
  static constexpr int kSide = 4;
  static constexpr int kPixels = kSide * kSide;
  std::uint16_t column = 0, row = 0;
  bool operator==(const PixelTile&) const = default;
};

/// What the rays of a tile's pixels meet first. A miss has t = +infinity, object = kNoObject.
struct TileHits {
  alignas(64) float t[PixelTile::kPixels];  ///< depth along the optical axis, metres
  alignas(64) ObjectId object[PixelTile::kPixels];
};

namespace raycore::detail {
struct SceneImpl;
}

/// An immutable set of triangles under a BVH. Made by SceneBuilder, shared by
/// `shared_ptr<const Scene>`; every method may be called from many threads at once.
///
/// Batches are split over the `tbb::task_arena` in which they are called. The same batch gives the
/// same bits at any number of threads. No ray slips through an edge that two triangles share; which
/// of them it reports is left open. Of the rays that are aimed, to the last bit, at a shared
/// vertex, some tenths of a percent slip through (Embree's robust test); beside it none do.
///
/// Every ray is checked first. A coordinate that is not finite or beyond 1e9 m, a zero direction
/// and a segment of zero length are refused: Error bad_input with the index of the first such ray.
class VANTAGE_API Scene {
 public:
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  std::size_t object_count() const noexcept;
  std::size_t triangle_count() const noexcept;  ///< an instance counts its mesh's triangles

  /// An object's triangles, as rays meet them: world frame; counter-clockwise from outside.
  std::size_t triangle_count(ObjectId object) const noexcept;
  std::array<Eigen::Vector3d, 3> corners(ObjectId object, std::size_t triangle) const;

  /// Whether anything touches the closed segment between two points.
  bool occluded(const Eigen::Vector3f& from, const Eigen::Vector3f& to) const;

  /// The same for N pairs of points: 1 or 0 for each.
  /// @throws Error bad_input unless `from`, `to` and `result` are of one size.
  void occluded(PointsView from, PointsView to, std::span<std::uint8_t> result,
                RayOrder order = RayOrder::incoherent) const;

  /// The same for N segments that end in one point, e.g. a camera's centre.
  void occluded(PointsView from, const Eigen::Vector3f& to, std::span<std::uint8_t> result,
                RayOrder order = RayOrder::incoherent) const;

  /// The same for some packets of the points, for callers who ask piece by piece: bit l of
  /// `hidden[i]` for point l of packet `packets[i]`, if bit l of `wanted[i]` is set; 0 if not.
  /// Runs in the calling thread.
  /// @throws Error bad_input unless the last three spans are of one size, and every packet is there
  /// in full.
  void occluded(PointsView from, const Eigen::Vector3f& to, std::span<const std::uint32_t> packets,
                std::span<const std::uint16_t> wanted, std::span<std::uint16_t> hidden) const;

  std::optional<Hit> closest_hit(const Ray& ray) const;

  /// N rays with 0 <= t. `hits` is resized to N.
  /// @throws Error bad_input unless both are of one size.
  void closest_hits(PointsView origins, PointsView directions, Hits& hits,
                    RayOrder order = RayOrder::incoherent) const;

  /// N rays from one origin, e.g. a camera's centre.
  void closest_hits(const Eigen::Vector3f& origin, PointsView directions, Hits& hits,
                    RayOrder order = RayOrder::coherent) const;

  /// The first hits, at depths up to the camera's far depth, of N tiles of its image: of the rays
  /// `pixel_ray(u, v)`, directions rounded to float. A tile is a packet of its own, so that what
  /// comes out for it does not depend on the other tiles. Runs in the calling thread.
  /// @throws Error bad_input unless both spans have the same size, and for a camera that is, or
  /// whose pixels look, beyond 1e9 m.
  void first_hits(const PinholeCamera& camera, std::span<const PixelTile> tiles,
                  std::span<TileHits> hits) const;

  /// The depth that an ideal sensor measures: unknown where the first surface is not within the
  /// camera's range. What is nearer than that hides what is behind it, and is unknown itself.
  DepthImage render_depth(const PinholeCamera& camera) const;

  /// Whether a surface is closer to a point than `distance_m`; of `object` only, unless that is
  /// `kNoObject`. Computed in double from the scene's triangles; an instance's place is a float.
  /// Its cost depends on how much is that close: nothing is found in a tenth of a microsecond.
  /// @throws Error bad_input unless the point is within 1e9 m and 0 <= distance_m <= 1e9.
  bool closer_than(double distance_m, const Eigen::Vector3d& p_world,
                   ObjectId object = kNoObject) const;

  /// The same for a box, which is solid: a surface that touches it, crosses it or lies inside it is
  /// closer than 0.
  bool closer_than(double distance_m, const Box& box, const Pose& T_world_box,
                   ObjectId object = kNoObject) const;

  /// Whether a closed object that looks outwards surrounds a point. Three lines through it decide,
  /// the majority of them: where surfaces coincide, a ray sees one of them only. A mesh that is not
  /// closed may be taken for closed where it has faces on both sides of the point. Nothing that is
  /// nearer to a surface than 1e-6 of its coordinates is certain.
  /// @throws Error bad_input unless the point is within 1e9 m.
  bool encloses(const Eigen::Vector3d& p_world) const;

 private:
  friend class SceneBuilder;
  explicit Scene(std::unique_ptr<raycore::detail::SceneImpl> impl);
  std::unique_ptr<raycore::detail::SceneImpl> impl_;
};

}  // namespace vantage
