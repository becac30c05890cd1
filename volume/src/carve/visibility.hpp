#pragma once

#include <optional>

#include "vantage/raycore/depth_image.hpp"

namespace vantage::volume::detail {

/// The inverse depths of a depth image, with holes that are filled from around them (thesis 7.4.2).
/// Immutable; the image must outlive it.
class FilledDepth {
 public:
  /// @param reach_px how far from a measured pixel a hole is filled; 0: not at all.
  FilledDepth(const PosedDepth& image, int reach_px);

  /// 1 / depth of a pixel; NaN where it is neither measured nor filled.
  double inverse(int u, int v) const;

 private:
  /// The nearest measured pixel in one of the four directions.
  struct Side {
    int distance_px = 0;  ///< 0: there is none
    double inverse = 0;

    bool found() const { return distance_px > 0; }
  };
  /// A mean of values weighted by how near they were found.
  struct Mean {
    double sum = 0, weights = 0;

    void add(double value, int distance_px) {
      sum += value / distance_px;
      weights += 1.0 / distance_px;
    }
  };

  double measured(int u, int v) const;
  double filled(int u, int v) const;
  Side look(int u, int v, int du, int dv) const;
  double continued(int u, int v, int du, int dv, const Side& side) const;

  const DepthImage& depth_;
  float near_m_, far_m_;
  int reach_px_;
};

}  // namespace vantage::volume::detail
