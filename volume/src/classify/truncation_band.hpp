#pragma once

#include <cstdint>
#include <vector>

#include "grid/grid_frame.hpp"
#include "grid/hierarchical_z.hpp"
#include "vantage/raycore/depth_image.hpp"
#include "vantage/raycore/detail/box_projector.hpp"
#include "vantage/volume/volume_options.hpp"

namespace vantage::volume::detail {

/// Pixels [u0, u1] × [v0, v1].
struct PixelRect {
  int u0, u1, v0, v1;
};

/// A depth image prepared for comparison with voxels: for every pixel the surface band around its
/// depth, and the voxel that its point lies in.
class DepthBands {
 public:
  /// @param camera in the grid's frame.
  DepthBands(const PinholeCamera& camera, const DepthImage& depth, const GridFrame& frame,
             const VolumeOptions& options);

  /// The pixels that are nearest to some point of a rectangle, and one more to each side.
  PixelRect pixels_of(const ImageRect& rect) const;

  /// No more than the smallest front, and no less than the largest back, of the bands over some
  /// pixels. Unknown pixels have both at minus infinity; those of depths beyond the far limit have
  /// the back at infinity.
  float nearest_front(const PixelRect& pixels) const;
  float farthest_back(const PixelRect& pixels) const;

  /// Sorts N points in view by where they are to the band of their nearest pixel.
  /// @param through, surface, unknown 1 or 0 for each: in front of the band, in the band, no depth
  /// at that pixel.
  void compare(const float* u, const float* v, const float* depth, std::size_t count,
               std::uint8_t* through, std::uint8_t* surface, std::uint8_t* unknown) const;

  /// The voxels of a block in which a point was measured, if it was measured in one of `pixels`.
  BlockBits measured_points(std::size_t block, const PixelRect& pixels) const;

 private:
  void fill_row(const PinholeCamera& camera, const DepthImage& depth, const GridFrame& frame,
                const VolumeOptions& options, int v);
  void reduce_row_of_cells(int row, std::vector<float>& fronts, std::vector<float>& backs) const;

  int width_, height_;
  std::vector<float> front_, back_;
  std::vector<std::int32_t> block_;     ///< -1 where there is no point in the grid
  std::vector<std::uint16_t> offset_;   ///< in the block
  MinPyramid fronts_, negative_backs_;  ///< over cells of kCell² pixels
};

}  // namespace vantage::volume::detail
