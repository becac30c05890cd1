// Packets that are asked for one by one give what batches give.

#include <doctest/doctest.h>

#include <limits>

#include "reference/random_scene.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"
#include "vantage/raycore/camera.hpp"

namespace vantage {
namespace {

constexpr std::uint32_t kPackets = 40;

struct Batch {
  test::Random random;
  Points points;
  std::vector<std::uint32_t> packets;
  std::vector<std::uint16_t> wanted, masks;

  explicit Batch(std::uint32_t seed) : random(seed), points(kPackets * kPacketWidth + 5) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      points.set(i, random.in_cube(1).cast<float>());
    }
    for (int i = 0; i < 25; ++i) {  // in any order, some twice
      packets.push_back(random.below(kPackets));
      wanted.push_back(i == 3 ? std::uint16_t(0) : std::uint16_t(random.below(0x10000)));
    }
    masks.resize(packets.size());
  }

  std::size_t point(std::size_t i, std::size_t lane) const {
    return packets[i] * kPacketWidth + lane;
  }
};

bool bit(std::uint16_t mask, std::size_t lane) {
  return (mask >> lane & 1) != 0;
}

}  // namespace

TEST_CASE("bits of packets in view are the batch's flags") {
  std::size_t in = 0, out = 0;
  for (std::uint32_t seed = 0; seed < test::scene_count(30); ++seed) {
    Batch batch(seed);
    const Eigen::Vector3d eye = batch.random.uniform(0.1, 3) * batch.random.direction();
    const PinholeCamera camera({64, 48, 60, 70, 30.5, 23.5},
                               Pose::looking_at(eye, batch.random.in_cube(0.5)), {0.2, 2});
    std::vector<std::uint8_t> flags(batch.points.size());
    camera.in_view(batch.points, flags);
    camera.in_view(batch.points, batch.packets, batch.masks);
    for (std::size_t i = 0; i < batch.packets.size(); ++i) {
      for (std::size_t lane = 0; lane < kPacketWidth; ++lane) {
        REQUIRE(bit(batch.masks[i], lane) == (flags[batch.point(i, lane)] != 0));
        ++(bit(batch.masks[i], lane) ? in : out);
      }
    }
  }
  CHECK(in > test::enough(1000));
  CHECK(out > test::enough(1000));
}

TEST_CASE("bits of packets that are occluded are the batch's flags, where they are wanted") {
  std::size_t hidden = 0, open = 0;
  for (std::uint32_t seed = 0; seed < test::scene_count(30); ++seed) {
    const test::RandomScene s = test::random_scene(seed, seed % 2 == 1);
    Batch batch(seed);
    const Eigen::Vector3f to = (2 * batch.random.direction()).cast<float>();
    std::vector<std::uint8_t> flags(batch.points.size());
    s.scene->occluded(batch.points, to, flags);
    s.scene->occluded(batch.points, to, batch.packets, batch.wanted, batch.masks);
    for (std::size_t i = 0; i < batch.packets.size(); ++i) {
      for (std::size_t lane = 0; lane < kPacketWidth; ++lane) {
        const bool wanted = bit(batch.wanted[i], lane);
        REQUIRE(bit(batch.masks[i], lane) == (wanted && flags[batch.point(i, lane)] != 0));
        if (wanted) ++(bit(batch.masks[i], lane) ? hidden : open);
      }
    }
  }
  CHECK(hidden > test::enough(1000));
  CHECK(open > test::enough(1000));
}

TEST_CASE("incomplete packets, spans of different sizes and invalid rays are refused") {
  const test::RandomScene s = test::random_scene(1, false);
  Batch batch(1);
  const Eigen::Vector3f to(2, 0, 0);
  const PinholeCamera camera({64, 48, 60, 70, 30.5, 23.5}, Pose());
  const auto occlude = [&] {
    s.scene->occluded(batch.points, to, batch.packets, batch.wanted, batch.masks);
  };
  const auto look = [&] { camera.in_view(batch.points, batch.packets, batch.masks); };

  const std::size_t bad = batch.point(7, 3);
  batch.points.set(bad, {0, std::numeric_limits<float>::quiet_NaN(), 0});
  for (std::uint16_t& wanted : batch.wanted) wanted = std::uint16_t(~(1u << 3));
  occlude();  // nobody asks
  batch.wanted[7] = 1u << 3;
  test::expect_bad_input("segment " + std::to_string(bad), "nan", occlude);
  batch.points.set(bad, to);
  test::expect_bad_input("segment " + std::to_string(bad), "two different points", occlude);

  batch.packets[4] = kPackets;  // only five points of it
  test::expect_bad_input("batch", "packet 40 of 645 points", occlude);
  test::expect_bad_input("batch", "packet 40 of 645 points", look);
  batch.masks.pop_back();
  test::expect_bad_input("batch", "24 elements; expected 25", occlude);
  test::expect_bad_input("batch", "24 elements; expected 25", look);
}

}  // namespace vantage
