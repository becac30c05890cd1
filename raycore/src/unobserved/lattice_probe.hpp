#pragma once

#include <Eigen/Core>
#include <vector>

#include "vantage/raycore/advanced/visibility_mesh.hpp"
#include "vantage/raycore/points.hpp"

namespace vantage::raycore::detail {

/// Finds the cell of a coordinate among increasing lines in a few steps that are the same for every
/// lane: a table has the cell in which each bucket of equal width begins, and from there it goes on
/// by as many cells as any bucket has.
struct AxisLookup {
  float first, last;
  float buckets_per_pixel;
  int last_bucket;
  int steps;
  bool even;   ///< whether all cells, save for the last one, are of one width: no table is needed
  float step;  ///< that width
  std::vector<int> cell_of_bucket;
  std::vector<float> starts;         ///< of each cell; behind the last one stands infinity
  std::vector<float> inverse_width;  ///< of each cell

  explicit AxisLookup(const std::vector<float>& lines);
};

/// About as high as images are wide: so Embree's builder makes boxes of a good shape.
inline constexpr float kHighest = 1000;

/// Nearer to the camera than this part of the smallest depth nothing is asked for: so what Embree
/// gets to see stays in its reach.
inline constexpr float kNearestPart = 1e-6f;

/// `VisibilityMesh::sees` for sixteen points at once, in float: it says whether it is worth asking
/// Embree where a ray leaves a lattice's volume.
///
/// It works where the lattice's scene does, in the lattice's own projective space: a point is at
/// (u, v, w), its pixel and its nearness, which is kHighest at the lattice's smallest depth and
/// falls as 1 / z. Lines stay lines there and planes planes, and the volume is a field of heights.
struct LatticeProbe {
  AxisLookup columns, rows;
  int width;                          ///< vertices in a row
  float nearest;                      ///< smallest depth; 1 if all are unknown
  float height;                       ///< w · z of any point
  std::vector<float> nearness;        ///< of the vertices; NaN where it is unknown
  Eigen::Matrix3d pixels_from_world;  ///< gives (u z, v z, z) of a point relative to the camera

  explicit LatticeProbe(const VisibilityMesh& lattice);
};

/// A probe for points relative to one ray origin.
struct ProbeView {
  const LatticeProbe* probe;
  float m[9];        ///< pixels_from_world, row by row
  float origin[3];   ///< of the rays, as (u z, v z, z)
  float borders[4];  ///< how far inside of the left, right, upper and lower one it is, times z

  ProbeView(const LatticeProbe& lattice_probe, const Eigen::Vector3d& relative_origin);
};

/// Sixteen directions, as they change (u z, v z, z).
struct LaneDirections {
  alignas(64) float u[kPacketWidth], v[kPacketWidth], z[kPacketWidth];
};

/// Sixteen points in a lattice's projective space.
struct LanePixels {
  alignas(64) float u[kPacketWidth], v[kPacketWidth], w[kPacketWidth];
};

// "GCC unroll 1" before the loops over a packet's lanes: unrolled before the vectoriser comes to
// see them, they would stay scalar.

/// `find_cells` where the table is not needed, and four loads of every lane are saved.
[[gnu::always_inline]] inline void find_even_cells(const AxisLookup& axis, const float* x,
                                                   int* cell, float* fraction) {
  const int last_cell = int(axis.inverse_width.size()) - 1;
  const float first = axis.first, last = axis.last, step = axis.step;
  const float rate = axis.inverse_width.front(), last_rate = axis.inverse_width.back();
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const float below = x[i] < last ? x[i] : last;  // `last` for NaN, too
    const float place = ((below > first ? below : first) - first) * rate;
    const int at = int(place < float(last_cell) ? place : float(last_cell));
    cell[i] = at;
    fraction[i] = (x[i] - (first + float(at) * step)) * (at == last_cell ? last_rate : rate);
  }
}

/// The cells of sixteen coordinates, and how far across their cells they are. Beyond the first or
/// last line the nearest cell counts.
[[gnu::always_inline]] inline void find_cells(const AxisLookup& axis, const float* x, int* cell,
                                              float* fraction) {
  if (axis.even) return find_even_cells(axis, x, cell, fraction);
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

[[gnu::always_inline]] inline void turn_lanes(const ProbeView& view, const float* dir_x,
                                              const float* dir_y, const float* dir_z,
                                              LaneDirections& d) {
  const float* m = view.m;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const float x = dir_x[i], y = dir_y[i], z = dir_z[i];
    d.u[i] = m[0] * x + m[1] * y + m[2] * z;
    d.v[i] = m[3] * x + m[4] * y + m[5] * z;
    d.z[i] = m[6] * x + m[7] * y + m[8] * z;
  }
}

[[gnu::always_inline]] inline void project_lanes(const ProbeView& view, const LaneDirections& d,
                                                 const float* t, LanePixels& pixels) {
  const float u0 = view.origin[0], v0 = view.origin[1], z0 = view.origin[2];
  const float height = view.probe->height;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const float inverse_z = 1 / (z0 + t[i] * d.z[i]);
    pixels.u[i] = (u0 + t[i] * d.u[i]) * inverse_z;
    pixels.v[i] = (v0 + t[i] * d.v[i]) * inverse_z;
    pixels.w[i] = height * inverse_z;
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
    lanes[i] &= -int((pixels.w[i] > 0) & (u >= left) & (u <= right) & (v >= top) & (v <= bottom));
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
  const float* nearness = probe.nearness.data();
  const int width = probe.width;
  int any = 0;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const int at = row[i] * width + column[i];
    const float a = nearness[at], b = nearness[at + 1];
    const float c = nearness[at + width + 1], d = nearness[at + width];
    const float s = across[i], r = down[i];
    const bool upper = s + r <= 1;  // the triangle a b d; the other one is c d b
    const float corner = upper ? a : c;
    const float to_b = upper ? s : 1 - r, to_d = upper ? r : 1 - s;
    const float surface = corner + to_b * (b - corner) + to_d * (d - corner);
    // A cell with an unknown corner is not there, whichever half the point is in.
    lanes[i] &= -int((pixels.w[i] > surface) & (a + c == a + c));
    any |= lanes[i];
  }
  return any != 0;
}

/// Shortens t_stop to where rays that are within the outer borders cross one of them.
[[gnu::always_inline]] inline void stop_at_borders(const ProbeView& view, const LaneDirections& d,
                                                   float* t_stop) {
  const LatticeProbe& probe = *view.probe;
  const float left = probe.columns.first, right = probe.columns.last;
  const float top = probe.rows.first, bottom = probe.rows.last;
  const float* inside = view.borders;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const float slopes[4] = {d.u[i] - left * d.z[i], right * d.z[i] - d.u[i], d.v[i] - top * d.z[i],
                             bottom * d.z[i] - d.v[i]};
    float stop = t_stop[i];
    for (int border = 0; border < 4; ++border) {
      const float t = -inside[border] / slopes[border];
      stop = (slopes[border] < 0) & (t < stop) ? t : stop;
    }
    t_stop[i] = stop;
  }
}

}  // namespace vantage::raycore::detail
