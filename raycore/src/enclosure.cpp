// Whether a point is inside of something.

#include <algorithm>
#include <utility>
#include <vector>

#include "vantage/raycore/error.hpp"
#include "vantage/raycore/scene.hpp"

namespace vantage {
namespace {

/// Not along any axis: boxes' edges are.
const Eigen::Vector3f kUp(0.0131f, 0.0247f, 1);

/// For each object that a ray meets, how often it leaves it, less how often it enters it.
using Crossings = std::vector<std::pair<ObjectId, int>>;

Crossings crossings_along(const Scene& scene, const Eigen::Vector3f& from,
                          const Eigen::Vector3f& direction) {
  Crossings crossings;
  Ray ray{from, direction};
  while (const std::optional<Hit> hit = scene.closest_hit(ray)) {
    auto known = std::find_if(crossings.begin(), crossings.end(),
                              [&](const auto& entry) { return entry.first == hit->object; });
    if (known == crossings.end()) known = crossings.insert(known, {hit->object, 0});
    known->second += hit->normal.dot(direction) > 0 ? 1 : -1;
    const float size = std::max({hit->t, from.cwiseAbs().maxCoeff(), 1e-3f});
    ray.t_near = hit->t + 1e-6f * size;  // past this hit, rounding included
  }
  return crossings;
}

}  // namespace

bool Scene::encloses(const Eigen::Vector3d& p_world) const {
  const Eigen::Vector3f point = p_world.cast<float>();
  const Crossings up = crossings_along(*this, point, kUp);
  if (up.empty()) return false;
  const Crossings down = crossings_along(*this, point, -kUp);
  return std::any_of(up.begin(), up.end(), [&](const auto& above) {
    return above.second != 0 && std::any_of(down.begin(), down.end(), [&](const auto& below) {
             return below.first == above.first && below.second != 0;
           });
  });
}

}  // namespace vantage
