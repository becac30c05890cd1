#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "simulator/marked_box.hpp"
#include "simulator/scene/srgb.hpp"
#include "simulator/texture_lookup.hpp"
#include "support/detect_markers.hpp"
#include "support/scene_count.hpp"

using namespace vantage;
using namespace vantage::test;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

std::optional<std::array<int, 3>> color_on_box(const TexturedMesh& box, const Vector3d& point,
                                               const Vector3d& normal) {
  return color_at(box, facing(box.mesh, normal), point);
}

/// What the cells say about a point in the marker's frame; nothing within a texel of a border.
std::optional<int> expected_level(const Marker& marker, const MarkerCells& cells, double x,
                                  double y) {
  const double cell = marker.size_m / cells.side;
  const double column = (x + marker.size_m / 2) / cell, row = (marker.size_m / 2 - y) / cell;
  const double clearance = 0.75 * kTexel / cell;
  for (const double c : {column, row}) {
    if (std::abs(c - std::round(c)) < clearance) return std::nullopt;
  }
  if (std::min(column, row) < -1 || std::max(column, row) > cells.side + 1) return -1;
  if (std::min(column, row) < 0 || std::max(column, row) > cells.side) return 235;
  return cells.white[std::size_t(int(row) * cells.side + int(column))] ? 235 : 15;
}

/// Looks straight down on a face, one pixel for half a millimetre, 4 x 4 samples for each, mixed as
/// light is.
ColorImage orthographic(const TexturedMesh& shape, const Pose& T_object_face, int pixels) {
  ColorImage image(pixels, pixels, 128);
  const auto triangles = facing(shape.mesh, T_object_face.rotation().col(2));
  for (int v = 0; v < pixels; ++v) {
    for (int u = 0; u < pixels; ++u) {
      double light = 0;
      for (int i = 0; i < 16; ++i) {
        const double x = 0.0005 * (u - pixels / 2 + (i % 4 - 1.5) / 4);
        const double y = -0.0005 * (v - pixels / 2 + (i / 4 - 1.5) / 4);
        const auto color = color_at(shape, triangles, T_object_face * Vector3d(x, y, 0));
        light += double(srgb_to_linear(float(color ? (*color)[0] : 60) / 255)) / 16;
      }
      std::fill_n(image.pixel(u, v), 3, linear_to_srgb8(float(light)));
    }
  }
  return image;
}

}  // namespace

TEST_CASE("a marker's cells are where its pose says, on every face and however it is turned") {
  const Vector3d size(0.06, 0.08, 0.07);
  std::mt19937 random(4);
  for (int face = 0; face < 6; ++face) {
    for (const double angle : {0.0, std::numbers::pi / 2, 0.3, -2.0}) {
      CAPTURE(face);
      CAPTURE(angle);
      const Marker marker{"5X5_100", 11 + face, 0.035,
                          face_pose(size, face, angle, {0.004, -0.003, 0})};
      const MarkerCells cells = marker_cells(marker.dictionary, marker.id, "test");
      const TexturedMesh shape = with_markers(box_solid(size), kOrange, {&marker, 1}, "test");
      REQUIRE(shape.uv.size() == 12);
      const Pose T_marker_object = marker.T_object_marker.inverse();
      int compared = 0, wrong = 0;
      for (int i = 0; i < 6000; ++i) {
        const std::size_t triangle = random() % 12;
        double a = random() / 4294967296.0, b = random() / 4294967296.0;
        if (a + b > 1) a = 1 - a, b = 1 - b;
        Vector3d point = Vector3d::Zero();
        const Vector3d weights(1 - a - b, a, b);
        for (int c = 0; c < 3; ++c) {
          point += weights[c] * shape.mesh.corner(triangle, c).cast<double>();
        }
        const Vector3d p = T_marker_object * point;
        const auto level = expected_level(marker, cells, p.x(), p.y());
        if (!level) continue;
        const bool plain = *level < 0 || std::abs(p.z()) > 1e-6;
        const auto expected = plain ? kOrangeTexel : std::array{*level, *level, *level};
        wrong += texel_at(shape, triangle, weights) != expected;
        ++compared;
      }
      CHECK(wrong == 0);
      CHECK(compared > 4000);
    }
  }
}

TEST_CASE("OpenCV finds printed markers where they are" * doctest::skip(kSanitized)) {
  const Vector3d size(0.09, 0.09, 0.09);
  for (int face = 0; face < 6; ++face) {
    CAPTURE(face);
    const double angle = 0.4 * face;
    const std::vector<Marker> markers = {
        {"6X6_250", 40 + face, 0.03, face_pose(size, face, angle, {-0.02, 0.02, 0})},
        {"6X6_250", 100 + face, 0.03, face_pose(size, face, 1.2, {0.02, -0.02, 0})}};
    const TexturedMesh shape = with_markers(box_solid(size), kOrange, markers, "test");
    const Pose T_object_view = face_pose(size, face, 0);
    const auto found = detect_markers(orthographic(shape, T_object_view, 200), "6X6_250");
    REQUIRE(found.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
      CHECK(found[i].id == markers[i].id);
      const auto corners = markers[i].corners();
      for (std::size_t c = 0; c < 4; ++c) {
        const Vector3d p = T_object_view.inverse() * corners[c] / 0.0005;
        CHECK((found[i].corners[c] - Eigen::Vector2d(100 + p.x(), 100 - p.y())).norm() < 0.2);
      }
    }
  }
}

TEST_CASE("a marker as large as its face has no white around it, and one at the edge has some") {
  const Vector3d size(0.05, 0.05, 0.05);
  const Marker whole{"4X4_50", 7, 0.05, face_pose(size, 4, 0)};
  const TexturedMesh full = with_markers(box_solid(size), kOrange, {&whole, 1}, "test");
  const std::array<int, 3> black = {15, 15, 15}, white = {235, 235, 235};
  CHECK(color_on_box(full, {0.0249, 0.0249, 0.025}, {0, 0, 1}) == black);
  CHECK(color_on_box(full, {0.025, 0.01, 0.025}, {0, 0, 1}) == black);  // on the very edge
  CHECK(color_on_box(full, {0.025, 0.0249, 0.0249}, {1, 0, 0}) == kOrangeTexel);

  const Marker aside{"4X4_50", 7, 0.03, face_pose(size, 4, 0, {0.008, 0, 0})};
  const TexturedMesh edge = with_markers(box_solid(size), kOrange, {&aside, 1}, "test");
  CHECK(color_on_box(edge, {0.0249, 0, 0.025}, {0, 0, 1}) == white);
  CHECK(color_on_box(edge, {-0.0115, 0, 0.025}, {0, 0, 1}) ==
        white);  // half a cell from the border
  CHECK(color_on_box(edge, {-0.0125, 0, 0.025}, {0, 0, 1}) == kOrangeTexel);
}

TEST_CASE("the paper of a marker does not cover the cells of its neighbour") {
  const Vector3d size(0.1, 0.05, 0.01);
  const std::vector<Marker> markers = {{"4X4_50", 1, 0.03, face_pose(size, 4, 0, {-0.016, 0, 0})},
                                       {"4X4_50", 2, 0.03, face_pose(size, 4, 0, {0.016, 0, 0})}};
  const TexturedMesh shape = with_markers(box_solid(size), kOrange, markers, "test");
  const std::array<int, 3> black = {15, 15, 15}, white = {235, 235, 235};
  CHECK(color_on_box(shape, {-0.0015, 0.01, 0.005}, {0, 0, 1}) == black);
  CHECK(color_on_box(shape, {0.0015, 0.01, 0.005}, {0, 0, 1}) == black);
  CHECK(color_on_box(shape, {0, 0.01, 0.005}, {0, 0, 1}) == white);
}

TEST_CASE("a board of half a metre takes 2000 x 1400 texels, and a few around them") {
  const Vector3d size(0.5, 0.35, 0.01);
  std::vector<Marker> markers;
  for (int i = 0; i < 10; ++i) {
    markers.push_back({"6X6_250", i, 0.04, face_pose(size, 4, 0, {0.05 * (i - 4.5), 0.15, 0})});
  }
  const TexturedMesh board = with_markers(box_solid(size), kOrange, markers, "test");
  CHECK(board.texture.width >= 2000);
  CHECK(board.texture.width <= 2010);
  CHECK(board.texture.height >= 1400);
  CHECK(board.texture.height <= 1410);
}

TEST_CASE("regions of several faces do not overlap") {
  const Vector3d size(0.05, 0.04, 0.03);
  std::vector<Marker> markers;
  for (int face = 0; face < 6; ++face) {
    markers.push_back({"4X4_50", face, 0.02, face_pose(size, face, 0.5 * face)});
  }
  const TexturedMesh all = with_markers(box_solid(size), kOrange, markers, "test");
  for (const Marker& marker : markers) {
    CAPTURE(marker.id);
    const TexturedMesh one = with_markers(box_solid(size), kOrange, {&marker, 1}, "test");
    const auto triangles = facing(all.mesh, marker.T_object_marker.rotation().col(2));
    int different = 0;
    for (int i = 0; i < 1600; ++i) {
      const Vector3d p = marker.T_object_marker *
                         Vector3d(0.00147 * (i % 40 - 19.5), 0.00147 * (i / 40 - 19.5), 0);
      different += color_at(all, triangles, p) != color_at(one, triangles, p);
    }
    CHECK(different == 0);
  }
}

TEST_CASE("a face whose triangles repeat their vertices is one face") {
  const TriangleMesh box = box_solid({0.05, 0.05, 0.05});
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Triangle> triangles;
  for (std::size_t t = 0; t < box.triangles().size(); ++t) {
    for (int i = 0; i < 3; ++i) vertices.push_back(box.corner(t, i));
    const std::uint32_t first = std::uint32_t(3 * t);
    triangles.push_back({first, first + 1, first + 2});
  }
  const Marker marker{"4X4_50", 3, 0.03, face_pose({0.05, 0.05, 0.05}, 0, 0.2)};
  const TexturedMesh soup =
      with_markers(TriangleMesh(vertices, triangles), kOrange, {&marker, 1}, "test");
  const TexturedMesh welded = with_markers(box, kOrange, {&marker, 1}, "test");
  CHECK(soup.texture == welded.texture);
  CHECK(soup.uv == welded.uv);
}

TEST_CASE("without markers there is no texture") {
  const TexturedMesh shape = with_markers(box_solid({1, 1, 1}), kOrange, {}, "test");
  CHECK_FALSE(shape.textured());
  CHECK(shape.texture.samples.empty());
  CHECK(shape.color == kOrange);
}
