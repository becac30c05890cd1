#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/export.hpp"

namespace vantage {

/// How a lens bends what it sees.
enum class LensModel {
  brown_conrady,  ///< OpenCV's usual model, with its rational extension ("plumb bob", "radtan")
  fisheye,        ///< OpenCV's cv::fisheye, Kannala and Brandt's ("equidistant")
};

/// Lens distortion in OpenCV's form. Brown–Conrady has all eight coefficients in OpenCV's order; k4
/// to k6 are the rational model's. A fisheye lens has k1 to k4, and the others are zero.
struct Distortion {
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0, k4 = 0, k5 = 0, k6 = 0;
  LensModel model = LensModel::brown_conrady;

  static Distortion fisheye(double k1, double k2, double k3, double k4) {
    return {k1, k2, 0, 0, k3, k4, 0, 0, LensModel::fisheye};
  }
  /// Whether images are those of a pinhole.
  bool none() const { return *this == Distortion{}; }
  bool operator==(const Distortion&) const = default;
};

/// What a pixel of a distorted image looks at: the direction (x, y, 1) in the camera's frame.
struct PixelSight {
  Eigen::Vector2d xy;
  Eigen::Matrix2d per_pixel;  ///< its derivatives by (u, v)
};

/// Distortion and its inverse, which has no closed form. Immutable; thread-safe.
class VANTAGE_API Lens {
 public:
  /// Follows the lines from the principal point to the image's border, which every pixel lies on or
  /// beside, and looks whether the image folds over. What a fisheye lens shows more than
  /// `kMaxFisheyeAngle` off the optical axis is left out.
  /// @throws Error bad_input for coefficients that are not finite or not of the model, or with
  /// which a pixel is seen from no direction or from several; `where` is the place.
  Lens(const Intrinsics& intrinsics, const Distortion& distortion,
       std::string_view where = "distortion");

  const Intrinsics& intrinsics() const noexcept { return k_; }
  const Distortion& distortion() const noexcept { return d_; }

  /// Radians. The plane z = 1 has no place for what lies at a right angle to the optical axis.
  static constexpr double kMaxFisheyeAngle = 85 * 0.017453292519943295;

  /// Whether every pixel has a direction: false where a fisheye image reaches beyond
  /// `kMaxFisheyeAngle`.
  bool covers_image() const noexcept { return covers_image_; }

  /// How far from the optical axis the image shows anything, on the plane z = 1. Beyond, nothing is
  /// known of the lens: the polynomial may fold over.
  double reach() const noexcept { return reach_; }

  /// Where on the plane z = 1 the point appears that is at `xy` without the lens (OpenCV's
  /// "Camera Calibration and 3D Reconstruction", the formula of x'' and y''; "Fisheye camera
  /// model", the formula of x' and y').
  Eigen::Vector2d distort(const Eigen::Vector2d& xy) const;

  /// The derivatives of `distort` by x and y.
  Eigen::Matrix2d slope(const Eigen::Vector2d& xy) const;

  /// The pixel on which a point with z > 0 of the camera's frame appears. Beyond the image's border
  /// it may be anywhere: a polynomial promises nothing there.
  Eigen::Vector2d project(const Eigen::Vector3d& p_cam) const;

  /// The inverse, by Newton's method from a guess (a neighbour's xy) to 1e-12.
  /// @throws Error bad_input if it does not get there, as for what a fisheye lens shows beyond
  /// `kMaxFisheyeAngle`.
  PixelSight sight(double u, double v, const Eigen::Vector2d& guess) const;

 private:
  bool undistort(const Eigen::Vector2d& distorted, Eigen::Vector2d& xy) const;
  void check_coefficients() const;
  void look_at_border();
  void follow_line_to(double u, double v);
  void find_fisheye_reach_at(double u, double v, double max_angle);

  Intrinsics k_;
  Distortion d_;
  std::string where_;
  double reach_ = 0;
  bool covers_image_ = true;
};

}  // namespace vantage
