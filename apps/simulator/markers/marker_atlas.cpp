#include "simulator/markers/marker_atlas.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "vantage/raycore/error.hpp"

namespace vantage::simulator::detail {
namespace {

constexpr int kMaxSide = 16384;
constexpr double kMaxTexels = 1 << 27;

}  // namespace

Region region_for(const TriangleMesh& mesh, const MarkedFace& face, double texel_m) {
  const Pose T_face_object = face.T_object_face.inverse();
  Eigen::AlignedBox2d bounds;
  for (const std::uint32_t t : face.triangles) {
    for (int i = 0; i < 3; ++i) {
      bounds.extend(Eigen::Vector2d((T_face_object * mesh.corner(t, i).cast<double>()).head<2>()));
    }
  }
  const PrintedMarker& first = face.markers.front();
  const Eigen::Vector2d anchor(-first.size_m / 2, first.size_m / 2);
  const Eigen::Vector2d upper_left(bounds.min().x(), bounds.max().y());
  const Eigen::Array2d before = ((anchor - upper_left).array().abs() / texel_m).ceil() + 1;
  const Eigen::Vector2d origin = anchor + texel_m * Eigen::Vector2d(-before.x(), before.y());
  const Eigen::Vector2d span(bounds.max().x() - origin.x(), origin.y() - bounds.min().y());
  const Eigen::Array2d size = (span.array() / texel_m).ceil() + 1;
  if (size.maxCoeff() > kMaxSide) {
    throw bad_input(
        first.place,
        fmt::format("its face takes {:.0f} x {:.0f} texels of {} m; expected {} along a "
                    "side at most: make the texels larger",
                    size.x(), size.y(), texel_m, kMaxSide));
  }
  return {0, 0, int(size.x()), int(size.y()), origin.x(), origin.y()};
}

ColorImage lay_out(std::vector<Region>& regions, const std::string& where) {
  double texels = 0;
  int line = 0;
  for (const Region& r : regions) {
    texels += double(r.width) * r.height;
    line = std::max(line, r.width);
  }
  line = std::max(line, int(std::ceil(std::sqrt(std::min(texels, kMaxTexels)))));
  int u = 0, v = 0, row_height = 0, width = 0;
  for (Region& r : regions) {
    if (u + r.width > line) {
      v += row_height;
      u = row_height = 0;
    }
    r.u = u;
    r.v = v;
    u += r.width;
    width = std::max(width, u);
    row_height = std::max(row_height, r.height);
    if (double(width) * (double(v) + row_height) > kMaxTexels) {
      throw bad_input(where,
                      fmt::format("the texture takes more than {:.0f} texels; expected fewer "
                                  "or larger ones",
                                  kMaxTexels));
    }
  }
  return {width, v + row_height};
}

}  // namespace vantage::simulator::detail
