#include "vantage/raycore/advanced/visibility_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

constexpr std::size_t kMaxLines = 32767;  // so that sixteen bits hold them, as Embree's grids want
constexpr float kFarthestPixel = 1e6f;

void check_lines(const std::vector<float>& lines, const char* what, std::string_view where) {
  if (lines.size() < 2 || lines.size() > kMaxLines) {
    throw bad_input(std::string(where),
                    fmt::format("it has {} {}; expected 2 to {}", lines.size(), what, kMaxLines));
  }
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!(std::abs(lines[i]) <= kFarthestPixel)) {
      throw bad_input(std::string(where),
                      fmt::format("{}[{}] is {}; expected pixel coordinates within {:g}", what, i,
                                  lines[i], kFarthestPixel));
    }
    if (i == 0 || lines[i] > lines[i - 1]) continue;
    throw bad_input(std::string(where), fmt::format("{}[{}] is {} after {}; expected them to "
                                                    "increase",
                                                    what, i, lines[i], lines[i - 1]));
  }
}

/// Where a coordinate lies among lines: in cell `index`, `fraction` of the way to its end.
struct Place {
  std::size_t index;
  double fraction;
};

std::optional<Place> find(const std::vector<float>& lines, double x) {
  if (!(x >= double(lines.front()) && x <= double(lines.back()))) return std::nullopt;
  const auto above = std::upper_bound(lines.begin() + 1, lines.end() - 1, x);
  const double low = double(above[-1]), high = double(above[0]);
  return Place{std::size_t(above - lines.begin() - 1), (x - low) / (high - low)};
}

}  // namespace

void VisibilityMesh::check(std::string_view where) const {
  check_lines(columns, "columns", where);
  check_lines(rows, "rows", where);
  if (depth.size() != width() * height()) {
    throw bad_input(std::string(where),
                    fmt::format("it has {} depths; expected {} x {} = {}", depth.size(), width(),
                                height(), width() * height()));
  }
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (std::isnan(depth[i]) || (depth[i] > 0 && std::isfinite(depth[i]))) continue;
    throw bad_input(std::string(where),
                    fmt::format("the depth at column {}, row {} is {}; expected metres above 0, or "
                                "NaN where it is unknown",
                                i % width(), i / width(), depth[i]));
  }
}

bool VisibilityMesh::has_cell(std::size_t i, std::size_t j) const {
  const float* upper = &depth[j * width() + i];
  const float* lower = upper + width();
  return !std::isnan(upper[0]) && !std::isnan(upper[1]) && !std::isnan(lower[0]) &&
         !std::isnan(lower[1]);
}

bool VisibilityMesh::sees(const Eigen::Vector3d& p_world) const {
  const std::optional<ImagePoint> pixel = camera.project(p_world);
  if (!pixel) return false;
  const std::optional<Place> column = find(columns, pixel->u), row = find(rows, pixel->v);
  if (!column || !row || !has_cell(column->index, row->index)) return false;

  const double s = column->fraction, t = row->fraction;
  const float* upper = &depth[row->index * width() + column->index];
  const float* lower = upper + width();
  const double right = 1 / double(upper[1]), left = 1 / double(lower[0]);
  double surface;
  if (s + t <= 1) {
    const double corner = 1 / double(upper[0]);
    surface = corner + s * (right - corner) + t * (left - corner);
  } else {
    const double corner = 1 / double(lower[1]);
    surface = corner + (1 - s) * (left - corner) + (1 - t) * (right - corner);
  }
  return 1 / pixel->depth > surface;
}

}  // namespace vantage
