#include "vantage/planner/advanced/view_polisher.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numbers>

#include "scene/scale_intrinsics.hpp"
#include "scene/utility.hpp"

namespace vantage {
namespace {

constexpr std::array kMoves = {PolishMove::around, PolishMove::over, PolishMove::pan,
                               PolishMove::tilt};
constexpr int kFirstStep = 4;  // in units of the last one; halved in between
constexpr double kDegree = std::numbers::pi / 180;
constexpr std::array kUnitRad = {5 * kDegree, 5 * kDegree, 1.5 * kDegree, 1.5 * kDegree};

/// How far from the start, in units of each move.
using Place = std::array<int, kMoves.size()>;

/// The poses around a start.
class Surroundings {
 public:
  Surroundings(const Pose& start, const Eigen::Vector3d& middle)
      : start_(start), middle_(middle), arm_(start.translation() - middle) {
    const double flat_m = std::hypot(arm_.x(), arm_.y());
    elevation_ = std::atan2(arm_.z(), flat_m);
    // Straight above, the image's horizontal says which way is down.
    Eigen::Vector3d side(-arm_.y(), arm_.x(), 0);
    if (flat_m < 1e-6 * arm_.norm()) side << start.rotation().col(0).head<2>(), 0;
    side_ = side.norm() > 0 ? side.normalized() : Eigen::Vector3d::UnitX();
  }

  /// Nothing past the point straight above: there, the image would be upside down.
  std::optional<Pose> at(const Place& place) const {
    const auto angle = [&](PolishMove move) {
      return place[std::size_t(move)] * kUnitRad[std::size_t(move)];
    };
    if (elevation_ + angle(PolishMove::over) > std::numbers::pi / 2 + 1e-9) return std::nullopt;
    using Turn = Eigen::AngleAxisd;
    const Eigen::Matrix3d around = (Turn(angle(PolishMove::around), Eigen::Vector3d::UnitZ()) *
                                    Turn(-angle(PolishMove::over), side_))
                                       .toRotationMatrix();
    const Eigen::Matrix3d turned = (Turn(angle(PolishMove::pan), Eigen::Vector3d::UnitY()) *
                                    Turn(angle(PolishMove::tilt), Eigen::Vector3d::UnitX()))
                                       .toRotationMatrix();
    return Pose::from_rotation(around * start_.rotation() * turned, middle_ + around * arm_);
  }

 private:
  Pose start_;
  Eigen::Vector3d middle_, arm_, side_;
  double elevation_ = 0;
};

}  // namespace

std::string_view to_text(PolishMove move) {
  switch (move) {
    case PolishMove::around:
      return "around";
    case PolishMove::over:
      return "over";
    case PolishMove::pan:
      return "pan";
    case PolishMove::tilt:
      return "tilt";
  }
  return "";
}

struct ViewPolisher::Impl {
  std::shared_ptr<const ViewScorer> scorer;
  std::shared_ptr<const ViewValidityChecker> validity;
  PinholeCamera camera;
  Eigen::Vector3d shadow_centre;
  planner::detail::Utility utility;

  /// What a pose is worth if that is more than `best`; else, and if stopped, nothing.
  std::optional<Score> better(const Pose& T_world_cam, Score best, const StopToken& stop) const {
    if (validity->check(T_world_cam) != InvalidReason::none) return std::nullopt;
    const PinholeCamera view = camera.moved_to(T_world_cam);
    const std::uint64_t share = utility.share(view.centre());
    const Score needed = planner::detail::Utility::needed(best + 1, share);
    ScoreBound score;
    scorer->score({&view, 1}, {&needed, 1}, {&score, 1}, stop);
    const Score worth = planner::detail::Utility::of(score.score, share);
    return score.exact() && worth > best ? std::optional(worth) : std::nullopt;
  }
};

namespace {

/// Goes from place to place, and to none twice: where it was before is worth less.
class Walk {
 public:
  explicit Walk(const Pose& start, const Eigen::Vector3d& middle) : around_(start, middle) {}

  /// @param better what a pose is worth if that is more than a score.
  /// @returns whether it went there.
  template <class Better>
  bool step(PolishMove move, int by, const Better& better) {
    Place next = place_;
    next[std::size_t(move)] += by;
    if (std::find(tried_.begin(), tried_.end(), next) != tried_.end()) return false;
    tried_.push_back(next);
    const std::optional<Pose> pose = around_.at(next);
    const std::optional<Score> worth = pose ? better(*pose, best_) : std::nullopt;
    if (!worth) return false;
    place_ = next;
    best_ = *worth;
    steps_.push_back({move, by * kUnitRad[std::size_t(move)], *pose});
    return true;
  }

  void begin(Score worth) { best_ = worth; }
  const std::vector<PolishStep>& steps() const { return steps_; }

 private:
  Surroundings around_;
  Place place_{};
  std::vector<Place> tried_ = {Place{}};
  Score best_ = 0;
  std::vector<PolishStep> steps_;
};

}  // namespace

ViewPolisher::ViewPolisher(std::shared_ptr<const ViewScorer> scorer,
                           std::shared_ptr<const ViewValidityChecker> validity,
                           const PinholeCamera& camera, const Eigen::Vector3d& shadow_centre,
                           const PolishOptions& options, const std::optional<TravelCost>& travel) {
  options.check();
  if (travel) travel->check();
  const int width = std::min(options.image_width, camera.intrinsics().width);
  impl_ = std::make_shared<const Impl>(
      Impl{std::move(scorer), std::move(validity),
           PinholeCamera(planner::detail::scaled(camera.intrinsics(), width), Pose(),
                         camera.range(), "polishing camera"),
           shadow_centre, planner::detail::Utility(travel)});
}

std::vector<PolishStep> ViewPolisher::path(const Pose& T_world_cam, const StopToken& stop) const {
  if ((T_world_cam.translation() - impl_->shadow_centre).norm() < 1e-6) return {};
  Walk walk(T_world_cam, impl_->shadow_centre);
  const auto better = [&](const Pose& pose, Score best) { return impl_->better(pose, best, stop); };
  walk.begin(better(T_world_cam, 0).value_or(0));
  for (int size = kFirstStep; size > 0; size /= 2) {
    for (bool moved = true; moved && !stop.stop_requested();) {
      moved = false;
      for (const PolishMove move : kMoves) {
        moved |= walk.step(move, size, better) || walk.step(move, -size, better);
      }
    }
  }
  return walk.steps();
}

}  // namespace vantage
