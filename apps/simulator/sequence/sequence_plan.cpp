#include "simulator/sequence/sequence_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

void check_stays(const SequenceObject& object) {
  if (object.type == nullptr) throw bad_input(object.name, "it has no type");
  if (object.stays.empty()) {
    throw bad_input(object.name, "it stands nowhere at any time; expected one stay or more");
  }
  double last_s = -std::numeric_limits<double>::infinity();
  for (const Stay& stay : object.stays) {
    if (std::isfinite(stay.from_s) && stay.from_s >= last_s && stay.to_s > stay.from_s) {
      last_s = stay.to_s;
      continue;
    }
    throw bad_input(object.name,
                    fmt::format("found a stay from {} s to {} s after one until {} s; expected "
                                "times that ascend",
                                stay.from_s, stay.to_s, last_s));
  }
}

std::optional<ObjectAtTime> object_at(const SequenceObject& object, std::size_t index,
                                      double time_s) {
  for (std::size_t i = 0; i < object.stays.size(); ++i) {
    const Stay& stay = object.stays[i];
    if (time_s < stay.from_s) return {};
    if (time_s < stay.to_s) return ObjectAtTime{index, stay.T_world_object, false};
    if (i + 1 == object.stays.size()) return {};
    const Stay& next = object.stays[i + 1];
    if (time_s >= next.from_s) continue;
    if (!stay.carried_visibly) return {};
    const double share = (time_s - stay.to_s) / (next.from_s - stay.to_s);
    return ObjectAtTime{index, carried_pose(stay.T_world_object, next.T_world_object, share), true};
  }
  return {};
}

}  // namespace

void SequencePlan::check() const {
  if (instants < 1)
    throw bad_input("instants", fmt::format("found {}; expected 1 or more", instants));
  if (!(period_s > 0) || !std::isfinite(period_s)) {
    throw bad_input("period_s", fmt::format("found {}; expected seconds above 0", period_s));
  }
  for (const double delay : camera_delay_s) {
    if (std::isfinite(delay)) continue;
    throw bad_input("camera_delay_s", fmt::format("found {}; expected a finite number", delay));
  }
  std::set<std::uint64_t> ids;
  for (const SequenceObject& object : objects) {
    check_stays(object);
    if (object.id == 0 || !ids.insert(object.id).second) {
      throw bad_input(object.name,
                      fmt::format("found id {}; expected one of its own, from 1", object.id));
    }
  }
}

SequenceMoment moment_at(const SequencePlan& plan, double time_s) {
  SequenceMoment moment;
  for (std::size_t i = 0; i < plan.objects.size(); ++i) {
    if (auto object = object_at(plan.objects[i], i, time_s)) moment.objects.push_back(*object);
  }
  if (plan.arm) moment.arm = plan.arm->arm.at(plan.arm->path.at(time_s));
  return moment;
}

Pose carried_pose(const Pose& from, const Pose& to, double share) {
  const double across = std::clamp((share - kLifted) / (kLowering - kLifted), 0.0, 1.0);
  Eigen::Vector3d place = from.translation() + across * (to.translation() - from.translation());
  place.z() +=
      kLiftM * std::clamp(std::min(share / kLifted, (1 - share) / (1 - kLowering)), 0.0, 1.0);
  return Pose::from_quaternion(from.quaternion().slerp(across, to.quaternion()).normalized(),
                               place);
}

}  // namespace vantage
