#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "reference/box_oracle.hpp"
#include "reference/random_scene.hpp"
#include "vantage/raycore/world_model.hpp"

namespace vantage::test {

/// A world of boxes in the form that the oracles take.
struct BoxWorld {
  std::vector<TurnedBox> boxes;
  std::vector<PinholeCamera> cameras;
  GridGeometry geometry;

  /// The same for `classify`: objects are named "box 0", "box 1" …
  WorldModel model() const;
};

KnownObject known_box(const std::string& name, const TurnedBox& box);

/// One to eight turned boxes of 2 to 9 cm, which may overlap, in a work area of 24 × 24 × 20 cm;
/// one to six cameras: around it, with images that cover a part of it, or in its midst. Voxels of
/// 7.5, 10, 15 or 20 mm unless `voxel_size_m` says otherwise.
BoxWorld random_boxes(std::uint32_t seed, std::optional<double> voxel_size_m = {});

/// The same with six rods and plates instead, 1 to 6 mm thick: what passes between the corners of a
/// block of voxels.
BoxWorld random_rods(std::uint32_t seed, double voxel_size_m);

/// The awkward cases: cameras on corners, edges, faces and centres of voxels, so that lines of
/// sight run along axes and through voxels' edges and corners. Every other seed has boxes that fill
/// whole voxels. Voxels of 1/64 m, or `finer` times smaller, a power of 2: no rounding anywhere.
BoxWorld random_lattice_boxes(std::uint32_t seed, int finer = 1);

}  // namespace vantage::test
