#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "vantage/reconstruction/calibration.hpp"

namespace vantage {
namespace {

std::vector<double> coefficients_of(const Distortion& d) {
  if (d.model == LensModel::fisheye) return {d.k1, d.k2, d.k3, d.k4};
  if (d.k4 == 0 && d.k5 == 0 && d.k6 == 0) return {d.k1, d.k2, d.p1, d.p2, d.k3};
  return {d.k1, d.k2, d.p1, d.p2, d.k3, d.k4, d.k5, d.k6};
}

}  // namespace

std::string calibration_yaml(const Lens& lens) {
  const Intrinsics& k = lens.intrinsics();
  const std::vector<double> coefficients = coefficients_of(lens.distortion());
  const bool is_fisheye = lens.distortion().model == LensModel::fisheye;
  return fmt::format(
      "%YAML:1.0\n---\nimage_width: {}\nimage_height: {}\n{}"
      "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
      "   data: [ {}, 0., {}, 0., {}, {}, 0., 0., 1. ]\n"
      "distortion_coefficients: !!opencv-matrix\n   rows: {}\n   cols: 1\n   dt: d\n"
      "   data: [ {} ]\n",
      k.width, k.height, is_fisheye ? "fisheye_model: 1\n" : "", k.fx, k.cx, k.fy, k.cy,
      coefficients.size(), fmt::join(coefficients, ", "));
}

}  // namespace vantage
