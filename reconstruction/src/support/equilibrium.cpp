#include "support/equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>

#include "support/linear_program.hpp"

namespace vantage::reconstruction::detail {
namespace {

// Costs of what is not there, so that it is the last resort: a torque is cheaper than a force, for
// a body that tips should be to blame rather than those that it stands on or carries.
constexpr double kMissingForce = 1000, kMissingTorque = 300;
constexpr int kNoRow = -1;
constexpr double kHeld = 1e-5;  ///< of its weight: a body that lacks less is held

/// The programme: for each body six rows, forces and torques about its centre of mass. Forces are
/// in mean weights, torques in mean weights times the mean radius.
class EquilibriumProgram {
 public:
  EquilibriumProgram(std::span<const SupportBody> bodies, std::span<const std::size_t> members,
                     const SupportOptions& options)
      : bodies_(bodies), members_(members), options_(options) {
    for (std::size_t i = 0; i < members.size(); ++i) {
      slot_of_[members[i]] = i;
      unit_force_ += bodies[members[i]].mass / double(members.size());
      unit_length_ += bodies[members[i]].radius / double(members.size());
    }
    for (std::size_t i = 0; i < members.size(); ++i) {
      for (int axis = 0; axis < 6; ++axis) {
        const double weight = axis == 2 ? weight_of(i) : 0;
        program_.add_row(weight, weight);
      }
    }
    for (std::size_t i = 0; i < members.size(); ++i) add_missing(i);
  }

  void add(const ContactPatch& patch) {
    const auto upper = slot_of(patch.upper), lower = slot_of(patch.lower);
    // Forces may attack elsewhere only as far as something presses: elsewhere on the one body or on
    // the other. The floor is everywhere.
    const bool may_shift = patch.slack_m > 0 && patch.lower < bodies_.size();
    const int budget = may_shift ? program_.add_row(-LinearProgram::kUnbounded, 0) : kNoRow;
    for (const auto& slot : {upper, lower}) {
      if (slot && may_shift) add_shifts(*slot, patch.slack_m, budget);
    }
    for (const ContactPoint& point : patch.points) add_rays(point, upper, lower, budget);
  }

  void add(const HiddenSupport& support) {
    LinearProgram::Entries entries;
    const std::size_t slot = slot_of_.at(support.body);
    add_force(slot, support.point, Eigen::Vector3d::UnitZ(), 1, entries);
    hidden_.push_back(program_.add_unknown(support.cost, entries));
  }

  Balance solve() const {
    Balance balance;
    const std::vector<double> solution = program_.solve();
    for (std::size_t i = 0; i < members_.size(); ++i) {
      double missing = 0;
      for (int k = 0; k < 12 && !solution.empty(); ++k) missing += solution[12 * i + k];
      balance.is_held.push_back(missing < kHeld * weight_of(i));
    }
    for (const int unknown : hidden_) {
      balance.hidden_loads.push_back(solution.empty() ? 0 : solution[std::size_t(unknown)]);
    }
    return balance;
  }

 private:
  double weight_of(std::size_t slot) const { return bodies_[members_[slot]].mass / unit_force_; }

  std::optional<std::size_t> slot_of(std::size_t body) const {
    const auto found = slot_of_.find(body);
    return found == slot_of_.end() ? std::nullopt : std::optional(found->second);
  }

  /// Twelve unknowns for each body, the first of all.
  void add_missing(std::size_t slot) {
    for (int axis = 0; axis < 6; ++axis) {
      for (const double sign : {1.0, -1.0}) {
        program_.add_unknown(axis < 3 ? kMissingForce : kMissingTorque,
                             {{int(6 * slot) + axis, sign}});
      }
    }
  }

  void add_force(std::size_t slot, const Eigen::Vector3d& point, const Eigen::Vector3d& force,
                 double sign, LinearProgram::Entries& entries) const {
    const Eigen::Vector3d arm = (point - bodies_[members_[slot]].centre_of_mass) / unit_length_;
    const Eigen::Vector3d torque = arm.cross(force);
    for (int axis = 0; axis < 3; ++axis) {
      entries.emplace_back(int(6 * slot) + axis, sign * force[axis]);
      entries.emplace_back(int(6 * slot) + 3 + axis, sign * torque[axis]);
    }
  }

  /// The edges of a pyramid around the friction cone.
  void add_rays(const ContactPoint& point, const std::optional<std::size_t>& upper,
                const std::optional<std::size_t>& lower, int budget) {
    const Eigen::Vector3d u = point.normal.unitOrthogonal(), v = point.normal.cross(u);
    for (const double along_u : {-1.0, 1.0}) {
      for (const double along_v : {-1.0, 1.0}) {
        const Eigen::Vector3d force =
            point.normal + options_.friction * (along_u * u + along_v * v);
        LinearProgram::Entries entries;
        if (upper) add_force(*upper, point.point, force, 1, entries);
        if (lower) add_force(*lower, point.point, force, -1, entries);
        if (budget != kNoRow) entries.emplace_back(budget, -1);
        program_.add_unknown(0, entries);
      }
    }
  }

  void add_shifts(std::size_t slot, double slack_m, int budget) {
    for (const int axis : {3, 4}) {
      for (const double sign : {1.0, -1.0}) {
        program_.add_unknown(0,
                             {{int(6 * slot) + axis, sign * slack_m / unit_length_}, {budget, 1}});
      }
    }
  }

  std::span<const SupportBody> bodies_;
  std::span<const std::size_t> members_;
  const SupportOptions& options_;
  double unit_force_ = 0, unit_length_ = 0;
  std::map<std::size_t, std::size_t> slot_of_;
  LinearProgram program_;
  std::vector<int> hidden_;
};

/// Bodies as one.
struct MassPoint {
  double mass = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();

  void add(double more, const Eigen::Vector3d& at) {
    mass += more;
    moment += more * at;
  }
  Eigen::Vector3d centre() const { return moment / mass; }
};

/// Whether a point lies over an area of contact that is horizontal: in every direction there is a
/// contact beyond it.
bool is_above(const Eigen::Vector3d& point, const ContactPatch& patch) {
  std::vector<double> angles;
  for (const ContactPoint& contact : patch.points) {
    if (contact.normal.z() < 0.999) continue;
    const Eigen::Vector3d way = contact.point - point;
    angles.push_back(std::atan2(way.y(), way.x()));
  }
  if (angles.size() < 3) return false;
  std::ranges::sort(angles);
  double widest = angles.front() + 2 * EIGEN_PI - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i) {
    widest = std::max(widest, angles[i] - angles[i - 1]);
  }
  return widest < EIGEN_PI;
}

}  // namespace

Balance balance_of(std::span<const SupportBody> bodies, std::span<const std::size_t> members,
                   std::span<const ContactPatch* const> patches,
                   std::span<const HiddenSupport> hidden, const SupportOptions& options) {
  EquilibriumProgram program(bodies, members, options);
  for (const ContactPatch* patch : patches) program.add(*patch);
  for (const HiddenSupport& support : hidden) program.add(support);
  return program.solve();
}

bool stands_as_tree(std::span<const SupportBody> bodies, std::span<const std::size_t> members,
                    std::span<const ContactPatch* const> patches) {
  // The highest first: what a body carries is known before it is looked at.
  std::vector<std::size_t> order(members.begin(), members.end());
  std::ranges::stable_sort(order, std::ranges::greater(),
                           [&](std::size_t i) { return bodies[i].bounds.center().z(); });
  std::map<std::size_t, MassPoint> carried;
  for (const std::size_t member : order) {
    const ContactPatch* below = nullptr;
    for (const ContactPatch* patch : patches) {
      if (patch->upper != member) continue;
      if (below != nullptr) return false;
      below = patch;
    }
    MassPoint all = carried[member];
    all.add(bodies[member].mass, bodies[member].centre_of_mass);
    if (below == nullptr || !is_above(all.centre(), *below)) return false;
    carried[below->lower].add(all.mass, all.centre());
  }
  return true;
}

}  // namespace vantage::reconstruction::detail
