#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <vector>

#include "reference/plain_stereo.hpp"
#include "reference/random_boxes.hpp"
#include "simulator/depth/depth_sensor.hpp"
#include "support/expect_error.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/volume/advanced/classify.hpp"

namespace vantage {
namespace {

constexpr Intrinsics kCamera{640, 480, 615, 615, 319.5, 239.5};
constexpr DepthRange kRange{0.1, 5.0};

std::shared_ptr<const Scene> scene_of(const TriangleMesh& mesh) {
  SceneBuilder builder;
  builder.add_mesh(mesh);
  return builder.build();
}

/// A wall that faces a camera in the origin, which looks along z.
std::shared_ptr<const Scene> wall_at(double z) {
  return scene_of(TriangleMesh::from_box(Box({-9, -9, z}, {9, 9, z + 0.1})));
}

PinholeCamera camera_at(const Eigen::Vector3d& place) {
  return PinholeCamera(kCamera, Pose::from_translation(place), kRange);
}

/// A ball whose corners lie on the sphere: rings of latitude, fine enough to be off by 1e-6 m.
TriangleMesh ball(double radius, int rings) {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Triangle> triangles;
  const int around = 2 * rings;
  for (int i = 0; i <= rings; ++i) {
    for (int j = 0; j < around; ++j) {
      const double a = std::numbers::pi * i / rings, b = 2 * std::numbers::pi * j / around;
      vertices.push_back((radius * Eigen::Vector3d(std::sin(a) * std::cos(b),
                                                   std::sin(a) * std::sin(b), std::cos(a)))
                             .cast<float>());
      if (i == rings) continue;
      const auto at = [&](int di, int dj) {
        return std::uint32_t((i + di) * around + (j + dj) % around);
      };
      triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
      triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
    }
  }
  return TriangleMesh(vertices, triangles);
}

/// Mean and standard deviation of the errors of a sensor that looks at a wall, and how many there
/// are.
struct Errors {
  double mean = 0, deviation = 0;
  std::size_t known = 0;
  std::vector<double> of_sigma;  ///< each error as a multiple of `sigma`
};

Errors errors_at(double z, const StereoSensor& sensor, double sigma) {
  const DepthImage depth = simulate_depth(*wall_at(z), camera_at({0, 0, 0}), sensor, 7);
  Errors errors;
  double sum = 0, squares = 0;
  for (const float d : depth.metres()) {
    if (std::isnan(d)) continue;
    const double error = double(d) - z;
    sum += error, squares += error * error;
    errors.of_sigma.push_back(error / sigma);
  }
  errors.known = errors.of_sigma.size();
  errors.mean = sum / double(errors.known);
  errors.deviation = std::sqrt(squares / double(errors.known) - errors.mean * errors.mean);
  return errors;
}

bool same_bits(const DepthImage& a, const DepthImage& b) {
  return std::memcmp(a.metres().data(), b.metres().data(), a.metres().size_bytes()) == 0;
}

}  // namespace

TEST_CASE("an ideal sensor measures planes, boxes and a ball to 1e-5 m") {
  const StereoSensor ideal = StereoSensor::ideal();
  SUBCASE("a slanted plane") {
    // The plane n · p = c through a box's face.
    const Pose turn = Pose::from_rotation(
        Eigen::AngleAxisd(0.6, Eigen::Vector3d(0.8, 0.6, 0)).toRotationMatrix(), {0, 0, 1.2});
    const auto scene =
        scene_of(TriangleMesh::from_box(Box({-9, -9, 0}, {9, 9, 0.1})).transformed(turn));
    const Eigen::Vector3d n = turn.rotation().col(2);
    const double c = n.dot(turn.translation());
    const PinholeCamera camera = camera_at({0, 0, 0});
    const DepthImage depth = simulate_depth(*scene, camera, ideal, 0);
    for (int v = 0; v < 480; v += 7) {
      for (int u = 0; u < 640; u += 7) {
        const double expected = c / n.dot(camera.pixel_ray(u, v).direction);
        REQUIRE(std::fabs(double(depth.at(u, v)) - expected) < 1e-5);
      }
    }
  }
  SUBCASE("a box from a corner") {
    const PinholeCamera camera(kCamera, Pose::looking_at({0.3, -0.4, 0.35}, {0, 0, 0}), kRange);
    const Box box({-0.05, -0.04, -0.03}, {0.05, 0.04, 0.03});
    const DepthImage depth =
        simulate_depth(*scene_of(TriangleMesh::from_box(box)), camera, ideal, 0);
    std::size_t known = 0;
    for (int v = 0; v < 480; ++v) {
      for (int u = 0; u < 640; ++u) {
        const PixelRay ray = camera.pixel_ray(u, v);
        const Eigen::Array3d a = (box.min() - ray.origin).array() / ray.direction.array();
        const Eigen::Array3d b = (box.max() - ray.origin).array() / ray.direction.array();
        const double enter = a.min(b).maxCoeff(), leave = a.max(b).minCoeff();
        if (std::fabs(enter - leave) < 1e-6) continue;  // along an edge
        REQUIRE(std::isnan(depth.at(u, v)) == (enter > leave));
        if (enter > leave) continue;
        ++known;
        REQUIRE(std::fabs(double(depth.at(u, v)) - enter) < 1e-5);
      }
    }
    CHECK(known > 10000);
  }
  SUBCASE("a ball") {
    const double radius = 0.1;
    const PinholeCamera camera = camera_at({0.02, -0.01, -0.6});
    const DepthImage depth = simulate_depth(*scene_of(ball(radius, 500)), camera, ideal, 0);
    std::size_t known = 0;
    for (int v = 0; v < 480; ++v) {
      for (int u = 0; u < 640; ++u) {
        const PixelRay ray = camera.pixel_ray(u, v);
        const double dd = ray.direction.squaredNorm(), od = ray.origin.dot(ray.direction);
        const double root = od * od - dd * (ray.origin.squaredNorm() - radius * radius);
        // Within 20° of the silhouette a facet's sagitta is seen enlarged.
        if (root < dd * std::pow(radius * std::sin(20 * std::numbers::pi / 180), 2)) continue;
        ++known;
        REQUIRE(std::fabs(double(depth.at(u, v)) - (-od - std::sqrt(root)) / dd) < 1e-5);
      }
    }
    CHECK(known > 20000);
  }
}

TEST_CASE("the noise has the stated deviation at 0.5, 1 and 2 m, and is normal") {
  StereoSensor sensor;
  sensor.border_px = 0;
  for (const double z : {0.5, 1.0, 2.0}) {
    CAPTURE(z);
    const double sigma = sensor.noise.sigma_m(z);
    sensor.disparity_step_px = 0;
    const Errors smooth = errors_at(z, sensor, sigma);
    CHECK(smooth.known > 250000);
    CHECK(smooth.deviation / sigma == doctest::Approx(1).epsilon(0.01));
    CHECK(std::fabs(smooth.mean) < 0.02 * sigma);
    double beyond2 = 0, beyond3 = 0, beyond4 = 0;
    for (const double e : smooth.of_sigma) {
      beyond2 += std::fabs(e) > 2, beyond3 += std::fabs(e) > 3, beyond4 += std::fabs(e) > 4;
    }
    // A normal variable is beyond 2, 3 and 4 deviations with these chances; depth is a little skew.
    const double n = double(smooth.known);
    CHECK(beyond2 / n == doctest::Approx(0.0455).epsilon(0.05));
    CHECK(beyond3 / n == doctest::Approx(0.0027).epsilon(0.2));
    CHECK(beyond4 / n > 1e-5);
    CHECK(beyond4 / n < 2e-4);

    sensor.disparity_step_px = 1.0 / 32;  // adds 1/32/√12 px: 0.6 %
    CHECK(errors_at(z, sensor, sigma).deviation / sigma == doctest::Approx(1.006).epsilon(0.01));
  }
}

TEST_CASE("neighbouring pixels' noise is not related") {
  StereoSensor sensor;
  sensor.disparity_step_px = 0;
  const DepthImage depth = simulate_depth(*wall_at(1), camera_at({0, 0, 0}), sensor, 3);
  for (const auto& [du, dv] :
       {std::pair(1, 0), std::pair(0, 1), std::pair(1, 1), std::pair(4, 0)}) {
    double product = 0, square = 0;
    for (int v = 100; v < 400; ++v) {
      for (int u = 100; u < 600; ++u) {
        const double a = double(depth.at(u, v)) - 1, b = double(depth.at(u + du, v + dv)) - 1;
        product += a * b, square += a * a;
      }
    }
    CHECK(std::fabs(product / square) < 0.012);  // 150,000 pairs: 4.6 deviations of chance
  }
}

TEST_CASE("disparities are whole steps") {
  StereoSensor sensor;
  sensor.disparity_step_px = 0.25;
  const DepthImage depth = simulate_depth(*wall_at(1.3), camera_at({0, 0, 0}), sensor, 1);
  std::size_t known = 0;
  for (const float z : depth.metres()) {
    if (std::isnan(z)) continue;
    ++known;
    const double steps = sensor.noise.focal_px * sensor.noise.baseline_m / double(z) / 0.25;
    REQUIRE(std::fabs(steps - std::round(steps)) < 1e-4);
  }
  CHECK(known > 250000);
}

// Zivid's occlusion calculator: a camera with a baseline of 111.83 mm, 1,000 mm above the wall
// between two bins of 600 mm depth, midway over it, loses 33.5 mm of either floor at the foot of
// the wall.
TEST_CASE("the baseline casts the shadow that others publish: 33.5 mm in a bin of 600 mm") {
  const double baseline = 0.11183, above = 1.0, deep = 0.6;
  SceneBuilder builder;  // along the camera's axis, z down
  builder.add_box(Box({-2, -2, above + deep}, {2, 2, above + deep + 0.1}));
  builder.add_box(Box({-1e-5, -2, above}, {1e-5, 2, above + deep}));
  const auto scene = builder.build();

  StereoSensor sensor = StereoSensor::ideal();
  sensor.noise.baseline_m = baseline;
  // A fine row of pixels across the wall: 0.2 mm each on the floor.
  const Intrinsics fine{2000, 3, 8000, 8000, 720, 1};
  const PinholeCamera camera(fine, Pose::from_translation({-baseline / 2, 0, 0}), kRange);
  const DepthImage first = simulate_depth(*scene, camera, sensor, 0);
  sensor.second_imager = true;
  const DepthImage both = simulate_depth(*scene, camera, sensor, 0);
  double least = 1, most = -1;
  for (int u = 0; u < fine.width; ++u) {
    const bool on_floor = std::fabs(double(first.at(u, 1)) - (above + deep)) < 1e-5;
    if (!on_floor || !std::isnan(both.at(u, 1))) continue;
    const double x = camera.unproject(u, 1, above + deep).x();
    if (x < -0.08) continue;  // the band that the second image does not cover
    least = std::min(least, x), most = std::max(most, x);
  }
  const double pixel = (above + deep) / fine.fx;
  CHECK(std::fabs(-least - 0.0335) < 0.00005 + pixel);
  CHECK(std::fabs(most) < 2 * pixel);
}

TEST_CASE("the projector's shadow of a post is a hole where similar triangles say") {
  SceneBuilder builder;
  builder.add_box(Box({-9, -9, 1}, {9, 9, 1.1}));
  builder.add_box(Box({-0.005, -9, 0.5}, {0.005, 9, 0.5001}));
  const auto scene = builder.build();
  StereoSensor sensor = StereoSensor::ideal();
  sensor.projector = true;
  sensor.projector_m = 0.08;
  const PinholeCamera camera = camera_at({0, 0, 0});
  const DepthImage depth = simulate_depth(*scene, camera, sensor, 0);
  // On the wall: 0.08 + 2 (±0.005 - 0.08).
  std::size_t holes = 0;
  for (int u = 0; u < kCamera.width; ++u) {
    const double x = camera.unproject(u, 240, 1).x();
    if (std::fabs(x + 0.09) < 0.001 || std::fabs(x + 0.07) < 0.001) continue;
    CAPTURE(x);
    const bool shadow = x > -0.09 && x < -0.07;
    CHECK(std::isnan(depth.at(u, 240)) == shadow);
    holes += shadow;
  }
  CHECK(holes >= 10);
}

TEST_CASE("what is too slanted, too near, at the border or beyond the second image is a hole") {
  const PinholeCamera camera = camera_at({0, 0, 0});
  StereoSensor sensor = StereoSensor::ideal();
  const auto known = [&](double z, int u, int v) {
    return !std::isnan(simulate_depth(*wall_at(z), camera, sensor, 0).at(u, v));
  };
  SUBCASE("border") {
    sensor.border_px = 5;
    CHECK_FALSE(known(1, 4, 200));
    CHECK(known(1, 5, 200));
    CHECK_FALSE(known(1, 635, 200));
    CHECK(known(1, 634, 5));
    CHECK_FALSE(known(1, 634, 4));
    CHECK_FALSE(known(1, 634, 475));
  }
  SUBCASE("the second imager's image begins 615 · 0.05 / 1 = 30.75 pixels further right") {
    sensor.second_imager = true;
    CHECK_FALSE(known(1, 30, 200));
    CHECK(known(1, 31, 200));
  }
  SUBCASE("a disparity of 424 · 0.05 / 0.17 = 124.7 is found, of 126.9 at 0.167 m not") {
    sensor.max_disparity_px = 126;
    CHECK(known(0.17, 320, 240));
    CHECK_FALSE(known(0.167, 320, 240));
  }
  SUBCASE("incidence: a wall's corner is atan(hypot(319.5, 239.5) / 615) = 33.0° off its normal") {
    sensor.max_incidence_rad = 32.9 * std::numbers::pi / 180;
    CHECK_FALSE(known(1, 0, 0));
    sensor.max_incidence_rad = 33.1 * std::numbers::pi / 180;
    CHECK(known(1, 0, 0));
  }
}

TEST_CASE("flying pixels float between the two sides of a jump, and nowhere else") {
  SceneBuilder builder;
  builder.add_box(Box({-9, -9, 1.5}, {9, 9, 1.6}));
  builder.add_box(Box({-0.1, -9, 1}, {0.1, 9, 1.1}));
  const auto scene = builder.build();
  StereoSensor sensor = StereoSensor::ideal();
  const PinholeCamera camera = camera_at({0.0003, 0, 0});
  const DepthImage exact = simulate_depth(*scene, camera, sensor, 5);
  sensor.flying_pixels = 0.5;
  const DepthImage flying = simulate_depth(*scene, camera, sensor, 5);
  std::size_t moved = 0, edge = 0;
  for (int v = 0; v < 480; ++v) {
    for (int u = 1; u < 639; ++u) {
      const bool beside_jump = std::fabs(exact.at(u - 1, v) - exact.at(u + 1, v)) > 0.1f;
      edge += beside_jump;
      if (flying.at(u, v) == exact.at(u, v)) continue;
      ++moved;
      REQUIRE(beside_jump);
      REQUIRE(flying.at(u, v) > 1.0f);
      REQUIRE(flying.at(u, v) < 1.5f);
    }
  }
  CHECK(edge == 4 * 480);
  CHECK(double(moved) / double(edge) == doctest::Approx(0.5).epsilon(0.1));
}

TEST_CASE("the stereo view equals that of single rays") {
  std::size_t compared = 0, different = 0, holes = 0;
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    const test::BoxWorld boxes = test::random_boxes(seed);
    const auto scene = known_scene(boxes.model());
    StereoSensor sensor = StereoSensor::ideal();
    sensor.second_imager = sensor.projector = true;
    sensor.projector_m = -0.06;  // between the imagers, its shadow would mostly be theirs
    sensor.max_incidence_rad = 1.2;
    sensor.border_px = 2;
    const test::PlainStereo plain{sensor.noise.baseline_m, sensor.projector_m, 1.2, 2};
    const Intrinsics small{163, 121, 150, 150, 81, 60};
    const PinholeCamera camera(small, boxes.cameras.front().T_world_cam(), kRange);
    const DepthImage fast = simulate_depth(*scene, camera, sensor, 0);
    const DepthImage slow = plain.see(*scene, camera);
    for (std::size_t i = 0; i < fast.metres().size(); ++i) {
      const float a = fast.metres()[i], b = slow.metres()[i];
      ++compared, holes += std::isnan(b);
      // A ray along an edge may go either way in the last bit.
      if (std::isnan(a) != std::isnan(b)) ++different;
      if (!std::isnan(a) && !std::isnan(b)) different += std::fabs(a - b) > 1e-6f * b + 1e-6f;
    }
  }
  CHECK(holes > compared / 20);
  CHECK(holes < compared - compared / 20);
  CHECK(different * 5000 < compared);
}

TEST_CASE("a seed gives the same depth image at any number of threads") {
  SceneBuilder builder;
  builder.add_box(Box({-9, -9, 1.5}, {9, 9, 1.6}));
  builder.add_box(Box({-0.1, -0.2, 1}, {0.1, 0.3, 1.1}));
  const auto scene = builder.build();
  StereoSensor sensor;
  sensor.flying_pixels = 0.3;
  const auto image = [&](int threads, std::uint64_t seed) {
    tbb::task_arena arena(threads);
    return arena.execute([&] {
      return simulate_depth(*scene, camera_at({0, 0, 0}), sensor, seed);
    });
  };
  const DepthImage one = image(1, 11);
  for (const int threads : {2, 3, 8}) CHECK(same_bits(image(threads, 11), one));
  CHECK_FALSE(same_bits(image(1, 12), one));
}

TEST_CASE("a sensor that cannot be is refused by the name of its field") {
  const auto refused = [](const char* field, auto&& change) {
    StereoSensor sensor;
    change(sensor);
    test::expect_bad_input(std::string("cell.yaml.") + field, "expected",
                           [&] { sensor.check("cell.yaml"); });
  };
  refused("noise.baseline_m", [](StereoSensor& s) { s.noise.baseline_m = 0; });
  refused("noise.focal_px", [](StereoSensor& s) { s.noise.focal_px = -1; });
  refused("noise.subpixel_px", [](StereoSensor& s) { s.noise.subpixel_px = std::nan(""); });
  refused("disparity_step_px", [](StereoSensor& s) { s.disparity_step_px = 1e-9; });
  refused("max_disparity_px", [](StereoSensor& s) { s.max_disparity_px = -1; });
  refused("projector_m", [](StereoSensor& s) { s.projector_m = INFINITY; });
  refused("max_incidence_rad", [](StereoSensor& s) { s.max_incidence_rad = 2; });
  refused("border_px", [](StereoSensor& s) { s.border_px = -1; });
  refused("flying_pixels", [](StereoSensor& s) { s.flying_pixels = 1.5; });
}

}  // namespace vantage
