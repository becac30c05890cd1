#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "support/equilibrium.hpp"
#include "support/hidden_supports.hpp"
#include "support/support_steps.hpp"
#include "vantage/reconstruction/support.hpp"

namespace vantage {
namespace {

using reconstruction::detail::Balance;
using reconstruction::detail::balance_of;
using reconstruction::detail::contact_scene;
using reconstruction::detail::contact_slack;
using reconstruction::detail::ContactPatch;
using reconstruction::detail::ContactPoint;
using reconstruction::detail::ContactScene;
using reconstruction::detail::hidden_places;
using reconstruction::detail::HiddenPlace;
using reconstruction::detail::HiddenSupport;
using reconstruction::detail::region_under;
using reconstruction::detail::stands_as_tree;
using reconstruction::detail::SupportBody;

constexpr double kPushesUp = 0.1;         ///< z of the force's direction
constexpr double kCarries = 1e-4;         ///< of a body's weight: a load that counts
constexpr double kKeptProbability = 0.1;  ///< of an object that cannot stand

/// Bodies that hold or push each other, apart from all that stands for certain.
struct Stack {
  std::vector<std::size_t> members;
  std::vector<const ContactPatch*> patches;
  bool is_grounded = false;  ///< touches something that stands for certain
};

class SupportJudge {
 public:
  SupportJudge(std::size_t count, const ContactScene& scene, const SpaceProbe& space,
               const SupportOptions& options)
      : count_(count),
        bodies_(scene.bodies),
        patches_(scene.patches),
        space_(space),
        options_(options) {}

  std::vector<ObjectSupport> judge() {
    result_.resize(count_);
    for (std::size_t i = 0; i < count_; ++i) result_[i].supported_by = supporters_of(i);
    for (const Stack& stack : stacks()) judge(stack);
    for (std::size_t i = 0; i < count_; ++i) {
      if (bodies_[i].mass == 0) {
        result_[i] = {.verdict = SupportVerdict::unjudged,
                      .supported_by = result_[i].supported_by,
                      .reason = "its mesh is open, and its centre of mass unknown"};
      } else {
        look_for_sinking(i);
      }
    }
    return std::move(result_);
  }

 private:
  bool can_fall(std::size_t body) const { return body < count_ && bodies_[body].mass > 0; }

  Supporter supporter(std::size_t body) const {
    if (body == bodies_.size()) return {SupporterKind::floor, 0};
    if (body >= count_) return {SupporterKind::structure, body - count_};
    return {SupporterKind::object, body};
  }

  /// What pushes it up.
  std::vector<Supporter> supporters_of(std::size_t object) const {
    std::vector<Supporter> supporters;
    for (const ContactPatch& patch : patches_) {
      if (patch.upper != object && patch.lower != object) continue;
      const double sign = patch.upper == object ? 1 : -1;
      const bool pushes = std::ranges::any_of(patch.points, [&](const ContactPoint& point) {
        return sign * point.normal.z() > kPushesUp;
      });
      if (pushes) supporters.push_back(supporter(sign > 0 ? patch.lower : patch.upper));
    }
    return supporters;
  }

  std::vector<Stack> stacks() const {
    std::vector<std::size_t> root(count_);
    std::iota(root.begin(), root.end(), std::size_t(0));
    const auto find = [&](std::size_t i) {
      while (root[i] != i) i = root[i];
      return i;
    };
    for (const ContactPatch& patch : patches_) {
      if (!can_fall(patch.upper) || !can_fall(patch.lower)) continue;
      const std::size_t a = find(patch.upper), b = find(patch.lower);
      root[std::max(a, b)] = std::min(a, b);
    }
    std::vector<Stack> stacks(count_);
    for (std::size_t i = 0; i < count_; ++i) {
      if (can_fall(i)) stacks[find(i)].members.push_back(i);
    }
    for (const ContactPatch& patch : patches_) {
      const bool upper_falls = can_fall(patch.upper);
      if (!upper_falls && !can_fall(patch.lower)) continue;
      Stack& stack = stacks[find(upper_falls ? patch.upper : patch.lower)];
      stack.patches.push_back(&patch);
      stack.is_grounded |= !upper_falls || !can_fall(patch.lower);
    }
    std::erase_if(stacks, [](const Stack& stack) { return stack.members.empty(); });
    return stacks;
  }

  void judge(const Stack& stack) {
    if (stands_as_tree(bodies_, stack.members, stack.patches)) return;
    if (stack.is_grounded) {
      const Balance balance = balance_of(bodies_, stack.members, stack.patches, {}, options_);
      if (std::ranges::all_of(balance.is_held, [](bool held) { return held; })) return;
    }
    find_hidden_support(stack);
  }

  void find_hidden_support(const Stack& stack) {
    std::vector<HiddenPlace> places;
    for (const std::size_t member : stack.members) {
      const auto more = hidden_places(bodies_, member, space_, options_);
      places.insert(places.end(), more.begin(), more.end());
    }
    std::vector<HiddenSupport> supports;
    for (const HiddenPlace& place : places) supports.push_back(place.support);
    const Balance balance = balance_of(bodies_, stack.members, stack.patches, supports, options_);
    const bool all_held = std::ranges::all_of(balance.is_held, [](bool held) { return held; });
    for (std::size_t i = 0; i < stack.members.size(); ++i) {
      const std::size_t member = stack.members[i];
      if (!stack.is_grounded && !all_held) {
        say_floats(member);
      } else if (!balance.is_held[i]) {
        result_[member].verdict = SupportVerdict::tips;
        result_[member].reason = "what it touches cannot hold it: it would tip over or slide";
      } else {
        say_hidden(member, places, balance.hidden_loads);
      }
    }
  }

  void say_floats(std::size_t member) {
    ObjectSupport& support = result_[member];
    support.verdict = SupportVerdict::floats;
    support.reason = support.supported_by.empty()
                         ? "it touches nothing that could hold it"
                         : "neither it nor what holds it touches anything that stands";
    if (options_.floor_z_m && support.supported_by.empty()) {
      support.reason += fmt::format(": its lowest point is {:.0f} mm above the floor",
                                    1e3 * (bodies_[member].bounds.min().z() - *options_.floor_z_m));
    }
    support.reason += ", and cameras see that the space below is empty";
  }

  /// Of a body that is held, if something that is not known takes part in it.
  void say_hidden(std::size_t member, std::span<const HiddenPlace> places,
                  std::span<const double> loads) {
    std::vector<HiddenPlace> own;
    double unseen = 0, measured = 0;
    for (std::size_t p = 0; p < places.size(); ++p) {
      if (places[p].support.body != member) continue;
      own.push_back(places[p]);
      (places[p].state == SpaceState::occupied ? measured : unseen) += loads[p];
    }
    if (unseen + measured < kCarries) return;
    ObjectSupport& support = result_[member];
    support.verdict = SupportVerdict::unseen;
    support.unseen_region = region_under(own, bodies_[member], options_);
    const bool is_measured = measured > unseen;
    support.supported_by.push_back(
        {is_measured ? SupporterKind::measured : SupporterKind::unseen, 0});
    support.reason = is_measured ? "nothing known holds it; cameras measure a surface below it"
                                 : "nothing known holds it; what does has to be below it, unseen";
  }

  /// Something below the floor's level may be there to carry it: beside a board, say.
  void look_for_sinking(std::size_t object) {
    if (!options_.floor_z_m) return;
    for (const Supporter& supporter : result_[object].supported_by) {
      if (supporter.kind == SupporterKind::structure) return;
    }
    const SupportBody& body = bodies_[object];
    double deepest_m = 0;
    for (const Eigen::Vector3d& p : body.vertices) {
      const double below = *options_.floor_z_m - p.z();
      if (below <= deepest_m) continue;
      const auto up = Eigen::Vector3d::UnitZ();
      if (below > contact_slack(body, nullptr, p, up, options_)) deepest_m = below;
    }
    if (deepest_m == 0) return;
    result_[object].verdict = SupportVerdict::sinks;
    result_[object].reason = fmt::format("it reaches {:.0f} mm into the floor", 1e3 * deepest_m);
  }

  std::size_t count_;
  std::span<const SupportBody> bodies_;
  std::span<const ContactPatch> patches_;
  const SpaceProbe& space_;
  const SupportOptions& options_;
  std::vector<ObjectSupport> result_;
};

}  // namespace

std::vector<ObjectSupport> reconstruction::detail::judge(std::size_t count,
                                                         const ContactScene& scene,
                                                         const SpaceProbe& space,
                                                         const SupportOptions& options) {
  return SupportJudge(count, scene, space, options).judge();
}

std::vector<ObjectSupport> judge_support(std::span<const ReconstructedObject> objects,
                                         std::span<const KnownObject> structures,
                                         const SpaceProbe& space, const SupportOptions& options) {
  const ContactScene scene = contact_scene(objects, structures, options);
  return SupportJudge(objects.size(), scene, space, options).judge();
}

void lower_unsupported(std::span<const ObjectSupport> support,
                       std::span<ReconstructedObject> objects) {
  for (std::size_t i = 0; i < support.size(); ++i) {
    const SupportVerdict verdict = support[i].verdict;
    const bool cannot_stand = verdict == SupportVerdict::floats ||
                              verdict == SupportVerdict::tips || verdict == SupportVerdict::sinks;
    if (!cannot_stand) continue;
    objects[i].probability *= kKeptProbability;
    if (objects[i].warning.empty()) {
      objects[i].warning = "it cannot be at rest there: " + support[i].reason;
    }
  }
}

}  // namespace vantage
