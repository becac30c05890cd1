#include "evaluate/tracking/sequence_truth.hpp"

#include <cmath>

namespace vantage {
namespace {

/// Follows one object through a sequence.
class ObjectTruth {
 public:
  ObjectTruth(const SequenceSimulator& simulator, std::size_t object, std::size_t type,
              SequenceTruth& truth)
      : simulator_(simulator),
        object_(simulator.plan().objects[object]),
        type_(type),
        truth_(truth) {}

  /// @param seen whether a camera sees it.
  void advance(int instant, const std::optional<ObjectAtTime>& now, bool seen) {
    const Stay* stay = now && !now->carried ? stay_at(instant) : nullptr;
    if (stay != nullptr && stay != known_ && seen) arrive(*stay, instant);
    if (stay == nullptr || stay != known_) leave(instant);
    if (now) {
      add(instant, now->T_world_object, stay != nullptr && stay == known_);
    } else if (known_ != nullptr && !gone_) {
      add(instant, known_->T_world_object, false);
      look_for_end(instant);
    }
  }

 private:
  const Stay* stay_at(int instant) const {
    const double time_s = simulator_.plan().time_s(instant);
    for (const Stay& stay : object_.stays) {
      if (time_s >= stay.from_s && time_s < stay.to_s) return &stay;
    }
    return nullptr;
  }

  void arrive(const Stay& stay, int instant) {
    TrueEvent event{.kind = SceneEventKind::appeared,
                    .object = object_.id,
                    .type = type_,
                    .begin = instant,
                    .due = instant,
                    .to = stay.T_world_object};
    if (known_ != nullptr) {
      event.kind = SceneEventKind::moved;
      event.begin = has_left_ ? left_ : instant;
      event.from = known_->T_world_object;
    }
    const bool at_start = known_ == nullptr && instant == 0;
    if (!at_start) truth_.events.push_back(event);
    known_ = &stay;
    since_ = instant;
    has_left_ = false;
  }

  void leave(int instant) {
    if (known_ == nullptr || has_left_) return;
    has_left_ = true;
    left_ = instant;
  }

  /// Once it was taken away for good.
  void look_for_end(int instant) {
    const double time_s = simulator_.plan().time_s(instant);
    if (time_s < object_.stays.back().to_s) return;  // in a closed hand
    if (!simulator_.would_be_seen(instant, *object_.type, known_->T_world_object)) return;
    truth_.events.push_back({.kind = SceneEventKind::disappeared,
                             .object = object_.id,
                             .type = type_,
                             .begin = left_,
                             .due = instant,
                             .from = known_->T_world_object});
    gone_ = true;
  }

  void add(int instant, const Pose& pose, bool judged) {
    TruthAt at{
        .id = object_.id, .type = type_, .T_world_object = pose, .since = since_, .judged = judged};
    if (!judged && known_ != nullptr) at.excused.push_back(known_->T_world_object);
    truth_.frames[std::size_t(instant)].push_back(std::move(at));
  }

  const SequenceSimulator& simulator_;
  const SequenceObject& object_;
  std::size_t type_;
  SequenceTruth& truth_;
  const Stay* known_ = nullptr;  ///< where it was seen last
  int since_ = 0;
  bool has_left_ = false;
  int left_ = 0;  ///< since when it stands there no more
  bool gone_ = false;
};

}  // namespace

TypeModels::TypeModels(const KnowledgeBase& knowledge) {
  for (const TypePtr& type : knowledge.types()) {
    index[type.get()] = models.size();
    models.push_back(error_model(*type->mesh, type->symmetries));
  }
}

SequenceTruth sequence_truth(const SequenceSimulator& simulator,
                             std::span<const std::vector<bool>> seen, const TypeModels& types) {
  const SequencePlan& plan = simulator.plan();
  SequenceTruth truth;
  truth.frames.resize(seen.size());
  for (std::size_t o = 0; o < plan.objects.size(); ++o) {
    ObjectTruth object(simulator, o, types.index.at(plan.objects[o].type.get()), truth);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      std::optional<ObjectAtTime> now;
      for (const ObjectAtTime& at : moment_at(plan, plan.time_s(int(i))).objects) {
        if (at.object == o) now = at;
      }
      object.advance(int(i), now, seen[i][o]);
    }
  }
  return truth;
}

}  // namespace vantage
