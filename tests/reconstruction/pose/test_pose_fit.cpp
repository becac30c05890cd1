#include <doctest/doctest.h>

#include <Eigen/LU>
#include <limits>
#include <numbers>

#include "pose/extrapolated_lens.hpp"
#include "reconstruction/seen_markers.hpp"
#include "reference/plain_least_squares.hpp"
#include "support/scene_count.hpp"

namespace vantage::test {
namespace {

using reconstruction::detail::fit_pose;
using reconstruction::detail::PointTerm;
using reconstruction::detail::PoseFit;
using reconstruction::detail::PoseTerm;

/// Residuals of points and poses, divided by sigma, from the definitions. With a loss, each term's
/// are made smaller so that the sum of their squares is Cauchy's loss.
Eigen::VectorXd plain_residuals(const std::vector<PointTerm>& points,
                                const std::vector<PoseTerm>& poses, const Pose& T_ref_body,
                                double loss_sigmas) {
  std::vector<double> all;
  const auto add = [&](const Eigen::VectorXd& r) {
    const double b = loss_sigmas * loss_sigmas * double(r.size()), s = r.squaredNorm();
    const double factor = b > 0 && s > 0 ? std::sqrt(b * std::log1p(s / b) / s) : 1;
    for (const double x : r) all.push_back(factor * x);
  };
  for (const PointTerm& term : points) {
    Eigen::VectorXd r(2 * term.pixels.size());
    for (std::size_t i = 0; i < term.pixels.size(); ++i) {
      const Eigen::Vector3d p_cam = term.T_cam_ref * (T_ref_body * term.points_m[i]);
      r.segment<2>(2 * Eigen::Index(i)) =
          (term.lens->project(p_cam) - term.pixels[i]) / term.sigma_px;
    }
    add(r);
  }
  for (const PoseTerm& term : poses) {
    Eigen::VectorXd r = step_between(term.T_ref_feature, T_ref_body * term.T_body_feature);
    r.head<3>() /= term.sigma_m;
    r.tail<3>() /= term.sigma_rad;
    add(r);
  }
  return Eigen::Map<const Eigen::VectorXd>(all.data(), Eigen::Index(all.size()));
}

/// Measured frames of a body that are up to a few sigmas off.
std::vector<PoseTerm> seen_frames(const Pose& T_ref_body, int count, Random& random) {
  std::vector<PoseTerm> terms;
  while (terms.size() < std::size_t(count)) {
    const Pose T_body_feature = random.pose(0.1);
    const PoseTerm exact{T_ref_body * T_body_feature, T_body_feature, 0.002, 0.02};
    Eigen::Matrix<double, 6, 1> off;
    off << 0.002 * random.in_cube(2), 0.02 * random.in_cube(2);
    terms.push_back(exact);
    terms.back().T_ref_feature = moved_by(exact.T_ref_feature, off);
  }
  return terms;
}

}  // namespace

TEST_CASE("derivatives by the body's pose and by the camera's are difference quotients") {
  Random random(1);
  for (std::uint32_t scene = 0; scene < scene_count(50); ++scene) {
    const SeenBody body(random, 3, 5);
    const PointTerm& term = body.terms[random.below(3)];
    const Pose T_world_cam = term.T_cam_ref.inverse();
    const auto off = [&](const Pose& camera, const Pose& T_world_body) {
      PointTerm moved = term;
      moved.T_cam_ref = camera.inverse();
      return Eigen::VectorXd(term.sigma_px * plain_residuals({moved}, {}, T_world_body, 0));
    };
    const auto by_body =
        numeric_derivatives([&](const Pose& p) { return off(T_world_cam, p); }, body.T_world_body);
    const auto by_camera =
        numeric_derivatives([&](const Pose& p) { return off(p, body.T_world_body); }, T_world_cam);
    CHECK((reconstruction::detail::jacobian(term, body.T_world_body) - by_body).norm() <
          1e-6 * by_body.norm());
    CHECK((reconstruction::detail::camera_jacobian(term, body.T_world_body) - by_camera).norm() <
          1e-6 * by_camera.norm());
  }
}

TEST_CASE("exact pixels give the exact pose back") {
  Random random(2);
  for (std::uint32_t scene = 0; scene < scene_count(200); ++scene) {
    CAPTURE(scene);
    const SeenBody body(random, 1 + int(random.below(12)), 0);
    const auto fit = fit_pose(body.terms, {}, body.start(random), scene % 2 ? 3 : 0);
    REQUIRE(fit);
    CHECK(fit->converged);
    CHECK(pose_distance(fit->T_ref_body, body.T_world_body) < 1e-9);
    CHECK(fit->rms_px < 1e-6);
    CHECK(fit->rms_px_of_term.size() == body.terms.size());
  }
}

TEST_CASE("the minimum is the one that plain least squares find") {
  Random random(3);
  for (std::uint32_t scene = 0; scene < scene_count(60); ++scene) {
    CAPTURE(scene);
    const SeenBody body(random, int(random.below(8)), 0.5);
    const auto frames =
        seen_frames(body.T_world_body, body.terms.empty() ? 2 : int(random.below(3)), random);
    const double loss_sigmas = scene % 2 ? 4 : 0;
    const auto fit = fit_pose(body.terms, frames, body.start(random), loss_sigmas);
    REQUIRE(fit);
    CHECK(fit->converged);
    const auto residuals = [&](const Pose& pose) {
      return plain_residuals(body.terms, frames, pose, loss_sigmas);
    };
    const Pose minimum = plain_minimum(residuals, body.T_world_body);
    CHECK(pose_distance(fit->T_ref_body, minimum) < 1e-7);
    const double plain = plain_residuals(body.terms, frames, minimum, 0).squaredNorm();
    CHECK(std::abs(fit->chi_square - plain) < 1e-6 * plain);
    if (loss_sigmas > 0) continue;
    const auto j = numeric_derivatives(residuals, minimum);
    CHECK((fit->information - j.transpose() * j).norm() < 1e-5 * fit->information.norm());
  }
}

TEST_CASE("one marker in five that lies anywhere moves the pose no more than noise does") {
  Random random(4);
  double with = 0, without = 0;
  for (std::uint32_t scene = 0; scene < scene_count(100); ++scene) {
    CAPTURE(scene);
    SeenBody body(random, 15, 0.1);
    const Pose start = body.start(random);
    const auto clean = fit_pose(body.terms, {}, start, 3);
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector2d away = 10 * normal2(random) + Eigen::Vector2d(60, 30);
      for (Eigen::Vector2d& pixel : body.terms[5 * i].pixels) pixel += away;
    }
    const auto fit = fit_pose(body.terms, {}, start, 3);
    REQUIRE(fit);
    REQUIRE(clean);
    CHECK(pose_distance(fit->T_ref_body, body.T_world_body) < 5e-3);
    CHECK(fit->rms_px_of_term[0] > 20);
    CHECK(fit->rms_px_of_term[1] < 1);
    with += pose_distance(fit->T_ref_body, body.T_world_body);
    without += pose_distance(clean->T_ref_body, body.T_world_body);
    // What is turned down tells nothing.
    CHECK(fit->information.trace() < clean->information.trace());
  }
  CHECK(with < 1.5 * without);
}

TEST_CASE("from a start behind the camera the pose is found or nothing, and never a pose there") {
  Random random(5);
  std::size_t found = 0;
  const std::uint32_t scenes = scene_count(200);
  for (std::uint32_t scene = 0; scene < scenes; ++scene) {
    const SeenBody body(random, 3, 0.1);
    const Pose& T_cam_ref = body.terms[0].T_cam_ref;
    const Eigen::Vector3d behind =
        body.T_world_body.translation() - 1.5 * T_cam_ref.rotation().row(2).transpose();
    const Pose start = Pose::from_rotation(body.T_world_body.rotation(), behind);
    CHECK(std::isinf(reconstruction::detail::residuals_px(body.terms[0], start)[0]));
    const auto fit = fit_pose({body.terms.data(), 1}, {}, start, scene % 2 ? 3 : 0);
    if (!fit) continue;
    CHECK(fit->information.allFinite());
    CHECK(std::isfinite(fit->chi_square));
    for (const double r : reconstruction::detail::residuals_px(body.terms[0], fit->T_ref_body)) {
      CHECK(std::isfinite(r));
    }
    found += fit->rms_px < 1;
  }
  CHECK(found >= enough(10));
  // A body of which one point is before one camera and behind the other has no pose.
  const Lens& lens = some_lenses()[0];
  const Pose turned = Pose::from_rotation(
      Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitY()).matrix(), {});
  const PointTerm here{&lens, {}, {{0, 0, 0}}, {{322, 238}}, 0.1};
  const PointTerm there{&lens, turned, {{0, 0, 0}}, {{322, 238}}, 0.1};
  CHECK(!fit_pose(std::vector{here, there}, {}, Pose::from_translation({0, 0, 1}), 0));
}

TEST_CASE("a lens that folds over far out shows no point there in its image") {
  // What is 56° from the axis falls back into the image.
  const Lens lens(kSeenIntrinsics, {-0.3, 0, 0, 0, 0});
  const Eigen::Vector3d far_out(1.5, 0, 1);
  REQUIRE(lens.project(far_out).x() < 640);
  const PointTerm term{&lens, {}, {far_out}, {lens.project(far_out)}, 0.1};
  CHECK(reconstruction::detail::residuals_px(term, {})[0] > 300);
}

TEST_CASE("a fisheye lens has a continuous image with true derivatives, in front and behind") {
  const Lens lens({640, 480, 200, 201, 322.3, 238.1}, Distortion::fisheye(0.02, -0.01, 0.002, 0));
  const reconstruction::detail::WideLens wide(lens);
  Random random(8);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d p = random.uniform(0.1, 2) * random.direction();
    if (p.z() / p.norm() < -0.99) continue;  // straight behind, everything is beside everything
    Eigen::Matrix<double, 2, 3> by_point;
    const Eigen::Vector2d at = wide.project(p, &by_point);
    if (p.head<2>().norm() < lens.reach() * p.z()) CHECK((at - lens.project(p)).norm() < 1e-9);
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d step = 1e-6 * Eigen::Vector3d::Unit(axis);
      const Eigen::Vector2d change = (wide.project(p + step) - wide.project(p - step)) / 2e-6;
      CHECK((change - by_point.col(axis)).norm() < 1e-3 * (1 + change.norm()));
    }
  }
}

TEST_CASE("no pose for non-finite input, for invalid sigmas, and for no input") {
  Random random(6);
  const SeenBody body(random, 2, 0);
  const Pose start = body.start(random);
  const auto refused = [&](const auto& spoil) {
    std::vector<PointTerm> terms = body.terms;
    spoil(terms[1]);
    CHECK(!fit_pose(terms, {}, start, 3));
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused([&](PointTerm& t) { t.pixels[2].x() = nan; });
  refused([&](PointTerm& t) { t.points_m[3].z() = INFINITY; });
  refused([&](PointTerm& t) { t.sigma_px = 0; });
  refused([&](PointTerm& t) { t.sigma_px = nan; });
  refused([&](PointTerm& t) { t.pixels.pop_back(); });
  CHECK(!fit_pose({}, std::vector{PoseTerm{{}, {}, 0, 1}}, start, 3));
  CHECK(!fit_pose({}, std::vector{PoseTerm{{}, {}, 1, nan}}, start, 3));
  CHECK(!fit_pose({}, {}, start, 3));
  CHECK(!fit_pose(std::vector{PointTerm{&some_lenses()[0], {}, {}, {}, 1}}, {}, start, 3));
}

TEST_CASE("the same input has the same bits") {
  Random random(7);
  const SeenBody body(random, 9, 0.3);
  const Pose start = body.start(random);
  const auto a = fit_pose(body.terms, {}, start, 3), b = fit_pose(body.terms, {}, start, 3);
  REQUIRE(a);
  REQUIRE(b);
  CHECK(a->T_ref_body.rotation() == b->T_ref_body.rotation());
  CHECK(a->T_ref_body.translation() == b->T_ref_body.translation());
  CHECK(a->information == b->information);
}

TEST_CASE("a covariance is the inverse of the information, and large where there is none") {
  Random random(8);
  const SeenBody body(random, 4, 0.1);
  const auto fit = fit_pose(body.terms, {}, body.T_world_body, 0);
  REQUIRE(fit);
  const Matrix6d inverse = fit->information.inverse();
  CHECK((reconstruction::detail::covariance_of(fit->information) - inverse).norm() <
        1e-5 * inverse.norm());

  const double most = std::numbers::pi * std::numbers::pi;
  const Matrix6d nothing = reconstruction::detail::covariance_of(Matrix6d::Zero());
  CHECK(nothing.diagonal().head<3>().isApprox(Eigen::Vector3d::Ones()));
  CHECK(nothing.diagonal().tail<3>().isApprox(Eigen::Vector3d::Constant(most)));
  Matrix6d half = Matrix6d::Zero();
  half.diagonal() << 1e6, 1e6, 1e6, 0, 1e4, 0;
  const Matrix6d known = reconstruction::detail::covariance_of(half);
  CHECK(known(0, 0) / 1e-6 == doctest::Approx(1).epsilon(1e-6));
  CHECK(known(4, 4) / 1e-4 == doctest::Approx(1).epsilon(1e-6));
  CHECK(known(3, 3) == doctest::Approx(most));
}

}  // namespace vantage::test
