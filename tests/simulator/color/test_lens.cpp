#include <doctest/doctest.h>

#include <opencv2/calib3d.hpp>

#include "reference/random_scene.hpp"
#include "simulator/color_scenes.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"
#include "vantage/raycore/lens.hpp"

namespace vantage::test {
namespace {

const Intrinsics kLensIntrinsics{640, 480, 615, 611, 322.3, 238.1};

const Distortion kDistortions[] = {{0.1, -0.05, 0.001, -0.002, 0.01},
                                   {-0.28, 0.09, 0, 0, 0},
                                   {0, 0, 0.01, 0.008, 0},
                                   {-0.05, 0, 0, 0, 0.2},
                                   {0.3, 0.05, 0.001, 0, 0.01, 0.35, 0.02, 0.005},
                                   Distortion::fisheye(0.08, -0.02, 0.01, -0.003),
                                   Distortion::fisheye(0, 0, 0, 0)};

/// Where OpenCV has a point of the camera's frame on the image.
cv::Point2d projected(const Eigen::Vector3d& p, const Intrinsics& k, const Distortion& d) {
  const cv::Matx33d matrix(k.fx, 0, k.cx, 0, k.fy, k.cy, 0, 0, 1);
  std::vector<cv::Point2d> result;
  if (d.model == LensModel::fisheye) {
    cv::fisheye::projectPoints(std::vector<cv::Point3d>{{p.x(), p.y(), p.z()}}, result, cv::Vec3d(),
                               cv::Vec3d(), matrix, cv::Vec4d(d.k1, d.k2, d.k3, d.k4));
    return result[0];
  }
  cv::projectPoints(std::vector<cv::Point3d>{{p.x(), p.y(), p.z()}}, cv::Vec3d(), cv::Vec3d(),
                    matrix, std::vector<double>{d.k1, d.k2, d.p1, d.p2, d.k3, d.k4, d.k5, d.k6},
                    result);
  return result[0];
}

}  // namespace

TEST_CASE("pixels look at the points that OpenCV projects onto them") {
  for (const Distortion& distortion : kDistortions) {
    const Lens lens(kLensIntrinsics, distortion);
    for (int v = 0; v < 480; v += 17) {
      Eigen::Vector2d guess = Eigen::Vector2d::Zero();
      for (int u = 0; u < 640; u += 7) {
        const PixelSight sight = lens.sight(u, v, guess);
        guess = sight.xy;
        const cv::Point2d at = projected(1.7 * sight.xy.homogeneous(), kLensIntrinsics, distortion);
        CHECK(std::abs(at.x - u) < 1e-6);
        CHECK(std::abs(at.y - v) < 1e-6);
        // The derivatives take a step of half a pixel to a thousandth of one.
        const Eigen::Vector2d moved = sight.xy + sight.per_pixel * Eigen::Vector2d(0.5, -0.5);
        const cv::Point2d beside = projected(moved.homogeneous(), kLensIntrinsics, distortion);
        CHECK(std::abs(beside.x - u - 0.5) < 1e-3);
        CHECK(std::abs(beside.y - v + 0.5) < 1e-3);
      }
    }
  }
}

TEST_CASE("a photograph has things where OpenCV projects them, with a lens and without" *
          doctest::skip(kSanitized)) {
  const Pose T_world_cam = Pose::looking_at({0, 0, 1}, {0, 0, 0});
  std::vector<Eigen::Vector3d> centres;
  std::vector<SimulatedBody> bodies = {picture_body(3, 3, ColorImage(1, 1, 255))};
  for (int i = 0; i < 12; ++i) {  // black squares of 9 pixels
    centres.push_back({0.14 * (i % 4) - 0.21, 0.15 * (i / 4) - 0.15, 0});
    bodies.push_back(
        picture_body(0.015, 0.015, ColorImage(1, 1, 0),
                     Pose::from_translation(centres.back() + Eigen::Vector3d(0, 0, 1e-5))));
  }
  const SimulatedScene scene(std::move(bodies));
  for (const Distortion& distortion :
       {Distortion{}, kDistortions[0], kDistortions[1], kDistortions[5]}) {
    ColorSensor sensor;
    sensor.distortion = distortion;
    const PinholeCamera camera(kLensIntrinsics, T_world_cam);
    const ColorImage image = *simulate_color(scene, even_light(), camera, sensor, 1);
    for (const Eigen::Vector3d& centre : centres) {
      const cv::Point2d at = projected(T_world_cam.inverse() * centre, kLensIntrinsics, distortion);
      double weight = 0, u_sum = 0, v_sum = 0;
      for (int v = int(at.y) - 12; v <= int(at.y) + 12; ++v) {
        for (int u = int(at.x) - 12; u <= int(at.x) + 12; ++u) {
          const double dark = 1 - light_of(image.pixel(u, v)[0]);
          weight += dark, u_sum += dark * u, v_sum += dark * v;
        }
      }
      CHECK(weight > 50);
      CHECK(std::abs(u_sum / weight - at.x) < 0.05);
      CHECK(std::abs(v_sum / weight - at.y) < 0.05);
    }
  }
}

TEST_CASE("lenses that fold the image over, and coefficients that are not finite, are refused") {
  const auto refused = [](const Distortion& distortion, const char* message) {
    expect_bad_input("distortion", message, [&] { Lens(kLensIntrinsics, distortion); });
    ColorSensor sensor;
    sensor.distortion = distortion;
    const SimulatedScene scene({picture_body(1, 1, ColorImage(1, 1))});
    expect_bad_input("distortion", message, [&] {
      simulate_color(scene, {}, PinholeCamera(kLensIntrinsics, {}), sensor, 1);
    });
  };
  refused({-0.6, 0, 0, 0, 0},
          "k1, k2, p1, p2, k3 to k6 = -0.6, 0, 0, 0, 0, 0, 0, 0 the image folds over");
  refused({-1.5, 0.4, 0, 0, 0}, "folds over before pixel (");  // and unfolds again farther out
  refused({0, 0, 0.5, 0, 0}, "folds over before pixel (");
  refused({0, std::nan(""), 0, 0, 0}, "a coefficient is nan; expected finite numbers");
  refused({0, 0, 0, 0, INFINITY}, "a coefficient is inf");
  // The same lens is good where the image ends before the fold.
  CHECK_NOTHROW(Lens({640, 480, 1200, 1200, 320, 240}, {-0.6, 0, 0, 0, 0}));
}

TEST_CASE("random points appear where OpenCV's fisheye lens has them, up to 85° off the axis") {
  // A lens of 180° across: the picture's corners look backwards, and have no direction.
  const Intrinsics k{800, 800, 250, 251, 398.5, 402.25};
  const Distortion d = Distortion::fisheye(-0.01, 0.004, -0.002, 0.0003);
  const Lens lens(k, d);
  CHECK_FALSE(lens.covers_image());
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const double angle = random.uniform(0, 84.9) * 0.0174533, turn = random.uniform(0, 6.28);
    const Eigen::Vector3d p(std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn),
                            std::cos(angle));
    const cv::Point2d at = projected(2.5 * p, k, d);
    const Eigen::Vector2d pixel = lens.project(2.5 * p);
    CHECK(std::abs(pixel.x() - at.x) < 1e-9);
    CHECK(std::abs(pixel.y() - at.y) < 1e-9);
    // And back, from any guess.
    const Eigen::Vector2d xy = lens.sight(at.x, at.y, {}).xy;
    CHECK((xy.homogeneous().normalized() - p).norm() < 1e-12);
  }
  expect_bad_input("distortion", "pixel (0.0, 0.0) is more than 85° off the optical axis",
                   [&] { lens.sight(0, 0, Eigen::Vector2d::Zero()); });
  ColorSensor sensor;
  sensor.distortion = d;
  const SimulatedScene scene({picture_body(1, 1, ColorImage(1, 1))});
  expect_bad_input("distortion", "more than 85° off the optical axis",
                   [&] { simulate_color(scene, {}, PinholeCamera(k, {}), sensor, 1); });
}

TEST_CASE("a fisheye lens that folds over inside the image is refused") {
  const auto refused = [](const Distortion& distortion, const char* message) {
    expect_bad_input("distortion", message, [&] {
      Lens({640, 480, 300, 300, 320, 240}, distortion);
    });
  };
  refused(Distortion::fisheye(-0.5, 0, 0, 0),
          "k1 to k4 = -0.5, 0, 0, 0 of the fisheye model the image folds over");
  refused({0, 0, 0.1, 0, 0, 0, 0, 0, LensModel::fisheye},
          "a fisheye lens has only the coefficients k1 to k4");
  // It folds farther out than this image reaches.
  CHECK_NOTHROW(Lens({640, 480, 900, 900, 320, 240}, Distortion::fisheye(-0.5, 0, 0, 0)));
}

}  // namespace vantage::test
