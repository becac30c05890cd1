// Pictures against a slow, obvious twin's, and few samples against many.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "reference/plain_picture.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"

namespace vantage::test {
namespace {

struct RandomStage {
  std::shared_ptr<const Scene> scene;
  std::vector<Material> materials;
  PinholeCamera camera;
  PictureOptions options;
};

/// On a floor with lines that fades: turned boxes, one of them with lines, a ball and a soup.
RandomStage random_stage(std::uint32_t seed, int width, int height) {
  Random random(seed);
  SceneBuilder builder;
  std::vector<Material> materials;
  const auto add = [&](const TriangleMesh& mesh, float line_spacing_m) {
    builder.add_mesh(mesh);
    Material material;
    for (float& c : material.color) c = float(random.uniform(0.1, 0.9));
    material.line_spacing_m = line_spacing_m;
    material.line_width_m = 0.15f * line_spacing_m;
    materials.push_back(material);
  };
  add(TriangleMesh::from_box(Box({-3, -3, -0.1}, {3, 3, 0})), 0.1f);
  materials[0].fade_from_m = 1, materials[0].fade_to_m = 2.5f;
  for (int i = 0; i < 4; ++i) {
    const double x = random.uniform(0.05, 0.25), y = random.uniform(0.05, 0.25);
    const Pose place =
        Pose::from_translation({random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), 0.3});
    add(TriangleMesh::from_box(Box({-x, -y, -0.1}, {x, y, 0.2})).transformed(place),
        i == 0 ? 0.05f : 0);
    add(TriangleMesh::from_box(Box({-x, -0.02, -0.02}, {x, 0.02, 0.02}))
            .transformed(place * random.pose(0.3)),
        0);
  }
  add(icosphere(0.15, 2).transformed(Pose::from_translation({0.3, -0.3, 0.15})), 0);
  add(triangle_soup(random, 10).transformed(Pose::from_translation({0, 0, 0.5})), 0);
  const double angle = random.uniform(0, 6.28);
  const Pose from = Pose::looking_at({2 * std::cos(angle), 2 * std::sin(angle), 1.3}, {0, 0, 0.1});
  const double focal = 1.1 * width;
  return {builder.build(),
          std::move(materials),
          {{width, height, focal, focal, 0.5 * width, 0.5 * height}, from},
          {}};
}

double mean_difference(const ColorImage& a, const ColorImage& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.samples.size(); ++i) sum += std::abs(a.samples[i] - b.samples[i]);
  return sum / double(a.samples.size());
}

/// In codes, positive if `b` is brighter.
double mean_offset(const ColorImage& a, const ColorImage& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.samples.size(); ++i) sum += b.samples[i] - a.samples[i];
  return sum / double(a.samples.size());
}

ColorImage draw(const RandomStage& stage, int first_samples, int samples) {
  PictureOptions options = stage.options;
  options.first_samples = first_samples;
  options.samples_per_pixel = samples;
  return *render_picture(*stage.scene, stage.materials, stage.camera, options);
}

}  // namespace

TEST_CASE("with many samples everywhere a picture is what other samples of the twin come to") {
  const RandomStage stage = random_stage(5, 41, 31);
  const ColorImage image = draw(stage, 256, 256);
  Random random(11);
  constexpr int kPixels = 60, kCount = 400;
  double sum = 0;
  for (int i = 0; i < kPixels; ++i) {
    const int u = int(random.below(41)), v = int(random.below(31));
    CAPTURE(u);
    CAPTURE(v);
    const Eigen::Vector3d expected = plain_picture(*stage.scene, stage.materials, stage.camera,
                                                   stage.options, u, v, kCount, random);
    for (int c = 0; c < 3; ++c) {
      const double error = linear_of(image.pixel(u, v)[c] / 255.0) - std::min(1.0, expected[c]);
      sum += error;
      CHECK(std::abs(error) < 4 * 0.5 / std::sqrt(kCount));
    }
  }
  CHECK(std::abs(sum / (3 * kPixels)) < 0.01);
}

TEST_CASE("adaptive samples draw the picture that all samples everywhere do") {
  for (const std::uint32_t seed : {1u, 2u}) {
    CAPTURE(seed);
    const RandomStage stage = random_stage(seed, 160, 110);
    const ColorImage full = draw(stage, 128, 128);
    const ColorImage adaptive = draw(stage, 4, 16), draft = draw(stage, 1, 4);
    const ColorImage sparse = draw(stage, 8, 8);  // as many everywhere, and no neighbours' help
    CHECK(mean_difference(full, adaptive) < 1.3);
    CHECK(mean_difference(full, adaptive) < 0.6 * mean_difference(full, sparse));
    CHECK(std::abs(mean_offset(full, adaptive)) < 0.2);
    CHECK(mean_difference(full, draft) < 3.5);
    CHECK(std::abs(mean_offset(full, draft)) < 0.5);
  }
}

}  // namespace vantage::test
