#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reconstruction/synthetic_views.hpp"
#include "reference/plain_votes.hpp"
#include "support/scene_count.hpp"
#include "voting/vote_table.hpp"

namespace vantage::test {
namespace {

using reconstruction::detail::kOneVote;
using reconstruction::detail::lattice_corners;
using reconstruction::detail::VoteGrid;
using reconstruction::detail::VotePlace;
using reconstruction::detail::VoteTable;

Eigen::Vector4d random_turn(Random& random) {
  Eigen::Vector4d q(normal(random), normal(random), normal(random), normal(random));
  return 2 * q.normalized();
}

VotePlace random_place(Random& random, double half_m, std::uint32_t types) {
  VotePlace place{random.below(types), random.in_cube(half_m), random_turn(random)};
  if (random.below(2) == 0) place.turn = -place.turn;
  return place;
}

VotePlace near(const VotePlace& place, double m, double rad, Random& random) {
  VotePlace moved = place;
  moved.p_m += normal_vector(random, m);
  for (int i = 0; i < 4; ++i) moved.turn[i] += rad * normal(random);
  moved.turn = 2 * moved.turn.normalized();
  if (random.below(2) == 0) moved.turn = -moved.turn;
  return moved;
}

VoteGrid random_grid(Random& random) {
  VoteGrid grid;
  grid.origin_m = random.in_cube(1.0);
  // Quaternion products from the left and from the right: every rotation of R⁴.
  const Eigen::Quaterniond left(0.5 * random_turn(random)), right(0.5 * random_turn(random));
  for (int i = 0; i < 4; ++i) {
    const Eigen::Quaterniond axis(Eigen::Vector4d::Unit(i));
    grid.frame.col(i) = (left * axis * right).coeffs();
  }
  return grid;
}

PlainPlace in_cells(const VotePlace& place, const VoteGrid& grid) {
  return {int(place.type), place.p_m / grid.cell_m, place.turn / grid.cell_rad};
}

}  // namespace

TEST_CASE("vote lattice: corners are those that trying all of them finds, with the same shares") {
  Random random(1);
  for (std::uint32_t i = 0; i < scene_count(120); ++i) {
    const Eigen::Vector3d point = random.in_cube(2.5);
    PlainCells plain = shares_in_space(point);
    double sum = 0;
    for (const auto& corner : lattice_corners<3>(point)) {
      sum += corner.weight;
      if (corner.weight < 1e-12) continue;
      const auto& k = corner.key;
      const auto found = plain.find({k[0], k[1], k[2], -k[0] - k[1] - k[2]});
      REQUIRE(found != plain.end());
      CHECK(std::abs(found->second - corner.weight) < 1e-12);
      plain.erase(found);
    }
    CHECK(std::abs(sum - 1) < 1e-12);
    for (const auto& [key, share] : plain) CHECK(share < 1e-12);
  }
}

TEST_CASE("vote lattice: in four dimensions shares are those of the hat") {
  Random random(2);
  for (std::uint32_t i = 0; i < scene_count(500); ++i) {
    const Eigen::Vector4d point = 3 * random_turn(random);
    Eigen::Vector4d back = Eigen::Vector4d::Zero();
    for (const auto& corner : lattice_corners<4>(point)) {
      const auto& k = corner.key;
      const std::array<int, 5> x{k[0], k[1], k[2], k[3], -k[0] - k[1] - k[2] - k[3]};
      Eigen::Vector4d place;
      int sum = 0;
      for (std::size_t c = 0; c < 4; ++c) {
        sum += x[c];
        place[int(c)] =
            (sum - int(c + 1) * x[c + 1]) / std::sqrt(20.0 * double(c + 1) * double(c + 2));
      }
      back += corner.weight * place;
      CHECK((point - place).norm() < 1.2248);
      CHECK(std::abs(hat4(point - place) - corner.weight) < 1e-9);
    }
    CHECK((back - point).norm() < 1e-9);  // linear interpolation
  }
}

TEST_CASE(
    "vote table: n equal votes are n high, wherever the lattice lies, and a vote alone is 1") {
  Random random(3);
  for (std::uint32_t i = 0; i < scene_count(60); ++i) {
    VoteTable table(random_grid(random));
    const VotePlace place = random_place(random, 1, 3);
    for (int n = 1; n <= 7; ++n) {
      VotePlace same = place;
      if (n % 2 == 0) same.turn = -same.turn;
      table.add(same, kOneVote);
      CHECK(std::abs(table.height(place) - n) < 1e-4);
    }
    VotePlace far = place;
    far.p_m.x() += 2.5 * 0.02;
    CHECK(table.height(far) == 0);
    far = place;
    far.type += 1;
    CHECK(table.height(far) == 0);
  }
}

TEST_CASE("vote table: votes taken back leave nothing, in whatever order") {
  Random random(4);
  VoteTable table({});
  std::vector<VotePlace> places;
  for (int i = 0; i < 200; ++i) places.push_back(random_place(random, 0.1, 2));
  for (std::size_t i = 0; i < places.size(); ++i)
    table.add(places[i], kOneVote / 3 + std::int64_t(i));
  std::vector<double> before;
  for (const VotePlace& place : places) before.push_back(table.height(place));
  for (std::size_t i = places.size(); i-- > 100;)
    table.add(places[i], -kOneVote / 3 - std::int64_t(i));
  for (std::size_t i = 100; i < places.size(); ++i)
    table.add(places[i], kOneVote / 3 + std::int64_t(i));
  for (std::size_t i = 0; i < places.size(); ++i) CHECK(table.height(places[i]) == before[i]);
  for (std::size_t i = 0; i < places.size(); ++i)
    table.add(places[i], -kOneVote / 3 - std::int64_t(i));
  for (const VotePlace& place : places) CHECK(table.height(place) == 0);
}

TEST_CASE("vote table: has at most 20 cells for a vote, however large the space is") {
  Random random(5);
  VoteTable table({});
  for (int i = 1; i <= 2000; ++i) {
    table.add(random_place(random, 1000, 50), kOneVote);
    REQUIRE(table.cell_count() <= VoteTable::kCellsPerVote * std::size_t(i));
  }
  CHECK(table.cell_count() > 30000);  // nothing was thrown together
  CHECK(table.bytes() < table.cell_count() * 48 * 3);
}

TEST_CASE("vote table: no room for what is too far out") {
  const VoteTable table({});
  VotePlace place{0, {1, 2, 3}, {2, 0, 0, 0}};
  CHECK(table.has_room_for(place));
  place.p_m.y() = 1e7;
  CHECK_FALSE(table.has_room_for(place));
  place.p_m.y() = std::nan("");
  CHECK_FALSE(table.has_room_for(place));
}

TEST_CASE("vote table: no rotation is special – what two near votes share depends on how near") {
  Random random(6);
  const VoteGrid grid;
  // Means over many directions, around rotations that charts have trouble with and around others.
  std::vector<Eigen::Vector4d> middles{
      {2, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 0, 2}, {1, 1, 1, 1}, {0, 1.414, 1.414, 0}};
  for (int i = 0; i < 5; ++i) middles.push_back(random_turn(random));
  for (const double rad : {0.1, 0.2, 0.35}) {
    double least = 1e9, most = 0;
    for (const Eigen::Vector4d& middle : middles) {
      double sum = 0;
      for (int n = 0; n < 3000; ++n) {
        VotePlace a{0, random.in_cube(0.1), middle + 0.4 * random_turn(random)};
        a.turn = 2 * a.turn.normalized();
        VotePlace b = a;
        Eigen::Vector4d step = random_turn(random);
        step -= step.dot(a.turn) / 4 * a.turn;
        b.turn = -2 * (a.turn + rad * step.normalized()).normalized();
        VoteTable table(grid);
        table.add(a, kOneVote);
        sum += table.height(b);
      }
      least = std::min(least, sum);
      most = std::max(most, sum);
    }
    CAPTURE(rad);
    CHECK(most < 1.2 * least);
    CHECK(least > 0);
  }
}

TEST_CASE("vote table: the highest vote lies in the cluster that all votes together make densest") {
  Random random(7);
  std::size_t right = 0, scenes = scene_count(60), grids = 5;
  for (std::size_t s = 0; s < scenes; ++s) {
    std::vector<VotePlace> votes;
    std::vector<int> cluster;
    for (int c = 0; c < 5; ++c) {
      const VotePlace middle = random_place(random, 0.2, 2);
      for (int n = 0; n < 4 + 4 * c; ++n) {
        votes.push_back(near(middle, 0.003, 0.04, random));
        cluster.push_back(c);
      }
    }
    for (int n = 0; n < 60; ++n) {
      votes.push_back(random_place(random, 0.2, 2));
      cluster.push_back(-1);
    }
    std::vector<PlainPlace> plain;
    for (const VotePlace& vote : votes) plain.push_back(in_cells(vote, {}));
    std::vector<double> dense;
    for (const PlainPlace& at : plain) dense.push_back(density(plain, at, 0.45));
    const auto highest = [](const std::vector<double>& of) {
      return std::size_t(std::max_element(of.begin(), of.end()) - of.begin());
    };
    for (std::size_t g = 0; g < grids; ++g) {
      VoteTable table(random_grid(random));
      for (const VotePlace& vote : votes) table.add(vote, kOneVote);
      std::vector<double> heights;
      for (const VotePlace& vote : votes) heights.push_back(table.height(vote));
      const std::size_t top = highest(heights);
      right += cluster[top] == cluster[highest(dense)];
      CHECK(cluster[top] >= 0);
      CHECK(heights[top] > 0.6 * dense[highest(dense)]);
      CHECK(heights[top] < 1.7 * dense[highest(dense)]);
    }
  }
  CHECK(right >= scenes * grids * 9 / 10);
}

}  // namespace vantage::test
