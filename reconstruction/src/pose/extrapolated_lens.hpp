#pragma once

#include <Eigen/Core>

#include "vantage/raycore/lens.hpp"

namespace vantage::reconstruction::detail {

/// A lens that has an image, finite and continuous, for every point: a search for a pose passes
/// through poses in which points lie beyond the image's border or behind the camera. Inside the
/// image it is the lens itself. Refers to the lens. Thread-safe.
///
/// Beyond the radius of the farthest corner the distortion stays what it is there: the polynomial
/// may fold over, and would show a point at a wide angle in the middle of the image. Closer to the
/// camera's plane than a millimetre, and behind it, 1/z goes on along its tangent, so that the
/// image runs away from any pixel the farther behind a point lies. A fisheye lens goes on beyond
/// that radius by the angle off the optical axis, as it does inside, up to straight behind.
class WideLens {
 public:
  explicit WideLens(const Lens& lens) : lens_(&lens) {}

  /// @param by_point if not null, gets the derivatives by x, y and z.
  Eigen::Vector2d project(const Eigen::Vector3d& p_cam,
                          Eigen::Matrix<double, 2, 3>* by_point = nullptr) const;

 private:
  Eigen::Vector2d distort(const Eigen::Vector2d& xy, Eigen::Matrix2d* slope) const;
  Eigen::Vector2d project_beyond(const Eigen::Vector3d& p_cam,
                                 Eigen::Matrix<double, 2, 3>* by_point) const;
  Eigen::Vector2d to_pixel(const Eigen::Vector2d& xy) const;

  const Lens* lens_;
};

/// What a pixel looks at, from any pixel of the image: (x, y) on the plane z = 1.
/// @throws Error bad_input for a pixel so far beyond the border that the lens has nothing there.
Eigen::Vector2d sight_of(const Lens& lens, const Eigen::Vector2d& pixel);

/// Whether a point lies before the camera, with a millimetre to spare.
bool is_before(const Eigen::Vector3d& p_cam);

}  // namespace vantage::reconstruction::detail
