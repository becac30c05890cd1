#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/advanced/visibility_mesh.hpp"
#include "vantage/raycore/box.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage {

/// Where the rays of a tile's pixels first meet what no camera saw through. A miss has
/// t = end = +infinity, source = kNoSource and facing 0.
struct UnseenHits {
  static constexpr std::uint32_t kNoSource = 0xFFFFFFFFu;

  alignas(64) float t[PixelTile::kPixels];  ///< depth along the optical axis, metres
  /// Depth at which the unseen ends at the latest: at the box's other side, at the shell, or where
  /// the range ends. What lattices saw before that is not looked for.
  alignas(64) float end[PixelTile::kPixels];
  /// The cosine between the surface's normal and the direction to the camera that made it, 0 to 1
  /// (thesis 7.4.3): 1 where that camera looked straight at it, 0 along its lines of sight, at the
  /// borders of its image and on the box's faces.
  alignas(64) float facing[PixelTile::kPixels];
  /// The lattice whose surface it is; kNoSource on a face of the box or of the shell, and inside
  /// (t = 0).
  alignas(64) std::uint32_t source[PixelTile::kPixels];
};

/// A box less the volumes of depth lattices, as rays see it: "solid or shadow" (thesis 7.4.3)
/// without a boolean operation. A ray walks from volume to volume, and what it meets first is where
/// it leaves the last one, or the box's face where no volume is. It may start anywhere: inside or
/// outside of the box and of any volume. What is outside of a shell can be ruled out.
///
/// Each lattice is an Embree scene of its own, in its camera's projective space: pixels and inverse
/// depth, where lines stay lines and planes planes. Its cells are a field of heights there, as
/// Embree's grids; the borders of holes are upright walls. In the world, cells at edges in depth
/// would be slivers in huge boxes, and rays take half as long again. What is thinner along a ray
/// than 1e-5 of the coordinates on its way may be taken for seen. Immutable; thread-safe.
class VANTAGE_API UnobservedSpace {
 public:
  /// Builds in the caller's task arena.
  /// @param shell a closed mesh in the world that looks outwards: nothing outside of it counts as
  /// unseen, so that rays begin the unseen where they enter the shell, with facing 0 as on the
  /// box's faces. Null if all of the box counts. It is not referred to later.
  /// @throws Error bad_input as `VisibilityMesh::check` does, and for a box or lattice beyond 1e9
  /// m.
  UnobservedSpace(std::span<const VisibilityMesh> lattices, const Box& box,
                  const TriangleMesh* shell = nullptr);
  ~UnobservedSpace();
  UnobservedSpace(const UnobservedSpace&) = delete;
  UnobservedSpace& operator=(const UnobservedSpace&) = delete;

  const Box& box() const noexcept;
  std::size_t lattice_count() const noexcept;

  /// What N tiles of a camera's image show, up to its far depth; pixels' rays as in
  /// `Scene::first_hits`. A tile is a packet of its own, so that what comes out for it does not
  /// depend on the other tiles. Runs in the calling thread.
  /// @throws Error bad_input unless both spans have the same size, and for a camera that is, or
  /// whose pixels look, beyond 1e9 m.
  void first_unseen(const PinholeCamera& camera, std::span<const PixelTile> tiles,
                    std::span<UnseenHits> hits) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vantage
