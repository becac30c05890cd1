#pragma once

#include <Eigen/Core>
#include <vector>

#include "vantage/raycore/depth_lattice.hpp"
#include "vantage/raycore/points.hpp"

namespace vantage::detail {

/// Finds the cell of a coordinate among increasing lines in a few steps that are the same for every
/// lane: a table has the cell in which each bucket of equal width begins, and from there it goes on
/// by as many cells as any bucket has.
struct AxisLookup {
  float first, last;
  float buckets_per_pixel;
  int last_bucket;
  int steps;
  std::vector<int> cell_of_bucket;
  std::vector<float> starts;         ///< of each cell; behind the last one stands infinity
  std::vector<float> inverse_width;  ///< of each cell

  explicit AxisLookup(const std::vector<float>& lines);
};

/// `DepthLattice::sees` for sixteen points at once, in float: it says whether it is worth asking
/// Embree where a ray leaves a lattice's volume.
struct LatticeProbe {
  AxisLookup columns, rows;
  int width;                          ///< vertices in a row
  std::vector<float> inverse_depth;   ///< NaN where it is unknown
  Eigen::Matrix3d pixels_from_world;  ///< gives (u z, v z, z) of a point relative to the camera

  explicit LatticeProbe(const DepthLattice& lattice);
};

/// A probe for points relative to one ray origin.
struct ProbeView {
  const LatticeProbe* probe;
  float m[9];           ///< pixels_from_world, row by row
  float origin[3];      ///< of the rays, relative to the lattice's camera
  float borders[4][4];  ///< planes of the image's borders: n · p + w > 0 inside, p from the origin

  ProbeView(const LatticeProbe& lattice_probe, const Eigen::Vector3d& relative_origin);
};

/// Where sixteen points appear in a lattice's image.
struct LanePixels {
  alignas(64) float u[kPacketWidth], v[kPacketWidth], inverse_z[kPacketWidth];
};

// "GCC unroll 1" before the loops over a packet's lanes: unrolled before the vectoriser comes to
// see them, they would stay scalar.

/// The cells of sixteen coordinates, and how far across their cells they are. Beyond the first or
/// last line the nearest cell counts.
[[gnu::always_inline]] inline void find_cells(const AxisLookup& axis, const float* x, int* cell,
                                              float* fraction) {
  const int* cell_of_bucket = axis.cell_of_bucket.data();
  const float *starts = axis.starts.data(), *inverse_width = axis.inverse_width.data();
  const float first = axis.first, last = axis.last, rate = axis.buckets_per_pixel;
  const int last_bucket = axis.last_bucket;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const float below = x[i] < last ? x[i] : last;  // `last` for NaN, too
    const int bucket = int(((below > first ? below : first) - first) * rate);
    cell[i] = cell_of_bucket[bucket < last_bucket ? bucket : last_bucket];
  }
  for (int step = 0; step < axis.steps; ++step) {
#pragma GCC unroll 1
    for (std::size_t i = 0; i < kPacketWidth; ++i) cell[i] += starts[cell[i] + 1] <= x[i] ? 1 : 0;
  }
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    fraction[i] = (x[i] - starts[cell[i]]) * inverse_width[cell[i]];
  }
}

[[gnu::always_inline]] inline void project_lanes(const ProbeView& view, const float* dir_x,
                                                 const float* dir_y, const float* dir_z,
                                                 const float* t, LanePixels& pixels) {
  const float* m = view.m;
  const float x0 = view.origin[0], y0 = view.origin[1], z0 = view.origin[2];
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const float x = x0 + t[i] * dir_x[i], y = y0 + t[i] * dir_y[i], z = z0 + t[i] * dir_z[i];
    const float inverse_z = 1 / (m[6] * x + m[7] * y + m[8] * z);
    pixels.u[i] = (m[0] * x + m[1] * y + m[2] * z) * inverse_z;
    pixels.v[i] = (m[3] * x + m[4] * y + m[5] * z) * inverse_z;
    pixels.inverse_z[i] = inverse_z;
  }
}

/// Clears the lanes (-1 or 0) whose points are not within the lattice's outer borders.
/// @returns whether any is left.
[[gnu::always_inline]] inline bool keep_in_image(const LatticeProbe& probe,
                                                 const LanePixels& pixels, int* lanes) {
  const float left = probe.columns.first, right = probe.columns.last;
  const float top = probe.rows.first, bottom = probe.rows.last;
  int any = 0;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const float u = pixels.u[i], v = pixels.v[i];
    lanes[i] &=
        -int((pixels.inverse_z[i] > 0) & (u >= left) & (u <= right) & (v >= top) & (v <= bottom));
    any |= lanes[i];
  }
  return any != 0;
}

/// Clears the lanes whose points are not in front of the surface. Outside of the image the nearest
/// cell's planes count.
/// @returns whether any is left.
[[gnu::always_inline]] inline bool keep_in_front(const LatticeProbe& probe,
                                                 const LanePixels& pixels, int* lanes) {
  alignas(64) int column[kPacketWidth], row[kPacketWidth];
  alignas(64) float across[kPacketWidth], down[kPacketWidth];
  find_cells(probe.columns, pixels.u, column, across);
  find_cells(probe.rows, pixels.v, row, down);
  const float* inverse_depth = probe.inverse_depth.data();
  const int width = probe.width;
  int any = 0;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const int at = row[i] * width + column[i];
    const float a = inverse_depth[at], b = inverse_depth[at + 1];
    const float c = inverse_depth[at + width + 1], d = inverse_depth[at + width];
    const float s = across[i], r = down[i];
    const bool upper = s + r <= 1;  // the triangle a b d; the other one is c d b
    const float corner = upper ? a : c;
    const float to_b = upper ? s : 1 - r, to_d = upper ? r : 1 - s;
    const float surface = corner + to_b * (b - corner) + to_d * (d - corner);
    // A cell with an unknown corner is not there, whichever half the point is in.
    lanes[i] &= -int((pixels.inverse_z[i] > surface) & (a + c == a + c));
    any |= lanes[i];
  }
  return any != 0;
}

/// Shortens t_stop to where rays that are within the outer borders cross one of them.
[[gnu::always_inline]] inline void stop_at_borders(const ProbeView& view, const float* dir_x,
                                                   const float* dir_y, const float* dir_z,
                                                   float* t_stop) {
  for (const float(&plane)[4] : view.borders) {
    const float nx = plane[0], ny = plane[1], nz = plane[2], w = plane[3];
#pragma GCC unroll 1
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
      const float slope = nx * dir_x[i] + ny * dir_y[i] + nz * dir_z[i];
      const float t = -w / slope, old = t_stop[i];
      t_stop[i] = (slope < 0) & (t < old) ? t : old;
    }
  }
}

}  // namespace vantage::detail
