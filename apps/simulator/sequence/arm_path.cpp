#include "simulator/sequence/arm_path.hpp"

#include <algorithm>
#include <cmath>

#include "simulator/scene/sample_hash.hpp"

namespace vantage {
namespace {

constexpr double kBesideM = 0.3, kShoulderM = 0.35;  // from the floor's edge, and above it
constexpr double kApproach = 2, kPass = 7;           // instants
constexpr double kHoldM = 0.005;

/// One move that the arm makes.
struct Carry {
  double begin_s = 0, end_s = 0;
  Pose from, to;
  double top_m = 0;  ///< of the object above its origin, at most
};

double reach_of_mesh(const TriangleMesh& mesh) {
  double reach = 0;
  for (const Eigen::Vector3f& vertex : mesh.vertices())
    reach = std::max(reach, double(vertex.norm()));
  return reach;
}

std::vector<Carry> carries_of(const SequencePlan& plan) {
  std::vector<Carry> carries;
  for (const SequenceObject& object : plan.objects) {
    for (std::size_t i = 0; i + 1 < object.stays.size(); ++i) {
      const Stay &from = object.stays[i], &to = object.stays[i + 1];
      carries.push_back({from.to_s, to.from_s, from.T_world_object, to.T_world_object,
                         reach_of_mesh(*object.type->mesh) + kHoldM});
    }
  }
  std::ranges::sort(carries, {}, &Carry::begin_s);
  return carries;
}

class PathBuilder {
 public:
  PathBuilder(const Box& floor, double period_s, std::uint64_t seed)
      : floor_(floor), period_s_(period_s), seed_(seed) {}

  Eigen::Vector3d shoulder() const {
    return {floor_.max().x() + kBesideM, floor_.centre().y(), floor_.min().z() + kShoulderM};
  }
  Eigen::Vector3d home() const { return shoulder() - Eigen::Vector3d(0.12, 0, -0.1); }

  /// From the shoulder to the farthest corner.
  double reach_m() const {
    Eigen::Vector3d far = floor_.min();
    far.y() = floor_.max().y();
    return 1.1 * (far - shoulder()).norm() + Arm::kGripperM;
  }

  void go_to(double time_s, const Eigen::Vector3d& tip) {
    if (!path_.points.empty() && time_s <= path_.points.back().time_s) return;
    path_.points.push_back({time_s, tip});
  }

  void carry(const Carry& move) {
    const Eigen::Vector3d above(0, 0, move.top_m);
    for (const double share : {0.0, kLifted, kLowering, 1.0}) {
      go_to(move.begin_s + share * (move.end_s - move.begin_s),
            carried_pose(move.from, move.to, share).translation() + above);
    }
  }

  /// Over the table and back, if there is time for it.
  void pass(double from_s, double to_s, std::uint64_t index) {
    const double approach_s = kApproach * period_s_;
    if (to_s - from_s <= 2 * approach_s) return;  // straight to the next
    go_to(from_s + approach_s, home());
    const double spare_s = to_s - from_s - (2 * kApproach + kPass) * period_s_;
    if (spare_s > 0) {
      const double begin_s = from_s + approach_s + spare_s * unit(index, 0);
      go_to(begin_s, home());
      go_to(begin_s + kPass / 3 * period_s_, over_table(index, 1));
      go_to(begin_s + kPass * 2 / 3 * period_s_, over_table(index, 2));
      go_to(begin_s + kPass * period_s_, home());
    }
    go_to(to_s - approach_s, home());
  }

  ArmPath take() { return std::move(path_); }

 private:
  double unit(std::uint64_t index, int what) const {
    return to_unit(sample_hash(seed_, 0xA3u, index, what));
  }
  Eigen::Vector3d over_table(std::uint64_t index, int point) const {
    const Eigen::Vector3d size = floor_.size();
    return floor_.min() + Eigen::Vector3d(size.x() * unit(index, 3 * point),
                                          size.y() * unit(index, 3 * point + 1),
                                          0.12 + 0.1 * unit(index, 3 * point + 2));
  }

  const Box& floor_;
  double period_s_;
  std::uint64_t seed_;
  ArmPath path_ = {};
};

}  // namespace

SequenceArm passing_arm(const SequencePlan& plan, const Box& floor, std::uint64_t seed) {
  PathBuilder builder(floor, plan.period_s, seed);
  builder.go_to(-1, builder.home());
  double free_s = 0;
  std::uint64_t index = 0;
  for (const Carry& move : carries_of(plan)) {
    builder.pass(free_s, move.begin_s, index++);
    builder.carry(move);
    free_s = move.end_s;
  }
  builder.pass(free_s, plan.time_s(plan.instants), index);
  return {Arm(builder.shoulder(), builder.reach_m()), builder.take()};
}

}  // namespace vantage
