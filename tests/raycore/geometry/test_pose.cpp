#include "vantage/raycore/pose.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "reference/random_scene.hpp"
#include "support/expect_error.hpp"
#include "support/non_finite.hpp"

using namespace vantage;
using namespace vantage::test;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

void check_valid(const Pose& pose) {
  const Matrix3d& r = pose.rotation();
  CHECK((r.transpose() * r - Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-12);
  CHECK(r.determinant() == doctest::Approx(1));
  CHECK(pose.translation().allFinite());
}

}  // namespace

TEST_CASE("a camera that looks at a point has x right, y down and z forward") {
  const Pose pose = Pose::looking_at({2, 0, 1}, {0, 0, 1});  // along world -x
  check_valid(pose);
  CHECK(pose.rotation().col(0).isApprox(Vector3d(0, 1, 0), 1e-12));
  CHECK(pose.rotation().col(1).isApprox(Vector3d(0, 0, -1), 1e-12));
  CHECK(pose.rotation().col(2).isApprox(Vector3d(-1, 0, 0), 1e-12));
  CHECK(pose.translation() == Vector3d(2, 0, 1));
}

TEST_CASE("looking_at puts the target on the optical axis and the horizon level") {
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const Vector3d eye = random.in_cube(3), target = random.in_cube(3);
    const Pose pose = Pose::looking_at(eye, target);
    check_valid(pose);
    const Vector3d seen = pose.inverse() * target;
    CHECK(seen.head<2>().norm() < 1e-12);
    CHECK(seen.z() == doctest::Approx((target - eye).norm()));
    CHECK(std::abs(pose.rotation().col(0).z()) < 1e-12);  // right stays level
    CHECK(pose.rotation().col(1).z() < 0);                // down goes down
  }
}

TEST_CASE("a camera that looks along z has world +y up in its image") {
  for (const double z : {-1.0, 1.0}) {
    const Pose pose = Pose::looking_at({1, 2, 3}, {1, 2, 3 + z});
    check_valid(pose);
    CHECK(pose.rotation().col(2).isApprox(Vector3d(0, 0, z), 1e-12));
    CHECK(pose.rotation().col(1).isApprox(Vector3d(0, -1, 0), 1e-12));
  }
}

TEST_CASE("looking_at works for very near and very far targets") {
  for (const double distance : {1e-200, 1e-9, 1e200, 1e307}) {
    const Pose pose = Pose::looking_at({0, 0, 0}, {distance, distance, 0});
    check_valid(pose);
    CHECK(pose.rotation().col(2).isApprox(Vector3d(1, 1, 0).normalized(), 1e-12));
  }
}

TEST_CASE("looking_at refuses points without a direction between them") {
  expect_bad_input("target", "coincides", [] { Pose::looking_at({1, 2, 3}, {1, 2, 3}); });
  expect_bad_input("eye", "nan", [] { Pose::looking_at({kNaN, 0, 0}, {0, 0, 1}); });
  expect_bad_input("target", "inf", [] { Pose::looking_at({0, 0, 0}, {0, kInfinity, 1}); });
  expect_bad_input("target", "far", [] { Pose::looking_at({-1.7e308, 0, 0}, {1.7e308, 0, 1}); });
}

TEST_CASE("inverse and composition") {
  Random random(2);
  for (int i = 0; i < 300; ++i) {
    const Pose a = random.pose(5), b = random.pose(5);
    const Vector3d p = random.in_cube(5);
    CHECK((a.inverse() * (a * p) - p).norm() < 1e-12);
    CHECK(((a * b) * p - a * (b * p)).norm() < 1e-12);
    CHECK((a * a.inverse()).translation().norm() < 1e-12);
    check_valid(a * b);
    check_valid(a.inverse());
  }
  CHECK(Pose() * Vector3d(1, 2, 3) == Vector3d(1, 2, 3));
  CHECK(Pose::from_translation({1, 0, 0}) * Vector3d(1, 2, 3) == Vector3d(2, 2, 3));
}

TEST_CASE("quaternions have unit norm and w >= 0, and give the rotation back") {
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    const Pose pose = random.pose(1);
    const Quaterniond q = pose.quaternion();
    CHECK(q.w() >= 0);
    CHECK(q.norm() == doctest::Approx(1).epsilon(1e-12));
    const Quaterniond negative(-q.w(), -q.x(), -q.y(), -q.z());
    for (const Quaterniond& same : {q, negative}) {
      const Pose back = Pose::from_quaternion(same, pose.translation());
      CHECK(back.rotation().isApprox(pose.rotation(), 1e-12));
      CHECK(back.translation() == pose.translation());
    }
  }
  const Quaterniond half_turn(0, 0, 0, 1);
  CHECK(Pose::from_quaternion(half_turn, {0, 0, 0})
            .rotation()
            .isApprox(Vector3d(-1, -1, 1).asDiagonal().toDenseMatrix(), 1e-12));
}

TEST_CASE("a rotation may be off by 1e-3 and comes out orthonormal") {
  Random random(4);
  const Matrix3d exact = random.pose(1).rotation();
  const Pose pose = Pose::from_rotation(exact * 1.0004, {1, 2, 3});
  check_valid(pose);
  CHECK(pose.rotation().isApprox(exact, 1e-12));
  check_valid(Pose::from_rotation(exact + Matrix3d::Constant(1e-4), {0, 0, 0}));
  expect_bad_input("cam 7", "not a rotation", [&] {
    Pose::from_rotation(exact * 1.0006, {1, 2, 3}, "cam 7");
  });
}

TEST_CASE("what is not a rotation is refused") {
  const Vector3d zero = Vector3d::Zero();
  const Matrix3d mirror = Vector3d(1, 1, -1).asDiagonal();
  expect_bad_input("cam 1", "reflection", [&] { Pose::from_rotation(mirror, zero, "cam 1"); });
  expect_bad_input("pose", "not a rotation", [&] { Pose::from_rotation(Matrix3d::Zero(), zero); });
  Matrix3d bad = Matrix3d::Identity();
  bad(1, 2) = kNaN;
  expect_bad_input("pose", "not finite", [&] { Pose::from_rotation(bad, zero); });
  bad << 1e200, 1e200, 0, -1e200, 1e200, 0, 0, 0, 1;  // RᵀR overflows to inf - inf
  expect_bad_input("pose", "not a rotation", [&] { Pose::from_rotation(bad, zero); });
  expect_bad_input("pose", "inf", [&] {
    Pose::from_rotation(Matrix3d::Identity(), {0, 0, kInfinity});
  });
  expect_bad_input("pose", "nan", [] { Pose::from_translation({kNaN, 0, 0}); });
}

TEST_CASE("a quaternion's norm may be off by 1e-3") {
  const Quaterniond unit(0.5, 0.5, -0.5, 0.5);
  const auto scaled = [&](double s) { return Quaterniond(s * unit.coeffs()); };
  for (const double s : {0.9991, 1.0009}) check_valid(Pose::from_quaternion(scaled(s), {0, 0, 0}));
  for (const double s : {0.0, 0.9989, 1.0011, 1e200}) {
    expect_bad_input("object 2", "norm", [&] {
      Pose::from_quaternion(scaled(s), {0, 0, 0}, "object 2");
    });
  }
  expect_bad_input("pose", "nan", [] {
    Pose::from_quaternion(Quaterniond(kNaN, 0, 0, 0), {0, 0, 0});
  });
}

TEST_CASE("the rotation between two directions is the smallest that takes one to the other") {
  Random random(8);
  const auto check = [](const Vector3d& from, const Vector3d& to) {
    const Quaterniond q = rotation_between(from, to);
    CHECK(std::abs(q.norm() - 1) < 1e-12);
    CHECK((q * from.normalized() - to.normalized()).norm() < 1e-9);
    const double angle = std::atan2(from.cross(to).norm(), from.dot(to));
    CHECK(Eigen::AngleAxisd(q).angle() == doctest::Approx(angle));
  };
  for (int i = 0; i < 500; ++i) {
    const Vector3d from = random.uniform(0.1, 10) * random.direction();
    check(from, random.uniform(0.1, 10) * random.direction());
    check(from, 2 * from);
    check(from, -3 * from);
    check(from, 1e-4 * random.direction() - from);
  }
}
