#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "simulator/markers/marker_atlas.hpp"
#include "simulator/markers/marker_print.hpp"
#include "simulator/scene/srgb.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

using Texel = std::array<std::uint8_t, 3>;
using simulator::detail::MarkedFace;
using simulator::detail::PrintedMarker;
using simulator::detail::Region;

// Paper and printer's ink, sRGB.
constexpr std::uint8_t kWhite = 235;
constexpr std::uint8_t kBlack = 15;

void check_color(const Eigen::Vector3f& color, const std::string& where) {
  if (color.allFinite() && color.minCoeff() >= 0 && color.maxCoeff() <= 1) return;
  throw bad_input(where, fmt::format("the colour is ({}, {}, {}); expected sRGB from 0 to 1",
                                     color.x(), color.y(), color.z()));
}

void check_texel(double texel_m, const std::string& where) {
  if (std::isfinite(texel_m) && texel_m > 0) return;
  throw bad_input(where, fmt::format("texel_m is {}; expected a finite length above 0", texel_m));
}

void fill(ColorImage& texture, const Texel& texel) {
  for (std::size_t i = 0; i < texture.samples.size(); ++i) texture.samples[i] = texel[i % 3];
}

/// Calls `paint(samples, p_marker)` for each texel whose centre lies in the square around the
/// marker's centre.
template <class Paint>
void for_each_texel(ColorImage& texture, const Region& region, const PrintedMarker& marker,
                    double texel_m, double half_side, Paint&& paint) {
  const Eigen::Vector3d centre = marker.T_marker_face.inverse().translation();
  const double reach = half_side * std::numbers::sqrt2;
  const auto clip = [&](double metres, int most) {
    return int(std::clamp(std::floor(metres / texel_m), 0.0, double(most)));
  };
  const int u_end = clip(centre.x() + reach - region.left_m + texel_m, region.width);
  const int v_end = clip(region.top_m - centre.y() + reach + texel_m, region.height);
  const Eigen::Vector3d along_u = marker.T_marker_face.rotation().col(0);
  for (int v = clip(region.top_m - centre.y() - reach, region.height); v < v_end; ++v) {
    const Eigen::Vector3d row =
        marker.T_marker_face * Eigen::Vector3d(0, region.top_m - (v + 0.5) * texel_m, 0);
    for (int u = clip(centre.x() - reach - region.left_m, region.width); u < u_end; ++u) {
      const Eigen::Vector3d p_marker = row + (region.left_m + (u + 0.5) * texel_m) * along_u;
      if (std::max(std::abs(p_marker.x()), std::abs(p_marker.y())) > half_side) continue;
      paint(texture.pixel(region.u + u, region.v + v), p_marker);
    }
  }
}

void print_paper(ColorImage& texture, const Region& region, const PrintedMarker& marker,
                 double texel_m) {
  const double half_side = marker.size_m * (0.5 + 1.0 / marker.cells.side);
  for_each_texel(
      texture, region, marker, texel_m, half_side,
      [](std::uint8_t* texel, const Eigen::Vector3d&) { std::fill_n(texel, 3, kWhite); });
}

/// How much of a texel is white, 0 to 1; plain numbers, as there are millions of texels.
class Whiteness {
 public:
  Whiteness(const PrintedMarker& marker, double texel_m)
      : cells_(marker.cells),
        cells_per_m_(marker.cells.side / marker.size_m),
        texel_(texel_m * cells_per_m_),
        along_u_(step(marker, 0)),
        along_v_(step(marker, 1)) {}

  /// @param p the texel's centre in the marker's frame.
  double operator()(const Eigen::Vector3d& p) const {
    const double half = 0.5 * cells_.side;
    const double column = half + p.x() * cells_per_m_, row = half - p.y() * cells_per_m_;
    if (is_inside(column) && is_inside(row)) return is_white(column, row) ? 1 : 0;
    int white = 0;
    for (int j = 0; j < kSamples; ++j) {
      for (int i = 0; i < kSamples; ++i) {
        const double u = i - 0.5 * (kSamples - 1), v = j - 0.5 * (kSamples - 1);
        white += is_white(column + u * along_u_.x() + v * along_v_.x(),
                          row + u * along_u_.y() + v * along_v_.y());
      }
    }
    return double(white) / (kSamples * kSamples);
  }

 private:
  static constexpr int kSamples = 16;  // along each side of a texel

  /// From sample to sample along an axis of the face, in columns and rows of cells.
  Eigen::Vector2d step(const PrintedMarker& marker, int axis) const {
    const Eigen::Vector3d along = marker.T_marker_face.rotation().col(axis);
    return texel_ / kSamples * Eigen::Vector2d(along.x(), -along.y());
  }

  bool is_inside(double cells) const { return std::abs(cells - std::round(cells)) > 0.75 * texel_; }

  bool is_white(double column, double row) const {
    if (std::min(column, row) < 0 || std::max(column, row) >= cells_.side) return true;
    return cells_.white[std::size_t(int(row) * cells_.side + int(column))];
  }

  const MarkerCells& cells_;
  double cells_per_m_, texel_;  ///< a texel's side in cells
  Eigen::Vector2d along_u_, along_v_;
};

/// Texels on an edge get what they have of both sides: detectors that know the pattern find its
/// edges to a hundredth of a pixel, and with texels of one side only those are elsewhere.
void print_cells(ColorImage& texture, const Region& region, const PrintedMarker& marker,
                 double texel_m) {
  const float black = srgb_to_linear(kBlack / 255.0f), white = srgb_to_linear(kWhite / 255.0f);
  const Whiteness whiteness(marker, texel_m);
  for_each_texel(texture, region, marker, texel_m, marker.size_m / 2 + texel_m,
                 [&](std::uint8_t* texel, const Eigen::Vector3d& p) {
                   const float part = float(whiteness(p));
                   std::fill_n(texel, 3, linear_to_srgb8(black + part * (white - black)));
                 });
}

void set_uv(TexturedMesh& result, const MarkedFace& face, const Region& region, double texel_m) {
  const Pose T_face_object = face.T_object_face.inverse();
  for (const std::uint32_t t : face.triangles) {
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d p = T_face_object * result.mesh.corner(t, i).cast<double>();
      result.uv[t][std::size_t(i)] = {float(region.u + (p.x() - region.left_m) / texel_m),
                                      float(region.v + (region.top_m - p.y()) / texel_m)};
    }
  }
}

}  // namespace

TexturedMesh with_markers(const TriangleMesh& mesh, const Eigen::Vector3f& color,
                          std::span<const Marker> markers, const std::string& where,
                          double texel_m) {
  check_color(color, where);
  check_texel(texel_m, where);
  TexturedMesh result{mesh, color};
  const std::vector<MarkedFace> faces = simulator::detail::marked_faces(mesh, markers, where);
  if (faces.empty()) return result;

  std::vector<Region> regions;
  regions.reserve(faces.size() + 1);
  for (const MarkedFace& face : faces)
    regions.push_back(simulator::detail::region_for(mesh, face, texel_m));
  regions.push_back({0, 0, 3, 3});  // for all that has no marker
  result.texture = simulator::detail::lay_out(regions, where);
  const Eigen::Array3f level = (255 * color.array()).round();
  fill(result.texture, {std::uint8_t(level[0]), std::uint8_t(level[1]), std::uint8_t(level[2])});
  const Region& plain = regions.back();
  const Eigen::Vector2f nowhere(float(plain.u) + 1.5f, float(plain.v) + 1.5f);
  result.uv.assign(mesh.triangles().size(), {nowhere, nowhere, nowhere});

  for (std::size_t i = 0; i < faces.size(); ++i) {
    set_uv(result, faces[i], regions[i], texel_m);
    // All papers first: that of one must not cover the cells of another.
    for (const auto& marker : faces[i].markers) {
      print_paper(result.texture, regions[i], marker, texel_m);
    }
    for (const auto& marker : faces[i].markers) {
      print_cells(result.texture, regions[i], marker, texel_m);
    }
  }
  return result;
}

}  // namespace vantage
