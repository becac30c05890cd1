#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "vantage/raycore/image.hpp"
#include "vantage/raycore/lens.hpp"
#include "vantage/raycore/pose.hpp"
#include "vantage/reconstruction/marker.hpp"

namespace vantage::test {

/// A white sheet in the plane z = 0 with markers and dark stripes on it, lit evenly.
struct PrintedBoard {
  std::vector<Marker> markers;  ///< in the world's frame, in the plane
  struct Stripe {
    double x0, y0, x1, y1, light;
  };
  std::vector<Stripe> stripes = {};  ///< over the markers
  double white = 0.8, black = 0.04;
  double ink_m = 0;  ///< by which the ink has run on every side
};

/// Photographs it point by point: the obvious twin of a renderer.
class BoardCamera {
 public:
  BoardCamera(const PrintedBoard& board, const Lens& lens, const Pose& T_world_cam)
      : board_(board), lens_(lens), T_world_cam_(T_world_cam) {
    for (const Marker& marker : board.markers) {
      cells_.push_back(marker_cells(marker.dictionary, marker.id, "test"));
      inverse_.push_back(marker.T_object_marker.inverse());
    }
  }

  /// 5 x 5 samples for each pixel. The codes are light to the power of 1 / gamma; 0: sRGB.
  ColorImage photograph(double gamma = 0) const {
    const Intrinsics& k = lens_.intrinsics();
    ColorImage image(k.width, k.height);
    Eigen::Vector2d guess(0, 0);
    for (int v = 0; v < k.height; ++v) {
      for (int u = 0; u < k.width; ++u) {
        if (u == 0) guess = {(u - k.cx) / k.fx, (v - k.cy) / k.fy};
        const PixelSight sight = lens_.sight(u, v, guess);
        guess = sight.xy;
        std::fill_n(image.pixel(u, v), 3, code(mean_light(sight), gamma));
      }
    }
    return image;
  }

 private:
  static std::uint8_t code(double light, double gamma) {
    const double value = gamma > 0            ? std::pow(light, 1 / gamma)
                         : light <= 0.0031308 ? 12.92 * light
                                              : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
    return std::uint8_t(std::lround(255 * std::clamp(value, 0.0, 1.0)));
  }

  double mean_light(const PixelSight& sight) const {
    double sum = 0;
    for (int i = 0; i < 25; ++i) {
      const Eigen::Vector2d away((i % 5 - 2) / 5.0, (i / 5 - 2) / 5.0);
      sum += light(sight.xy + sight.per_pixel * away) / 25;
    }
    return sum;
  }

  double light(const Eigen::Vector2d& xy) const {
    const Eigen::Vector3d along = T_world_cam_.rotation() * xy.homogeneous();
    const Eigen::Vector3d eye = T_world_cam_.translation();
    if (along.z() * eye.z() >= 0) return board_.white;
    const Eigen::Vector3d p = eye - eye.z() / along.z() * along;
    for (const auto& s : board_.stripes) {
      if (p.x() > s.x0 && p.x() < s.x1 && p.y() > s.y0 && p.y() < s.y1) return s.light;
    }
    for (std::size_t m = 0; m < cells_.size(); ++m) {
      if (is_black(m, inverse_[m] * p)) return board_.black;
    }
    return board_.white;
  }

  /// Black within reach of the ink. `p` in the marker's frame.
  bool is_black(std::size_t m, const Eigen::Vector3d& p) const {
    const double reach = board_.ink_m;
    for (const double dx : {-reach, reach}) {
      for (const double dy : {-reach, reach}) {
        if (cell_is_black(m, p.x() + dx, p.y() + dy)) return true;
        if (reach == 0) return false;
      }
    }
    return false;
  }

  bool cell_is_black(std::size_t m, double x, double y) const {
    const MarkerCells& cells = cells_[m];
    const double size = board_.markers[m].size_m;
    const double column = (x / size + 0.5) * cells.side, row = (0.5 - y / size) * cells.side;
    if (std::min(column, row) < 0 || std::max(column, row) >= cells.side) return false;
    return !cells.white[std::size_t(int(row) * cells.side + int(column))];
  }

  const PrintedBoard& board_;
  const Lens& lens_;
  Pose T_world_cam_;
  std::vector<MarkerCells> cells_;
  std::vector<Pose> inverse_;
};

/// Where a point of the world appears.
inline Eigen::Vector2d pixel_of(const Lens& lens, const Pose& T_world_cam,
                                const Eigen::Vector3d& p_world) {
  return lens.project(T_world_cam.inverse() * p_world);
}

}  // namespace vantage::test
