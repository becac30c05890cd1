#include "reference/plain_equilibrium.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace vantage::test {
namespace {

constexpr int kPointsAlong = 7, kSweeps = 4000;
constexpr double kSameHeight_m = 1e-6;

/// A force of one newton upwards, as the boxes' balance has it: per box a force, and two torques
/// per metre of a typical size.
struct PushUp {
  Eigen::VectorXd on_boxes;
};

constexpr double kTypicalSize_m = 0.05;

void add_push(Eigen::VectorXd& balance, const StackedBox& box, std::size_t index,
              const Eigen::Vector3d& point, double force) {
  const Eigen::Vector3d arm = (point - box.centre) / kTypicalSize_m;
  balance[Eigen::Index(3 * index)] += force;
  balance[Eigen::Index(3 * index) + 1] += arm.y() * force;
  balance[Eigen::Index(3 * index) + 2] -= arm.x() * force;
}

/// Whether a point's vertical goes through the box, made wider by `grown_m` on every side.
bool is_within(const StackedBox& box, const Eigen::Vector3d& point, double grown_m) {
  const Eigen::Rotation2Dd back(-box.yaw);
  const Eigen::Vector2d local = back * (point - box.centre).head<2>();
  return std::abs(local.x()) <= box.size.x() / 2 + grown_m + 1e-9 &&
         std::abs(local.y()) <= box.size.y() / 2 + grown_m + 1e-9;
}

double bottom_of(const StackedBox& box) {
  return box.centre.z() - box.size.z() / 2;
}

double top_of(const StackedBox& box) {
  return box.centre.z() + box.size.z() / 2;
}

/// All over the box, made wider, at one height.
std::vector<Eigen::Vector3d> grid_of(const StackedBox& box, double height, double grown_m) {
  std::vector<Eigen::Vector3d> points;
  const Eigen::Vector2d half = box.size.head<2>() / 2 + Eigen::Vector2d(grown_m, grown_m);
  for (int i = 0; i < kPointsAlong; ++i) {
    for (int j = 0; j < kPointsAlong; ++j) {
      const Eigen::Vector2d at(half.x() * (2.0 * i / (kPointsAlong - 1) - 1),
                               half.y() * (2.0 * j / (kPointsAlong - 1) - 1));
      const Eigen::Vector2d turned = Eigen::Rotation2Dd(box.yaw) * at;
      points.emplace_back(box.centre.x() + turned.x(), box.centre.y() + turned.y(), height);
    }
  }
  return points;
}

std::vector<PushUp> all_pushes(const std::vector<StackedBox>& boxes, double grown_m) {
  std::vector<PushUp> pushes;
  const auto push_at = [&](const Eigen::Vector3d& point, std::size_t upper, int lower) {
    Eigen::VectorXd push = Eigen::VectorXd::Zero(Eigen::Index(3 * boxes.size()));
    add_push(push, boxes[upper], upper, point, 1);
    if (lower >= 0) add_push(push, boxes[std::size_t(lower)], std::size_t(lower), point, -1);
    pushes.push_back({push});
  };
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    const std::vector<Eigen::Vector3d> underside = grid_of(boxes[b], bottom_of(boxes[b]), grown_m);
    if (std::abs(bottom_of(boxes[b])) <= kSameHeight_m) {
      for (const Eigen::Vector3d& point : underside) push_at(point, b, -1);
    }
    for (std::size_t under = 0; under < boxes.size(); ++under) {
      if (std::abs(bottom_of(boxes[b]) - top_of(boxes[under])) > kSameHeight_m) continue;
      for (const Eigen::Vector3d& point : underside) {
        if (is_within(boxes[under], point, grown_m)) push_at(point, b, int(under));
      }
      for (const Eigen::Vector3d& point : grid_of(boxes[under], top_of(boxes[under]), grown_m)) {
        if (is_within(boxes[b], point, grown_m)) push_at(point, b, int(under));
      }
    }
  }
  return pushes;
}

}  // namespace

double plain_unbalance(const std::vector<StackedBox>& boxes, double grown_m) {
  const std::vector<PushUp> pushes = all_pushes(boxes, grown_m);
  Eigen::VectorXd lacking = Eigen::VectorXd::Zero(Eigen::Index(3 * boxes.size()));
  double mean_weight = 0;
  for (const StackedBox& box : boxes) mean_weight += box.size.prod() / double(boxes.size());
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    lacking[Eigen::Index(3 * b)] = boxes[b].size.prod() / mean_weight;
  }
  std::vector<double> forces(pushes.size(), 0);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    double largest = 0;
    for (std::size_t p = 0; p < pushes.size(); ++p) {
      const Eigen::VectorXd& push = pushes[p].on_boxes;
      const double force = std::max(0.0, forces[p] + push.dot(lacking) / push.squaredNorm());
      lacking -= (force - forces[p]) * push;
      largest = std::max(largest, std::abs(force - forces[p]));
      forces[p] = force;
    }
    if (largest < 1e-9) break;
  }
  return lacking.cwiseAbs().maxCoeff();
}

}  // namespace vantage::test
