#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "reasoning/evidence_conflicts.hpp"
#include "reasoning/evidence_features.hpp"
#include "reasoning/marker_scale.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/raycore/detail/mesh_measures.hpp"
#include "vantage/reconstruction/check_scene.hpp"

namespace vantage {
namespace {

using namespace reconstruction::detail;

constexpr double kMinDepth = -8, kMaxDepth = 4;  ///< depth may belong to another time, or fail
constexpr double kWrongSize = -40;
constexpr int kRounds = 3;

/// Weighs the objects of one reconstruction.
class Weigher {
 public:
  Weigher(std::span<const CameraView> views, const SceneKnowledge& knowledge,
          const EvidenceKinds& kinds, std::span<const ReconstructedObject> objects)
      : views_(views),
        knowledge_(knowledge),
        kinds_(kinds),
        objects_(objects),
        conflicts_(views, knowledge, objects),
        beside_(depth_beside(views, knowledge.depth)),
        evidence_(objects.size()),
        reasons_(objects.size()),
        alive_(objects.size(), true) {
    for (std::size_t v = 0; v < views.size(); ++v) {
      looked_.push_back(v < knowledge.seen_points.size() && !knowledge.seen_points[v].empty());
    }
  }

  void weigh() {
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      evidence_[i].seen_features = log_odds_of_seen(objects_[i], views_);
      if (kinds_.structures) weigh_structures(i);
      if (kinds_.depth) weigh_depth(i);
    }
    drop_contradicted();
    for (int round = 0; round < kRounds; ++round) {
      if (kinds_.missing_features) weigh_missing();
      if (kinds_.other_objects) weigh_exclusions();
      if (!drop_contradicted()) break;
    }
  }

  const std::vector<Evidence>& evidence() const { return evidence_; }
  /// Why each object cannot be there; empty if it can.
  std::vector<std::string> reasons() const {
    std::vector<std::string> reasons;
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      reasons.push_back(alive_[i] ? std::string() : reason_against(i));
    }
    return reasons;
  }
  /// Whether geometry alone contradicts it: it is often its size that is wrong.
  bool is_out_of_place(std::size_t i) const {
    const Evidence& e = evidence_[i];
    return e.hidden_by_structure + e.hides_board + e.other_objects < e.missing_features + e.depth;
  }

 private:
  void weigh_structures(std::size_t i) {
    const Contradiction hidden = conflicts_.hidden_by_solid(i);
    const Contradiction hides = conflicts_.hides_board(i);
    const Contradiction inside = conflicts_.inside_solid(i);
    evidence_[i].hidden_by_structure = hidden.log_ratio;
    evidence_[i].hides_board = hides.log_ratio;
    evidence_[i].inside_structure = inside.log_ratio;
    for (const Contradiction& one : {hidden, hides, inside}) {
      if (reasons_[i].empty()) reasons_[i] = one.reason;
    }
  }

  void weigh_depth(std::size_t i) {
    const ReconstructedObject& object = objects_[i];
    const auto [known, is_new] = surfaces_.try_emplace(object.type.get());
    if (is_new) known->second = surface_points(*object.type->mesh);
    const double slack_m = slack_of(object);
    double sum = log_ratio_at_features(object, beside_, slack_m);
    Evidence& e = evidence_[i];
    for (const DepthCamera& camera : knowledge_.depth) {
      if (!camera.depth) continue;
      const DepthAtObject shown = depth_at(camera, known->second, object.T_world_object, slack_m);
      sum += log_ratio_of(shown);
      e.depth_on_surface += shown.at;
      e.depth_behind += shown.through;
      e.depth_in_front += shown.hidden;
    }
    e.depth = std::clamp(sum, kMinDepth, kMaxDepth);
  }

  void weigh_missing() {
    SceneBuilder builder;
    for (const KnownObject& solid : knowledge_.solids) {
      if (!holds_a_camera(solid)) builder.add_instance(solid.mesh, solid.T_world_object);
    }
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      if (alive_[i]) builder.add_instance(objects_[i].type->mesh, objects_[i].T_world_object);
    }
    const auto scene = builder.build();
    const Presence presence(views_, knowledge_.depth, *scene);
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      if (!alive_[i]) continue;
      const MissingFeatures missing = missing_features(objects_[i], views_, presence, looked_);
      evidence_[i].missing_features = missing.log_ratio;
      evidence_[i].features_missing = missing.count;
    }
  }

  bool holds_a_camera(const KnownObject& solid) const {
    const Eigen::AlignedBox3d bounds = raycore::detail::bounds_of(*solid.mesh);
    return std::ranges::any_of(views_, [&](const CameraView& view) {
      return view.T_world_cam &&
             bounds.contains(solid.T_world_object.inverse() * view.T_world_cam->translation());
    });
  }

  /// Of objects that exclude each other at most one is there: the odds of the others stand against
  /// each of them. The likeliest are decided first; what they exclude is no argument any more, and
  /// can make them doubtful, but not unlikely.
  void weigh_exclusions() {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      if (!alive_[i]) continue;
      evidence_[i].other_objects = 0;
      order.push_back(i);
    }
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
      return evidence_[a].log_odds() > evidence_[b].log_odds();
    });
    std::vector<double> log_odds(objects_.size());
    for (const std::size_t i : order) log_odds[i] = evidence_[i].log_odds();
    for (std::size_t k = 0; k < order.size(); ++k) {
      const std::size_t i = order[k];
      double odds = 0, weaker_odds = 0;
      for (std::size_t m = 0; m < order.size(); ++m) {
        const std::size_t other = order[m];
        const bool decided_against = m < k && evidence_[other].log_odds() < 0;
        if (other == i || decided_against) continue;
        const std::string reason = conflicts_.exclusion(i, other);
        if (reason.empty()) continue;
        if (odds + weaker_odds == 0) exclusions_[i] = reason;
        (m < k ? odds : weaker_odds) += std::exp(log_odds[other]);
      }
      odds += std::min(weaker_odds, 0.5 * std::exp(log_odds[i]));
      evidence_[i].other_objects = -std::log1p(odds);
    }
  }

  /// @returns whether there were any.
  bool drop_contradicted() {
    bool any = false;
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      const bool contradicted = alive_[i] && evidence_[i].log_odds() < 0;
      if (contradicted) alive_[i] = false;
      any = any || contradicted;
    }
    return any;
  }

  /// The term that says most against it.
  std::string reason_against(std::size_t i) const {
    const Evidence& e = evidence_[i];
    const std::string& type = objects_[i].type->name;
    const double structure = e.hidden_by_structure + e.hides_board + e.inside_structure;
    const double least = std::min({structure, e.other_objects, e.depth, e.missing_features});
    if (least >= 0 || e.seen_features < least) {
      return fmt::format("the {} that single cameras see are not at one pose", type);
    }
    if (least == structure) return reasons_[i];
    if (least == e.other_objects) return exclusions_.at(i);
    if (least == e.depth) {
      return fmt::format(
          "depth images see something else where a {} would be: {} points of its "
          "surface are measured there, {} behind it",
          type, e.depth_on_surface, e.depth_behind);
    }
    return fmt::format(
        "other features of a {} there should be seen, but are not: its id is more "
        "likely misread",
        type);
  }

  std::span<const CameraView> views_;
  const SceneKnowledge& knowledge_;
  const EvidenceKinds& kinds_;
  std::span<const ReconstructedObject> objects_;
  Conflicts conflicts_;
  std::vector<std::vector<const DepthCamera*>> beside_;
  std::vector<bool> looked_;  ///< of each view: for markers
  std::vector<Evidence> evidence_;
  std::vector<std::string> reasons_;  ///< by structures and the board
  std::map<std::size_t, std::string> exclusions_;
  std::vector<bool> alive_;
  std::map<const ObjectType*, std::vector<SurfacePoint>> surfaces_;
};

/// Objects of the same type as one that cannot be, which another size of the type brings together
/// with it, are no more there than that one.
void spread(std::span<const CameraView> views, const Weigher& weigher, Reconstruction& result,
            std::vector<std::string>& reasons) {
  std::vector<const ReconstructedObject*> all;
  for (const ReconstructedObject& object : result.objects) all.push_back(&object);
  const std::vector<std::string> found = reasons;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i].empty() || !weigher.is_out_of_place(i)) continue;
    const auto size = fitting_size(views, all, all[i]->type);
    if (!size) continue;
    reasons[i] += size->text;
    for (std::size_t k = 0; k < found.size(); ++k) {
      const bool doubtful =
          found[k].empty() && all[k]->type == all[i]->type && comes_there(views, *all[k], *size);
      if (!doubtful) continue;
      reasons[k] = "its sizes do not fit" + size->text;
      result.objects[k].evidence->wrong_size = kWrongSize;
    }
  }
}

/// The evidence decides whether the object is there; of the ways to explain its features each keeps
/// its share.
void set_probability(ReconstructedObject& object) {
  double sum = object.probability;
  for (const Alternative& other : object.alternatives) sum += other.probability;
  const double factor = sum > 0 ? 1 / (1 + std::exp(-object.evidence->log_odds())) / sum : 0;
  object.probability *= factor;
  for (Alternative& other : object.alternatives) other.probability *= factor;
}

}  // namespace

double Evidence::log_odds() const {
  return seen_features + missing_features + depth + hidden_by_structure + inside_structure +
         hides_board + other_objects + wrong_size;
}

void reject_contradicted(std::span<const CameraView> views, const SceneKnowledge& knowledge,
                         Reconstruction& result, const EvidenceKinds& kinds) {
  Weigher weigher(views, knowledge, kinds, result.objects);
  weigher.weigh();
  for (std::size_t i = 0; i < result.objects.size(); ++i) {
    result.objects[i].evidence = weigher.evidence()[i];
  }
  std::vector<std::string> reasons = weigher.reasons();
  spread(views, weigher, result, reasons);
  std::vector<ReconstructedObject> kept;
  for (std::size_t i = 0; i < reasons.size(); ++i) {
    ReconstructedObject& object = result.objects[i];
    set_probability(object);
    if (reasons[i].empty()) {
      kept.push_back(std::move(object));
      continue;
    }
    for (const Support& support : object.support) {
      result.unexplained.push_back({support.id, reasons[i]});
    }
    result.rejected.push_back({std::move(object), reasons[i]});
  }
  result.objects = std::move(kept);
  std::ranges::stable_sort(result.unexplained, {}, &Unexplained::id);
}

}  // namespace vantage
