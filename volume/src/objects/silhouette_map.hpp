#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "grid/hierarchical_z.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/detail/box_projector.hpp"

namespace vantage::volume::detail {

/// Where, on one camera's image, the outlines of the occluders are, and how near the nearest is.
///
/// While a point moves through space without passing through a surface, whether it is hidden from
/// the camera can change only when the line of sight sweeps over an *outline edge*: one between a
/// triangle that faces the camera and one that faces away, or the border of an open surface. So if
/// no outline edge lies between the camera and a box, and no surface goes through the box, then all
/// of the box is hidden or none of it, and one ray tells which.
class ContourMap {
 public:
  explicit ContourMap(const PinholeCamera& camera);

  /// Adds an outline edge, widened by `margin_m`. May run for several edges at once; the order does
  /// not matter.
  void add_edge(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double margin_m);

  /// To be called once, after the last edge.
  void finish();

  /// Whether no outline edge can lie between the camera and any point in view of a box.
  bool clear_before(const BoxInView& box) const;

 private:
  struct ImageEdge;
  double lens_radius_m() const;
  void mark(const ImageEdge& edge);
  void mark(int column, int row, float depth);

  PinholeCamera camera_;
  Eigen::Matrix3d R_cam_world_;
  double cell_px_;
  int columns_, rows_;
  std::vector<float> nearest_;     ///< depth of the nearest outline in a cell
  std::uint8_t blocked_lens_ = 0;  ///< an outline is too close to say where
  MinPyramid pyramid_;
};

}  // namespace vantage::volume::detail
