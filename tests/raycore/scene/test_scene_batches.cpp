// Batches of every awkward size give what single rays give, and refuse what single rays refuse.

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "reference/random_scene.hpp"
#include "support/expect_error.hpp"
#include "support/non_finite.hpp"

using namespace vantage;
using namespace vantage::test;

namespace {

constexpr std::size_t kSizes[] = {0, 1, 15, 16, 17, 1023, 1024, 1025, 5000};

Points random_points(Random& random, std::size_t size, double half) {
  Points points(size);
  for (std::size_t i = 0; i < size; ++i) points.set(i, random.in_cube(half).cast<float>());
  return points;
}

/// Compares hit `i` of a batch with the single ray's. Another triangle may be named, and hit or
/// miss may differ, only where the twin calls it close.
int check_against_single(const RandomScene& s, const Ray& ray, const Hits& hits, std::size_t i) {
  const std::optional<Hit> single = s.scene->closest_hit(ray);
  if (single.has_value() != hits.hit(i) ||
      (single && (single->object != hits.object[i] || single->triangle != hits.triangle[i]))) {
    CHECK(s.reference.closest_hit(ray.origin, ray.direction, 0, kInfinity).close_call);
    return 1;
  }
  if (!single) {
    CHECK(hits.t[i] == kInfinity);
    CHECK((hits.object[i] == kNoObject && hits.triangle[i] == 0));
    CHECK((hits.u[i] == 0 && hits.v[i] == 0 && hits.normal[i].isZero(0)));
    return 0;
  }
  CHECK(hits.t[i] == doctest::Approx(single->t).epsilon(1e-5));
  CHECK(std::abs(hits.u[i] - single->u) < 1e-3f);
  CHECK(std::abs(hits.v[i] - single->v) < 1e-3f);
  CHECK(hits.normal[i].isApprox(single->normal, 1e-5f));
  return 0;
}

/// The place that `action` refuses, e.g. "ray 17".
template <class Action>
std::string refused_place(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::bad_input);
    CHECK(error.message().find("expected") != std::string::npos);
    return error.where();
  }
  return "nothing";
}

struct Bad {
  Eigen::Vector3f point;
  std::string shown;  // in the message
};

const Bad kBadPoints[] = {{{kNaN, 0, 0}, "nan"},           {{0, kNaN, 0}, "nan"},
                          {{0, 0, kNaN}, "nan"},           {{kInfinity, 0, 0}, "inf"},
                          {{0, -kInfinity, 0}, "-inf"},    {{0, 0, 1.1e9f}, "1100000000"},
                          {{-1.1e9f, 0, 0}, "-1100000000"}};

struct Batches {
  RandomScene s = random_scene(11, true);
  Random random{12};
  Points origins = random_points(random, 2100, 1.2);
  Points others = random_points(random, 2100, 1.2);  // end points, or directions
  std::vector<std::uint8_t> result = std::vector<std::uint8_t>(2100);
  Hits hits;

  std::string occlude() {
    return refused_place([&] { s.scene->occluded(origins, others, result); });
  }
  std::string occlude_to_point() {
    return refused_place([&] { s.scene->occluded(origins, Eigen::Vector3f(2, 0, 0), result); });
  }
  std::string hit() {
    return refused_place([&] { s.scene->closest_hits(origins, others, hits); });
  }
  std::string hit_from_point() {
    return refused_place([&] { s.scene->closest_hits(Eigen::Vector3f(2, 0, 0), others, hits); });
  }
};

}  // namespace

TEST_CASE("batches of closest hits agree with single rays at every size") {
  int close_calls = 0, rays = 0;
  for (const bool with_instances : {false, true}) {
    const RandomScene s = random_scene(with_instances ? 21 : 20, with_instances);
    Random random(5);
    for (const std::size_t size : kSizes) {
      const Points origins = random_points(random, size, 1.2);
      const Points directions = random_points(random, size, 1);
      const Eigen::Vector3f eye = random.in_cube(1).cast<float>();
      CAPTURE(size);
      for (const RayOrder order : {RayOrder::incoherent, RayOrder::coherent}) {
        Hits hits, from_eye;
        s.scene->closest_hits(origins, directions, hits, order);
        s.scene->closest_hits(eye, directions, from_eye, order);
        REQUIRE((hits.size() == size && from_eye.size() == size));
        for (std::size_t i = 0; i < size; ++i, rays += 2) {
          CAPTURE(i);
          close_calls += check_against_single(s, {origins[i], directions[i]}, hits, i);
          close_calls += check_against_single(s, {eye, directions[i]}, from_eye, i);
        }
      }
    }
  }
  CHECK(close_calls * 1000 < rays);
}

TEST_CASE("batches of segments agree with single ones at every size") {
  int close_calls = 0, rays = 0;
  for (const bool with_instances : {false, true}) {
    const RandomScene s = random_scene(with_instances ? 31 : 30, with_instances);
    Random random(6);
    for (const std::size_t size : kSizes) {
      const Points from = random_points(random, size, 1.2), to = random_points(random, size, 1.2);
      const Eigen::Vector3f eye = random.in_cube(1).cast<float>();
      CAPTURE(size);
      for (const RayOrder order : {RayOrder::incoherent, RayOrder::coherent}) {
        // One element more than there are rays: it must stay as it is.
        std::vector<std::uint8_t> pairs(size + 1, 77), to_eye(size + 1, 77);
        s.scene->occluded(from, to, {pairs.data(), size}, order);
        s.scene->occluded(from, eye, {to_eye.data(), size}, order);
        CHECK((pairs[size] == 77 && to_eye[size] == 77));
        const auto check = [&](const Eigen::Vector3f& a, const Eigen::Vector3f& b, int batch) {
          ++rays;
          if (s.scene->occluded(a, b) == (batch == 1) && batch <= 1) return;
          CHECK(s.reference.occluded(a, b).close_call);
          ++close_calls;
        };
        for (std::size_t i = 0; i < size; ++i) {
          CAPTURE(i);
          check(from[i], to[i], pairs[i]);
          check(from[i], eye, to_eye[i]);
        }
      }
    }
  }
  CHECK(close_calls * 1000 < rays);
}

TEST_CASE("a bad ray is refused in every lane and in every block, by its index") {
  Batches b;
  REQUIRE(b.occlude() == "nothing");
  REQUIRE(b.hit() == "nothing");
  for (const std::size_t at : {0,  1,  2,  3,  4,  5,  6,   7,    8,    9,    10,   11,   12,
                               13, 14, 15, 16, 31, 32, 500, 1023, 1024, 1039, 2048, 2098, 2099}) {
    const Bad& bad = kBadPoints[at % std::size(kBadPoints)];
    const std::string segment = "segment " + std::to_string(at), ray = "ray " + std::to_string(at);
    CAPTURE(at);
    const Eigen::Vector3f good_origin = b.origins[at], good_other = b.others[at];

    b.origins.set(at, bad.point);
    CHECK(b.occlude() == segment);
    CHECK(b.occlude_to_point() == segment);
    CHECK(b.hit() == ray);
    b.origins.set(at, good_origin);

    b.others.set(at, bad.point);
    CHECK(b.occlude() == segment);
    CHECK(b.hit() == ray);
    CHECK(b.hit_from_point() == ray);

    b.others.set(at, {0, 0, 0});
    CHECK(b.hit() == ray);
    CHECK(b.hit_from_point() == ray);
    b.others.set(at, good_origin);
    CHECK(b.occlude() == segment);
    b.others.set(at, good_other);
  }
  CHECK(b.occlude() == "nothing");
  CHECK(b.hit() == "nothing");
}

TEST_CASE("of several bad rays the first is named, at any number of them") {
  Batches b;
  for (const std::size_t at : {2099, 2050, 1100, 1030, 20, 18}) {
    b.origins.set(at, {kNaN, 0, 0});
    CHECK(b.occlude() == "segment " + std::to_string(at));
    CHECK(b.hit() == "ray " + std::to_string(at));
  }
}

TEST_CASE("a bad common point is refused with the first ray") {
  Batches b;
  for (const Bad& bad : kBadPoints) {
    expect_bad_input("segment 0", bad.shown,
                     [&] { b.s.scene->occluded(b.origins, bad.point, b.result); });
    expect_bad_input("ray 0", bad.shown,
                     [&] { b.s.scene->closest_hits(bad.point, b.others, b.hits); });
  }
}

TEST_CASE("a single bad ray is refused, with what was found and what was expected") {
  const auto scene = random_scene(1, false).scene;
  const Eigen::Vector3f good(0.1f, 0.2f, 0.3f);
  for (const Bad& bad : kBadPoints) {
    expect_bad_input("segment 0", bad.shown, [&] { (void)scene->occluded(bad.point, good); });
    expect_bad_input("segment 0", bad.shown, [&] { (void)scene->occluded(good, bad.point); });
    expect_bad_input("ray 0", bad.shown, [&] { (void)scene->closest_hit({bad.point, good}); });
    expect_bad_input("ray 0", bad.shown, [&] { (void)scene->closest_hit({good, bad.point}); });
  }
  expect_bad_input("segment 0", "two different points", [&] { (void)scene->occluded(good, good); });
  expect_bad_input("ray 0", "not zero", [&] { (void)scene->closest_hit({good, {0, 0, 0}}); });
  for (const auto& [t_near, t_far] :
       {std::pair{-1.f, 1.f}, {2.f, 1.f}, {kNaN, 1.f}, {0.f, kNaN}, {0.f, -kInfinity}}) {
    expect_bad_input("ray 0", "t_near <= t_far", [&, n = t_near, f = t_far] {
      (void)scene->closest_hit({good, good, n, f});
    });
  }
}

TEST_CASE("far but allowed coordinates and very short rays are traced without harm") {
  const auto scene = random_scene(1, true).scene;
  for (const float far : {1e6f, 1e9f}) {
    CHECK_NOTHROW((void)scene->occluded({-far, far, far}, {far, -far, -far}));
    CHECK_NOTHROW((void)scene->closest_hit({{far, far, far}, {-far, -far, -far}}));
  }
  for (const float tiny : {1e-20f, 1e-38f, 1e-45f}) {
    CHECK_NOTHROW((void)scene->occluded({0, 0, 0}, {tiny, 0, 0}));
    CHECK_NOTHROW((void)scene->closest_hit({{0, 0, 0}, {0, tiny, tiny}}));
    Points origins(20), ends(20);
    ends.x.assign(20, tiny);
    std::vector<std::uint8_t> result(20);
    Hits hits;
    CHECK_NOTHROW(scene->occluded(origins, ends, result));
    CHECK_NOTHROW(scene->closest_hits(origins, ends, hits));
  }
}

TEST_CASE("arrays of different sizes are refused with both sizes") {
  const auto scene = random_scene(1, false).scene;
  const Points three(3), four(4);
  std::vector<std::uint8_t> result(4);
  Hits hits;
  expect_bad_input("batch", "3 elements; expected 4",
                   [&] { scene->occluded(four, three, result); });
  expect_bad_input("batch", "4 elements; expected 3",
                   [&] { scene->occluded(three, three, result); });
  expect_bad_input("batch", "4 elements; expected 3",
                   [&] { scene->occluded(three, Eigen::Vector3f(1, 1, 1), result); });
  expect_bad_input("batch", "3 elements; expected 4",
                   [&] { scene->closest_hits(three, four, hits); });
}
