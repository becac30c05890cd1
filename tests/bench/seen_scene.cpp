#include "seen_scene.hpp"

#include <cmath>
#include <numbers>

#include "reference/random_scene.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"
#include "workload.hpp"

namespace vantage::bench {
namespace {

constexpr int kWidth = 640, kHeight = 480;

PinholeCamera eye_at(double azimuth, double elevation, double distance, int shrink) {
  const Eigen::Vector3d target(0, 0, 0.03);
  const Eigen::Vector3d direction(std::cos(azimuth) * std::cos(elevation),
                                  std::sin(azimuth) * std::cos(elevation), std::sin(elevation));
  const double f = 615.0 / shrink;
  return {{kWidth / shrink, kHeight / shrink, f, f, 0.5 * kWidth / shrink, 0.5 * kHeight / shrink},
          Pose::looking_at(target + distance * direction, target)};
}

std::shared_ptr<const Scene> cubes_on_floor() {
  SceneBuilder builder;
  for (const TriangleMesh& cube : five_cubes()) builder.add_mesh(cube);
  builder.add_box(Box({-20, -20, -1}, {20, 20, 0}), Pose());
  return builder.build();
}

std::vector<float> lines(int pixels, int step) {
  std::vector<float> result;
  for (int i = 0; i < pixels; i += step) result.push_back(float(i));
  if (result.back() < float(pixels - 1)) result.push_back(float(pixels - 1));
  return result;
}

/// One of the four cameras.
PinholeCamera measuring(int i) {
  return eye_at(0.3 + i * std::numbers::pi / 2, 0.8, 0.7 + 0.05 * i, 1);
}

/// About normal, with standard deviation 1.
double noise(test::Random& random) {
  double sum = 0;
  for (int i = 0; i < 12; ++i) sum += random.uniform(-0.5, 0.5);
  return sum;
}

}  // namespace

Box seen_box() {
  return {{-0.25, -0.2, 0}, {0.25, 0.2, 0.2}};
}

std::vector<PosedDepth> seen_images() {
  const auto scene = cubes_on_floor();
  std::vector<PosedDepth> images;
  for (int i = 0; i < 4; ++i) {
    const DepthImage ideal = scene->render_depth(measuring(i));
    test::Random random(std::uint32_t(i) + 1);
    std::vector<float> depths(ideal.metres().begin(), ideal.metres().end());
    for (float& z : depths) z += 0.0016f * z * z * float(noise(random));
    images.emplace_back(measuring(i), std::make_shared<const DepthImage>(kWidth, kHeight, depths));
  }
  return images;
}

std::vector<VisibilityMesh> seen_lattices(int step) {
  const auto scene = cubes_on_floor();
  std::vector<VisibilityMesh> lattices;
  for (int i = 0; i < 4; ++i) {
    const PinholeCamera camera = measuring(i);
    const DepthImage depth = scene->render_depth(camera);
    VisibilityMesh lattice{camera, lines(kWidth, step), lines(kHeight, step), {}};
    test::Random random(std::uint32_t(i) + 1);
    for (const float row : lattice.rows) {
      for (const float column : lattice.columns) {
        const double z = double(depth.at(int(column), int(row)));
        lattice.depth.push_back(float(z + 0.0016 * z * z * noise(random)));
      }
    }
    lattices.push_back(std::move(lattice));
  }
  return lattices;
}

std::vector<PinholeCamera> seen_viewers() {
  std::vector<PinholeCamera> viewers;
  for (int i = 0; i < 40; ++i) {
    viewers.push_back(eye_at(2.4 * i, 0.3 + 0.03 * i, 0.5 + 0.1 * (i % 4), 4));
  }
  return viewers;
}

TriangleMesh visibility_mesh(const VisibilityMesh& lattice) {
  const auto width = std::uint32_t(lattice.width()), height = std::uint32_t(lattice.height());
  std::vector<Eigen::Vector3f> vertices;
  for (std::uint32_t j = 0; j < height; ++j) {
    for (std::uint32_t i = 0; i < width; ++i) {
      vertices.push_back(lattice.camera
                             .unproject(double(lattice.columns[i]), double(lattice.rows[j]),
                                        double(lattice.depth[j * width + i]))
                             .cast<float>());
    }
  }
  vertices.push_back(lattice.camera.centre().cast<float>());
  const std::uint32_t apex = width * height;
  std::vector<Triangle> triangles;
  for (std::uint32_t j = 0; j + 1 < height; ++j) {
    for (std::uint32_t i = 0; i + 1 < width; ++i) {
      const std::uint32_t a = j * width + i, b = a + 1, c = b + width, d = a + width;
      triangles.push_back({a, b, d});
      triangles.push_back({c, d, b});
    }
  }
  for (std::uint32_t i = 0; i + 1 < width; ++i) {
    const std::uint32_t below = (height - 1) * width + i;
    triangles.push_back({i + 1, i, apex});
    triangles.push_back({below, below + 1, apex});
  }
  for (std::uint32_t j = 0; j + 1 < height; ++j) {
    const std::uint32_t left = j * width, right = left + width - 1;
    triangles.push_back({left, left + width, apex});
    triangles.push_back({right + width, right, apex});
  }
  return {std::move(vertices), std::move(triangles)};
}

}  // namespace vantage::bench
