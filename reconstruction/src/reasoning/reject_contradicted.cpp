#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "reasoning/marker_scale.hpp"
#include "reasoning/solid_body.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/raycore/detail/mesh_measures.hpp"
#include "vantage/reconstruction/check_scene.hpp"

namespace vantage {
namespace {

using reconstruction::detail::Body;

constexpr std::size_t kMostCorners = 3;  ///< of a marker's four, to say that it is hidden

/// Distances below this contradict nothing: contact, and what the pose leaves open.
double slack_of(const ReconstructedObject& object) {
  constexpr double kContact_m = 0.004, kSigmas = 3;
  if (!object.covariance) return kContact_m;
  return kContact_m + kSigmas * std::sqrt(object.covariance->topLeftCorner<3, 3>().trace() / 3);
}

/// Whether the way from the eye to most of these points is blocked before they are reached.
bool is_hidden(const Scene& scene, const Eigen::Vector3d& eye,
               std::span<const Eigen::Vector3d> points, double slack_m) {
  const auto blocked = std::ranges::count_if(points, [&](const Eigen::Vector3d& point) {
    const Eigen::Vector3d way = point - eye;
    const double length = way.norm();
    if (length <= slack_m) return false;
    const Eigen::Vector3d end = eye + way * (1 - slack_m / length);
    return scene.occluded(eye.cast<float>(), end.cast<float>());
  });
  return std::size_t(blocked) >= std::min(points.size(), kMostCorners) && blocked > 0;
}

/// A camera's own housing, which it looks out of, hides nothing.
bool is_around(const KnownObject& solid, const Eigen::Vector3d& eye) {
  return raycore::detail::bounds_of(*solid.mesh).contains(solid.T_world_object.inverse() * eye);
}

std::vector<Eigen::Vector3d> feature_points(const ReconstructedObject& object,
                                            std::size_t feature) {
  std::vector<Eigen::Vector3d> points = object.type->features[feature].points();
  for (Eigen::Vector3d& point : points) point = object.T_world_object * point;
  return points;
}

/// More observations speak for it, or the same number with more probability.
bool is_firmer(const ReconstructedObject& a, const ReconstructedObject& b) {
  if (a.support.size() != b.support.size()) return a.support.size() > b.support.size();
  return a.probability > b.probability;
}

class Judge {
 public:
  Judge(std::span<const CameraView> views, const SceneKnowledge& knowledge)
      : views_(views), knowledge_(knowledge) {
    for (const KnownObject& solid : knowledge.solids) {
      SceneBuilder builder;
      builder.add_instance(solid.mesh, solid.T_world_object);
      solids_.push_back(builder.build());
    }
  }

  /// Why the object cannot be where it is said to be; empty if it can.
  std::string objection(const ReconstructedObject& object,
                        const std::vector<ReconstructedObject>& all) const {
    std::string reason = hidden_by_solid(object);
    if (reason.empty()) reason = hides_what_was_seen(object, all);
    if (reason.empty()) reason = inside_another(object, all);
    return reason;
  }

 private:
  const Eigen::Vector3d& eye(std::size_t view) const {
    return views_[view].T_world_cam->translation();
  }

  std::string hidden_by_solid(const ReconstructedObject& object) const {
    for (const Support& support : object.support) {
      const auto points = feature_points(object, support.feature);
      if (points.empty()) continue;
      for (std::size_t s = 0; s < solids_.size(); ++s) {
        if (is_around(knowledge_.solids[s], eye(support.id.view))) continue;
        if (!is_hidden(*solids_[s], eye(support.id.view), points, slack_of(object))) continue;
        return fmt::format("a {} there would be hidden from image {} by {}", object.type->name,
                           views_[support.id.view].name, knowledge_.solids[s].name);
      }
    }
    return {};
  }

  std::string hides_what_was_seen(const ReconstructedObject& object,
                                  const std::vector<ReconstructedObject>& all) const {
    const std::shared_ptr<const Scene> scene = Body(object, slack_of(object)).scene();
    if (scene == nullptr) return {};
    for (std::size_t v = 0; v < knowledge_.seen_points.size(); ++v) {
      if (!views_[v].T_world_cam) continue;
      const std::span<const Eigen::Vector3d> points = knowledge_.seen_points[v];
      for (std::size_t i = 0; i + 4 <= points.size(); i += 4) {
        if (!is_hidden(*scene, eye(v), points.subspan(i, 4), slack_of(object))) continue;
        return fmt::format("a {} there would hide a marker of the board that image {} sees",
                           object.type->name, views_[v].name);
      }
    }
    for (const ReconstructedObject& other : all) {
      if (&other == &object || !is_firmer(other, object)) continue;
      for (const Support& support : other.support) {
        const auto points = feature_points(other, support.feature);
        if (points.empty() ||
            !is_hidden(*scene, eye(support.id.view), points, slack_of(object) + slack_of(other))) {
          continue;
        }
        return fmt::format("a {} there would hide a feature of a {} that image {} sees",
                           object.type->name, other.type->name, views_[support.id.view].name);
      }
    }
    return {};
  }

  std::string inside_another(const ReconstructedObject& object,
                             const std::vector<ReconstructedObject>& all) const {
    for (const ReconstructedObject& other : all) {
      if (&other == &object || !is_firmer(other, object)) continue;
      const double slack = slack_of(object) + slack_of(other);
      if (!reconstruction::detail::overlap(object, other, slack)) continue;
      return fmt::format("a {} there would stand inside a {} that more observations support",
                         object.type->name, other.type->name);
    }
    return {};
  }

  std::span<const CameraView> views_;
  const SceneKnowledge& knowledge_;
  std::vector<std::shared_ptr<const Scene>> solids_;
};

/// Objects of the same type as one that cannot be, which another size of the type brings together
/// with it, are no more there than that one.
void spread(std::span<const CameraView> views, const Reconstruction& result,
            std::vector<std::string>& reasons) {
  std::vector<const ReconstructedObject*> all;
  for (const ReconstructedObject& object : result.objects) all.push_back(&object);
  const std::vector<std::string> found = reasons;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i].empty()) continue;
    const auto size = reconstruction::detail::fitting_size(views, all, all[i]->type);
    if (!size) continue;
    reasons[i] += size->text;
    for (std::size_t k = 0; k < found.size(); ++k) {
      const bool doubtful = found[k].empty() && all[k]->type == all[i]->type &&
                            reconstruction::detail::comes_there(views, *all[k], *size);
      if (doubtful) reasons[k] = "its sizes do not fit" + size->text;
    }
  }
}

}  // namespace

void reject_contradicted(std::span<const CameraView> views, const SceneKnowledge& knowledge,
                         Reconstruction& result) {
  const Judge judge(views, knowledge);
  std::vector<std::string> reasons;
  for (const ReconstructedObject& object : result.objects) {
    reasons.push_back(judge.objection(object, result.objects));
  }
  spread(views, result, reasons);
  std::vector<ReconstructedObject> kept;
  for (std::size_t i = 0; i < reasons.size(); ++i) {
    const ReconstructedObject& object = result.objects[i];
    if (reasons[i].empty()) kept.push_back(object);
    if (reasons[i].empty()) continue;
    for (const Support& support : object.support) {
      result.unexplained.push_back({support.id, reasons[i]});
    }
  }
  result.objects = std::move(kept);
  std::ranges::stable_sort(result.unexplained, {}, &Unexplained::id);
}

}  // namespace vantage
