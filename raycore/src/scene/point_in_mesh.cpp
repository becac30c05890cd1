// Whether a point is inside of something.

#include <algorithm>
#include <utility>
#include <vector>

#include "vantage/raycore/error.hpp"
#include "vantage/raycore/scene.hpp"

namespace vantage {
namespace {

/// Not quite along the axes, as the edges of boxes are.
const Eigen::Vector3f kDirections[] = {
    {0.0131f, 0.0247f, 1}, {1, 0.0173f, 0.0291f}, {0.0263f, 1, 0.0119f}};

struct Crossings {
  bool any = false;
  std::vector<ObjectId> left;  ///< more often than entered
};

Crossings crossings_along(const Scene& scene, const Eigen::Vector3f& from,
                          const Eigen::Vector3f& direction) {
  std::vector<std::pair<ObjectId, int>> counts;  // exits less entries
  Ray ray{from, direction};
  while (const std::optional<Hit> hit = scene.closest_hit(ray)) {
    auto known = std::find_if(counts.begin(), counts.end(),
                              [&](const auto& entry) { return entry.first == hit->object; });
    if (known == counts.end()) known = counts.insert(known, {hit->object, 0});
    known->second += hit->normal.dot(direction) > 0 ? 1 : -1;
    const float size = std::max({hit->t, from.cwiseAbs().maxCoeff(), 1e-3f});
    ray.t_near = hit->t + 1e-6f * size;  // past this hit, rounding included
  }
  Crossings crossings{!counts.empty(), {}};
  for (const auto& [object, count] : counts) {
    if (count > 0) crossings.left.push_back(object);
  }
  return crossings;
}

bool share_one(const std::vector<ObjectId>& some, const std::vector<ObjectId>& others) {
  return std::find_first_of(some.begin(), some.end(), others.begin(), others.end()) != some.end();
}

}  // namespace

bool Scene::encloses(const Eigen::Vector3d& p_world) const {
  const Eigen::Vector3f point = p_world.cast<float>();
  int votes = 0;
  for (const Eigen::Vector3f& direction : kDirections) {
    const Crossings forth = crossings_along(*this, point, direction);
    if (!forth.any) return false;  // a way out into the open: certain
    const Crossings back = crossings_along(*this, point, -direction);
    if (!back.any) return false;
    votes += share_one(forth.left, back.left);
  }
  return votes >= 2;
}

}  // namespace vantage
