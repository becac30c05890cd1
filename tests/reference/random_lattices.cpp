#include "reference/random_lattices.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vantage::test {
namespace {

std::vector<float> random_lines(Random& random, int pixels) {
  std::vector<float> lines{float(random.below(3))};
  const bool even = random.below(2) == 0;
  const auto step = float(4 + random.below(12));
  while (lines.back() < float(pixels - 1)) {
    lines.push_back(lines.back() + (even ? step : float(random.uniform(0.05, 12))));
  }
  return lines;
}

/// Depths of a plane with waves on it, or with spikes.
void measure(Random& random, double distance, VisibilityMesh& lattice) {
  const double mean = distance * random.uniform(0.6, 1.2);
  const double wave = random.below(3) == 0 ? 0 : random.uniform(0, 0.3) * mean;
  const double spike = random.below(2) == 0 ? 0 : random.uniform(0, 0.4) * mean;
  const double holes = random.below(3) == 0 ? random.uniform(0, 0.5) : 0;
  const double wavelength = random.uniform(1, 8);
  for (std::size_t j = 0; j < lattice.height(); ++j) {
    for (std::size_t i = 0; i < lattice.width(); ++i) {
      const double z = mean + wave * std::sin(double(i) / wavelength) * std::cos(double(j)) +
                       random.uniform(-spike, spike);
      const bool unknown = random.uniform(0, 1) < holes;
      lattice.depth.push_back(unknown ? std::numeric_limits<float>::quiet_NaN() : float(z));
    }
  }
}

VisibilityMesh random_lattice(Random& random) {
  const double distance = random.uniform(0.2, 1.5);
  const Eigen::Vector3d target = random.in_cube(random.below(6) == 0 ? 3 : 0.2);
  const Eigen::Vector3d eye = target + distance * random.direction();
  const int width = 20 + int(random.below(60)), height = 20 + int(random.below(40));
  VisibilityMesh lattice{
      {{width, height, random.uniform(30, 90), random.uniform(30, 90), 0.5 * width, 0.4 * height},
       Pose::looking_at(eye, target)},
      random_lines(random, width),
      random_lines(random, height),
      {}};
  measure(random, distance, lattice);
  return lattice;
}

Box random_lattice_box(Random& random) {
  const Eigen::Vector3d half(random.uniform(0.1, 0.4), random.uniform(0.1, 0.4),
                             random.uniform(0.1, 0.4));
  const Eigen::Vector3d centre = random.in_cube(0.1);
  return {centre - half, centre + half};
}

}  // namespace

RandomLattices random_lattices(std::uint32_t seed) {
  Random random(seed);
  RandomLattices scene{random_lattice_box(random), {}};
  for (std::uint32_t i = 0, count = random.below(7); i < count; ++i) {
    scene.lattices.push_back(random_lattice(random));
    VisibilityMesh& last = scene.lattices.back();
    const std::uint32_t kind = random.below(8);
    if (kind == 0) scene.lattices.push_back(last);
    if (kind == 1) std::fill(last.depth.begin(), last.depth.end(), std::nanf(""));
  }
  return scene;
}

PinholeCamera random_viewer(Random& random, const RandomLattices& scene, ViewerPlace place) {
  const Eigen::Vector3d target = random.in_cube(0.2);
  const bool is_near = place == ViewerPlace::inside;
  const double distance = is_near ? random.uniform(0.01, 0.3) : random.uniform(0.6, 2);
  const double focal = is_near ? random.uniform(15, 40) : random.uniform(40, 90);
  const Intrinsics k{
      16 + int(random.below(20)),       12 + int(random.below(20)), focal,
      random.uniform(0.7, 1.3) * focal, random.uniform(5, 15),      random.uniform(5, 15)};
  const DepthRange range{0.01, random.below(4) == 0 ? random.uniform(0.3, 1.5) : 10};
  const Pose pose = Pose::looking_at(target + distance * random.direction(), target);
  if (place == ViewerPlace::outside || is_near || scene.lattices.empty()) return {k, pose, range};
  const auto chosen = random.below(std::uint32_t(scene.lattices.size()));
  const PinholeCamera& camera = scene.lattices[chosen].camera;
  if (place == ViewerPlace::lattice_camera) {
    return {camera.intrinsics(), camera.T_world_cam(), range};
  }
  return {k, Pose::from_rotation(pose.rotation(), camera.centre()), range};
}

}  // namespace vantage::test
