#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <span>
#include <vector>

#include "render/sample_patterns.hpp"
#include "render/srgb_table.hpp"
#include "render/surface_look.hpp"
#include "vantage/raycore/advanced/picture.hpp"

namespace vantage::raycore::detail {

/// The directions of a camera's pixels, depth 1.
class PixelFan {
 public:
  explicit PixelFan(const PinholeCamera& camera) {
    const Intrinsics& k = camera.intrinsics();
    const Eigen::Matrix3d& R = camera.T_world_cam().rotation();
    per_u_ = R.col(0) / k.fx;
    per_v_ = R.col(1) / k.fy;
    first_ = R.col(2) - k.cx * per_u_ - k.cy * per_v_;
  }

  Eigen::Vector3f at(int u, int v) const {
    return (first_ + u * per_u_ + v * per_v_).cast<float>();
  }
  Eigen::Vector3f per_u() const { return per_u_.cast<float>(); }
  Eigen::Vector3f per_v() const { return per_v_.cast<float>(); }

 private:
  Eigen::Vector3d first_, per_u_, per_v_;
};

/// What all tiles of a picture share: everything that is computed once.
struct PictureSetup {
  const Scene& scene;
  PinholeCamera camera;
  Eigen::Vector3f eye;
  PixelFan fan;
  float pixel_width;  ///< at depth 1
  float sky_reach_m;
  Eigen::Vector3f to_sun;      ///< unit length
  Eigen::Vector3f background;  ///< linear
  SamplePatterns first, all;   ///< the samples of every pixel; those of a pixel that takes all
  SamplePatterns lines;        ///< where a pixel's own plane is asked for lines
  bool adaptive;
  std::vector<SurfaceLook> looks;
  SrgbTable srgb = {};

  PictureSetup(const Scene& the_scene, std::span<const Material> materials,
               const PinholeCamera& the_camera, const PictureOptions& options)
      : scene(the_scene),
        camera(the_camera),
        eye(camera.centre().cast<float>()),
        fan(camera),
        pixel_width(float(1 / std::min(camera.intrinsics().fx, camera.intrinsics().fy))),
        sky_reach_m(options.sky_reach_m),
        to_sun(options.to_sun.normalized()),
        background(to_linear(options.background)),
        first(std::min(options.first_samples, options.samples_per_pixel), options),
        all(options.samples_per_pixel, options),
        lines(16, options),
        adaptive(options.first_samples < options.samples_per_pixel),
        looks(materials.begin(), materials.end()) {}
};

}  // namespace vantage::raycore::detail
