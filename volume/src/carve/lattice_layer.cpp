#include "carve/lattice_layer.hpp"

#include <algorithm>
#include <cstring>

#include "vantage/raycore/detail/multiversion.hpp"

namespace vantage::volume::detail {
namespace {

/// A number for each voxel of a layer.
struct alignas(64) LayerNumbers {
  double at[kLayerVoxels];
};

struct LayerPixels {
  LayerNumbers u, v, inverse;  ///< 1 / depth
};

/// Where along an axis a layer's voxels are: the cell, its start and 1 / its length.
struct LayerPlaces {
  LayerNumbers cell, start, per_cell;
};

/// 1 / depth at the corners of the voxels' cells.
struct LayerCorners {
  LayerNumbers d00, d10, d01, d11;
};

[[gnu::always_inline]] inline void project_body(const LayerOnImage& layer, double* __restrict u,
                                                double* __restrict v, double* __restrict inverse) {
  for (int n = 0; n < kLayerVoxels; ++n) {
    const double y = n >> 3, z = n & 7;
    const double uz = layer.first[0] + y * layer.step_y[0] + z * layer.step_z[0];
    const double vz = layer.first[1] + y * layer.step_y[1] + z * layer.step_z[1];
    const double depth = layer.first[2] + y * layer.step_y[2] + z * layer.step_z[2];
    inverse[n] = 1 / depth;
    u[n] = uz * inverse[n];
    v[n] = vz * inverse[n];
  }
}
constexpr Multiversion<project_body> project_kernel;

/// Moves those to a cell that are at its start or beyond.
[[gnu::always_inline]] inline void move_body(double to_cell, double to_start, double to_per_cell,
                                             const double* __restrict at, double* __restrict cell,
                                             double* __restrict start,
                                             double* __restrict per_cell) {
  for (int n = 0; n < kLayerVoxels; ++n) {
    const bool beyond = at[n] >= to_start;
    const double old_cell = cell[n], old_start = start[n], old_per_cell = per_cell[n];
    cell[n] = beyond ? to_cell : old_cell;
    start[n] = beyond ? to_start : old_start;
    per_cell[n] = beyond ? to_per_cell : old_per_cell;
  }
}
constexpr Multiversion<move_body> move_kernel;

/// Cells by counting the vertices that a voxel is beyond: there are few, and nothing to look up.
void find_places(const LatticeAxis& axis, int first, int last, const LayerNumbers& at,
                 LayerPlaces& places) {
  const auto start = [&](int cell) { return axis.vertices[std::size_t(cell)]; };
  const auto per_cell = [&](int cell) { return axis.per_cell[std::size_t(cell)]; };
  std::fill_n(places.cell.at, kLayerVoxels, double(first));
  std::fill_n(places.start.at, kLayerVoxels, start(first));
  std::fill_n(places.per_cell.at, kLayerVoxels, per_cell(first));
  for (int cell = first + 1; cell <= last; ++cell) {
    move_kernel(cell, start(cell), per_cell(cell), at.at, places.cell.at, places.start.at,
                places.per_cell.at);
  }
}

void gather_corners(const LayerPlaces& columns, const LayerPlaces& rows, std::size_t width,
                    const double* inverse_depth, LayerCorners& corners) {
  for (int n = 0; n < kLayerVoxels; ++n) {
    const double* const upper =
        inverse_depth + std::size_t(rows.cell.at[n]) * width + std::size_t(columns.cell.at[n]);
    const double* const lower = upper + width;
    corners.d00.at[n] = upper[0], corners.d10.at[n] = upper[1];
    corners.d01.at[n] = lower[0], corners.d11.at[n] = lower[1];
  }
}

/// The surface's 1 / depth; NaN if one of the four is unknown.
[[gnu::always_inline]] inline void surface_body(const LayerPixels& pixels,
                                                const LayerPlaces& columns, const LayerPlaces& rows,
                                                const LayerCorners& d, double* __restrict surface) {
  for (int n = 0; n < kLayerVoxels; ++n) {
    const double x = (pixels.u.at[n] - columns.start.at[n]) * columns.per_cell.at[n];
    const double y = (pixels.v.at[n] - rows.start.at[n]) * rows.per_cell.at[n];
    const double d00 = d.d00.at[n], d10 = d.d10.at[n], d01 = d.d01.at[n], d11 = d.d11.at[n];
    const double low = d00 + x * (d10 - d00) + y * (d01 - d00) + 0 * d11;
    const double high = d11 + (1 - x) * (d01 - d11) + (1 - y) * (d10 - d11) + 0 * d00;
    surface[n] = x + y <= 1 ? low : high;
  }
}
constexpr Multiversion<surface_body> surface_kernel;

/// Where the lattice ends, from 0.
struct LatticeEnd {
  double width, height;
};

[[gnu::always_inline]] inline void judge_body(const LatticeEnd& end, const double* __restrict u,
                                              const double* __restrict v,
                                              const double* __restrict inverse,
                                              const double* __restrict surface,
                                              std::uint8_t* __restrict covered,
                                              std::uint8_t* __restrict seen) {
  for (int n = 0; n < kLayerVoxels; ++n) {
    const bool inside =
        (inverse[n] > 0) & (u[n] >= 0) & (u[n] <= end.width) & (v[n] >= 0) & (v[n] <= end.height);
    covered[n] = std::uint8_t(inside);
    seen[n] = std::uint8_t(inside & (inverse[n] > surface[n]));
  }
}
constexpr Multiversion<judge_body> judge_kernel;

/// Bit n of the result is byte n, which is 0 or 1.
std::uint64_t to_bits(const std::uint8_t (&flags)[kLayerVoxels]) {
  constexpr std::uint64_t kGather = 0x0102040810204080;  // byte i's bit to bit 56 + i
  std::uint64_t bits = 0;
  for (int byte = 0; byte < 8; ++byte) {
    std::uint64_t eight;
    std::memcpy(&eight, flags + 8 * byte, 8);
    bits |= (eight * kGather >> 56) << (8 * byte);
  }
  return bits;
}

}  // namespace

LayerSeen compare_layer(const LatticeAxis& columns, const LatticeAxis& rows,
                        const LatticeCells& cells, const double* inverse_depth,
                        const LayerOnImage& layer) {
  LayerPixels pixels;
  project_kernel(layer, pixels.u.at, pixels.v.at, pixels.inverse.at);
  LayerPlaces column, row;
  find_places(columns, cells.i0, cells.i1, pixels.u, column);
  find_places(rows, cells.j0, cells.j1, pixels.v, row);
  LayerCorners corners;
  gather_corners(column, row, columns.vertices.size(), inverse_depth, corners);
  LayerNumbers surface;
  surface_kernel(pixels, column, row, corners, surface.at);
  alignas(64) std::uint8_t covered[kLayerVoxels], seen[kLayerVoxels];
  judge_kernel({columns.length, rows.length}, pixels.u.at, pixels.v.at, pixels.inverse.at,
               surface.at, covered, seen);
  return {to_bits(covered), to_bits(seen)};
}

}  // namespace vantage::volume::detail
