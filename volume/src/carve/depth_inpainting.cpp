#include "carve/depth_inpainting.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace vantage::detail {
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
  return depth >= near_m_ && depth <= far_m_ ? 1 / double(depth) : kUnknown;
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

}  // namespace vantage::detail
