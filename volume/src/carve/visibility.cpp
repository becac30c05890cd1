#include "carve/visibility.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "vantage/raycore/detail/box_projector.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/volume/advanced/visibility.hpp"

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

void fill_depths(const volume::detail::FilledDepth& depth, double offset, VisibilityMesh& lattice) {
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

bool has_any_cell(const VisibilityMesh& lattice) {
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
}

std::optional<VisibilityMesh> visibility_lattice(const PosedDepth& image, const Box& work_area,
                                                 const StereoNoise& noise,
                                                 const VisibilityOptions& options) {
  options.check();
  noise.check();
  const Region region = region_of_interest(image.camera, work_area);
  if (!region.columns || !region.rows) return std::nullopt;
  VisibilityMesh lattice{image.camera,
                         vertices_over(*region.columns, options.step_px),
                         vertices_over(*region.rows, options.step_px),
                         {}};
  const int reach_px = options.holes == DepthHoles::fill ? options.fill_reach_px : 0;
  // σ(z) = σ(1) z², so that in inverse depth the noise is the same everywhere.
  fill_depths(volume::detail::FilledDepth(image, reach_px),
              options.offset_sigmas * noise.sigma_m(1), lattice);
  if (!has_any_cell(lattice)) return std::nullopt;
  return lattice;
}

}  // namespace vantage

namespace vantage::volume::detail {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

struct Step {
  int du, dv;
};
constexpr std::array<Step, 4> kSteps = {{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};

}  // namespace

FilledDepth::FilledDepth(const PosedDepth& image, int reach_px)
    : depth_(*image.depth),
      near_m_(float(image.camera.range().near_m)),
      far_m_(float(image.camera.range().far_m)),
      reach_px_(reach_px) {}

double FilledDepth::inverse(int u, int v) const {
  const double own = measured(u, v);
  return std::isnan(own) && reach_px_ > 0 ? filled(u, v) : own;
}

double FilledDepth::measured(int u, int v) const {
  if (u < 0 || u >= depth_.width() || v < 0 || v >= depth_.height()) return kUnknown;
  const float depth = depth_.at(u, v);
  // What is measured beyond the far limit was seen through up to there.
  return depth >= near_m_ ? 1 / double(std::min(depth, far_m_)) : kUnknown;
}

double FilledDepth::filled(int u, int v) const {
  std::array<Side, 4> sides;
  for (std::size_t s = 0; s < 4; ++s) sides[s] = look(u, v, kSteps[s].du, kSteps[s].dv);
  // Two values weighted by nearness are the line between them; lines cross on a plane.
  Mean between, continuation;
  for (std::size_t s = 0; s < 4; ++s) {
    if (!sides[s].found()) continue;
    if (sides[s ^ 1].found()) {
      between.add(sides[s].inverse, sides[s].distance_px);
    } else {
      continuation.add(continued(u, v, kSteps[s].du, kSteps[s].dv, sides[s]), sides[s].distance_px);
    }
  }
  const Mean& best = between.weights > 0 ? between : continuation;
  return best.sum / best.weights;  // NaN if there is nothing around
}

FilledDepth::Side FilledDepth::look(int u, int v, int du, int dv) const {
  const int inside = du < 0   ? u
                     : du > 0 ? depth_.width() - 1 - u
                     : dv < 0 ? v
                              : depth_.height() - 1 - v;
  const int last = std::min(reach_px_, inside);
  for (int distance = 1; distance <= last; ++distance) {
    const double inverse = measured(u + distance * du, v + distance * dv);
    if (!std::isnan(inverse)) return {distance, inverse};
  }
  return {};
}

/// The line through the measured pixel and one as far behind it; the nearer one alone if that is
/// unknown, or if the line leads away from the camera.
double FilledDepth::continued(int u, int v, int du, int dv, const Side& side) const {
  const int twice = 2 * side.distance_px;
  const double behind = measured(u + twice * du, v + twice * dv);
  return std::isnan(behind) ? side.inverse : std::max(side.inverse, 2 * side.inverse - behind);
}

}  // namespace vantage::volume::detail
