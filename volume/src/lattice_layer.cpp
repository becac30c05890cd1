#include "lattice_layer.hpp"

#include <cstring>

#include "vantage/raycore/multiversion.hpp"

namespace vantage::detail {
namespace {

/// One axis as the kernels need it.
struct AxisArrays {
  const double* vertices;
  const double* per_cell;
  const std::int32_t* starts;
  double length;
  std::int32_t last_cell;
  int steps;

  explicit AxisArrays(const LatticeAxis& axis)
      : vertices(axis.vertices.data()),
        per_cell(axis.per_cell.data()),
        starts(axis.starts.data()),
        length(axis.length),
        last_cell(axis.cells() - 1),
        steps(axis.steps) {}
};

struct LayerPixels {
  alignas(64) double u[kLayerVoxels], v[kLayerVoxels], inverse[kLayerVoxels];  ///< 1 / depth
};

VANTAGE_MULTIVERSION
void project_layer(const LayerOnImage& layer, LayerPixels& pixels) {
  for (int n = 0; n < kLayerVoxels; ++n) {
    const double y = n >> 3, z = n & 7;
    const double uz = layer.first[0] + y * layer.step_y[0] + z * layer.step_z[0];
    const double vz = layer.first[1] + y * layer.step_y[1] + z * layer.step_z[1];
    const double depth = layer.first[2] + y * layer.step_y[2] + z * layer.step_z[2];
    pixels.inverse[n] = 1 / depth;
    pixels.u[n] = uz * pixels.inverse[n];
    pixels.v[n] = vz * pixels.inverse[n];
  }
}

/// `LatticeAxis::cell` for a layer; NaN goes to the first one.
VANTAGE_MULTIVERSION
void find_cells(const AxisArrays& axis, const double* __restrict at,
                std::int32_t* __restrict cell) {
  for (int n = 0; n < kLayerVoxels; ++n) {
    const double above = at[n] > 0 ? at[n] : 0;
    cell[n] = axis.starts[std::int32_t(above < axis.length ? above : axis.length)];
  }
  for (int step = 0; step < axis.steps; ++step) {
    for (int n = 0; n < kLayerVoxels; ++n) {
      const bool beyond = (axis.vertices[cell[n] + 1] <= at[n]) & (cell[n] < axis.last_cell);
      cell[n] += std::int32_t(beyond);
    }
  }
}

/// An unknown depth makes the surface NaN, which nothing is in front of.
VANTAGE_MULTIVERSION
void compare_kernel(const AxisArrays& columns, const AxisArrays& rows,
                    const double* __restrict depth, const LayerPixels& pixels,
                    const std::int32_t* __restrict column, const std::int32_t* __restrict row,
                    std::uint8_t* __restrict covered, std::uint8_t* __restrict seen) {
  const std::int32_t width = columns.last_cell + 2;
  for (int n = 0; n < kLayerVoxels; ++n) {
    const double u = pixels.u[n], v = pixels.v[n];
    const double x = (u - columns.vertices[column[n]]) * columns.per_cell[column[n]];
    const double y = (v - rows.vertices[row[n]]) * rows.per_cell[row[n]];
    const std::int32_t at = row[n] * width + column[n];
    const double d00 = depth[at], d10 = depth[at + 1];
    const double d01 = depth[at + width], d11 = depth[at + width + 1];
    const double low = d00 + x * (d10 - d00) + y * (d01 - d00) + 0 * d11;
    const double high = d11 + (1 - x) * (d01 - d11) + (1 - y) * (d10 - d11) + 0 * d00;
    const bool inside =
        (pixels.inverse[n] > 0) & (u >= 0) & (u <= columns.length) & (v >= 0) & (v <= rows.length);
    covered[n] = std::uint8_t(inside);
    seen[n] = std::uint8_t(inside & (pixels.inverse[n] > (x + y <= 1 ? low : high)));
  }
}

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
                        const double* inverse_depth, const LayerOnImage& layer) {
  const AxisArrays u_axis(columns), v_axis(rows);
  LayerPixels pixels;
  project_layer(layer, pixels);
  alignas(64) std::int32_t column[kLayerVoxels], row[kLayerVoxels];
  find_cells(u_axis, pixels.u, column);
  find_cells(v_axis, pixels.v, row);
  alignas(64) std::uint8_t covered[kLayerVoxels], seen[kLayerVoxels];
  compare_kernel(u_axis, v_axis, inverse_depth, pixels, column, row, covered, seen);
  return {to_bits(covered), to_bits(seen)};
}

}  // namespace vantage::detail
