#include "vantage/planner/advanced/servo_refiner.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "scene/scale_intrinsics.hpp"

namespace vantage {
namespace {

// Shares of the image. The thesis says when the camera moves, but not by how much.
constexpr double kBorder = 0.02;    // this close to a border counts as touching it
constexpr double kSmall = 0.6;      // shadow that fills less than this is small ...
constexpr double kWanted = 0.8;     // ... and is made to fill about this
constexpr double kBackBy = 0.25;    // shares of the distance to the shadow
constexpr double kCloserBy = 0.35;  // at most

/// What the bounds say should be done.
struct Order {
  ServoMove move = ServoMove::aim;
  double forward = 0;  ///< share of the distance to the shadow
};

Order order_of(const ShadowBounds& b, const Intrinsics& k) {
  const double border_u = kBorder * k.width, border_v = kBorder * k.height;
  const bool left = b.left<border_u, right = b.right> k.width - 1 - border_u;
  const bool top = b.top<border_v, bottom = b.bottom> k.height - 1 - border_v;
  if ((left && right) || (top && bottom)) return {ServoMove::back, -kBackBy};
  const double fill =
      std::max(double(b.right - b.left + 1) / k.width, double(b.bottom - b.top + 1) / k.height);
  if (left || right || top || bottom || fill >= kSmall) return {};
  return {ServoMove::closer, std::min(kCloserBy, 1 - fill / kWanted)};
}

/// A camera at `eye` whose image's middle shows what lies in `direction`.
Pose aimed(const Eigen::Vector3d& eye, const Eigen::Vector3d& direction, const Intrinsics& k) {
  const Pose axis = Pose::looking_at(eye, eye + direction);
  const Eigen::Vector3d middle(((k.width - 1) / 2.0 - k.cx) / k.fx,
                               ((k.height - 1) / 2.0 - k.cy) / k.fy, 1);
  const Eigen::Quaterniond turn = rotation_between(middle, Eigen::Vector3d::UnitZ());
  return Pose::from_rotation(axis.rotation() * turn.toRotationMatrix(), eye);
}

/// Whether the camera does not move, and turns by less than a pixel: bounds are known to half a
/// pixel each, so that the middles of two looks at the same may differ by as much.
bool stays(const Pose& a, const Pose& b, const Intrinsics& k) {
  const double pixel = 1 / std::max(k.fx, k.fy);
  return (a.translation() - b.translation()).norm() < 1e-9 &&
         Eigen::AngleAxisd(a.rotation().transpose() * b.rotation()).angle() < pixel;
}

}  // namespace

std::string_view to_text(ServoMove move) {
  switch (move) {
    case ServoMove::start:
      return "start";
    case ServoMove::aim:
      return "aim";
    case ServoMove::back:
      return "back";
    case ServoMove::closer:
      return "closer";
    case ServoMove::polish:
      return "polish";
  }
  return "";
}

ServoRefiner::ServoRefiner(std::shared_ptr<const ShadowView> view,
                           std::shared_ptr<const ViewValidityChecker> validity,
                           const PinholeCamera& camera, const Eigen::Vector3d& shadow_centre,
                           const ServoOptions& options)
    : view_(std::move(view)),
      validity_(std::move(validity)),
      camera_((options.check(), planner::detail::scaled(camera.intrinsics(), options.image_width)),
              Pose(), camera.range(), "servo camera"),
      shadow_centre_(shadow_centre),
      options_(options) {}

std::vector<ServoStep> ServoRefiner::path(const Pose& T_world_cam) const {
  std::optional<ExtremePoints> extremes;
  return path(T_world_cam, extremes);
}

std::vector<ServoStep> ServoRefiner::path(const Pose& T_world_cam,
                                          std::optional<ExtremePoints>& extremes) const {
  std::vector<ServoStep> steps = {{T_world_cam, ServoMove::start}};
  for (int i = 0; i < options_.iterations; ++i) {
    const PinholeCamera camera = camera_.moved_to(steps.back().T_world_cam);
    const ShadowObservation observation = view_->observe(camera, extremes);
    steps.back().score = observation.score;
    if (!observation.bounds) break;
    extremes = observation.extremes;
    const std::optional<ServoStep> next = step(camera, *observation.bounds);
    if (!next || stays(next->T_world_cam, steps.back().T_world_cam, camera.intrinsics())) break;
    steps.push_back(*next);
  }
  return steps;
}

std::optional<ServoStep> ServoRefiner::step(const PinholeCamera& camera,
                                            const ShadowBounds& bounds) const {
  const Intrinsics& k = camera.intrinsics();
  const Order order = order_of(bounds, k);
  const Eigen::Vector3d direction =
      camera.pixel_ray((bounds.left + bounds.right) / 2.0, (bounds.top + bounds.bottom) / 2.0)
          .direction.normalized();
  const double distance_m = (shadow_centre_ - camera.centre()).norm();
  // What is forbidden is tried by halves, then without moving at all.
  for (const double part : {1.0, 0.5, 0.25, 0.0}) {
    const double forward_m = part * order.forward * distance_m;
    const Pose pose = aimed(camera.centre() + forward_m * direction, direction, k);
    if (validity_->check(pose) != InvalidReason::none) continue;
    return ServoStep{pose, forward_m == 0 ? ServoMove::aim : order.move};
  }
  return std::nullopt;
}

}  // namespace vantage
