#include "vantage/volume/visibility.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "carve/depth_inpainting.hpp"
#include "vantage/raycore/box_projector.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

/// Whatever is before the camera counts as in range: rays start at its centre.
constexpr DepthRange kAnyDepth = {1e-6, 1e9};

/// Pixels [first, last] of a row or a column.
struct PixelSpan {
  int first, last;
};

/// The pixels around a stretch of the image, at least two; nothing if there are no two.
std::optional<PixelSpan> pixels_around(double low, double high, int count) {
  if (count < 2 || !(low <= high)) return std::nullopt;
  const double end = count - 1;
  PixelSpan span{int(std::clamp(std::floor(low), 0.0, end)),
                 int(std::clamp(std::ceil(high), 0.0, end))};
  if (span.first == span.last) (span.first > 0 ? --span.first : ++span.last);
  return span;
}

/// The rows and columns of the pixels whose rays can meet the work area; the whole image if it is
/// too near to say.
struct Region {
  std::optional<PixelSpan> columns, rows;
};
Region region_of_interest(const PinholeCamera& camera, const Box& work_area) {
  const Intrinsics& k = camera.intrinsics();
  const BoxProjector projector({k, camera.T_world_cam(), kAnyDepth});
  const Extent extent{work_area.centre(), 0.5 * work_area.size()};
  const BoxInView view = projector.project(extent, projector.margin_m(extent));
  if (view.coverage == Coverage::none) return {};
  return {pixels_around(view.rect.u0, view.rect.u1, k.width),
          pixels_around(view.rect.v0, view.rect.v1, k.height)};
}

std::vector<float> vertices_over(const PixelSpan& span, int step_px) {
  std::vector<float> pixels;
  for (int p = span.first; p < span.last; p += step_px) pixels.push_back(float(p));
  pixels.push_back(float(span.last));
  return pixels;
}

void fill_depths(const detail::FilledDepth& depth, double offset, DepthLattice& lattice) {
  lattice.depth.resize(lattice.width() * lattice.height());
  tbb::parallel_for(std::size_t(0), lattice.height(), [&](std::size_t j) {
    float* const row = &lattice.depth[j * lattice.width()];
    for (std::size_t i = 0; i < lattice.width(); ++i) {
      const double inverse = depth.inverse(int(lattice.columns[i]), int(lattice.rows[j]));
      // NaN stays; no depth more than doubles.
      row[i] = float(1 / std::max(inverse - offset, 0.5 * inverse));
    }
  });
}

bool has_any_cell(const DepthLattice& lattice) {
  for (std::size_t j = 0; j + 1 < lattice.height(); ++j)
    for (std::size_t i = 0; i + 1 < lattice.width(); ++i)
      if (lattice.has_cell(i, j)) return true;
  return false;
}

void check_range(const char* key, int value, int least, int most) {
  if (value >= least && value <= most) return;
  throw bad_input(key, fmt::format("is {}; expected {} to {} pixels", value, least, most));
}

}  // namespace

void VisibilityOptions::check() const {
  check_range("step_px", step_px, 1, 64);
  check_range("fill_reach_px", fill_reach_px, 0, 16384);
  if (!std::isfinite(offset_sigmas) || offset_sigmas < 0) {
    throw bad_input("offset_sigmas",
                    fmt::format("is {}; expected a finite number, 0 or above", offset_sigmas));
  }
  VolumeOptions volume;
  volume.noise = noise;
  volume.check();
}

std::optional<DepthLattice> visibility_lattice(const PosedDepth& image, const Box& work_area,
                                               const VisibilityOptions& options) {
  options.check();
  const Region region = region_of_interest(image.camera, work_area);
  if (!region.columns || !region.rows) return std::nullopt;
  DepthLattice lattice{image.camera,
                       vertices_over(*region.columns, options.step_px),
                       vertices_over(*region.rows, options.step_px),
                       {}};
  const int reach_px = options.holes == DepthHoles::fill ? options.fill_reach_px : 0;
  // σ(z) = σ(1) z², so that in inverse depth the noise is the same everywhere.
  fill_depths(detail::FilledDepth(image, reach_px),
              options.offset_sigmas * options.noise.sigma_m(1), lattice);
  if (!has_any_cell(lattice)) return std::nullopt;
  return lattice;
}

}  // namespace vantage
