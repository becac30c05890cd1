#include "metrics/reconstruction/camera_subsets.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "support/expect_error.hpp"

namespace vantage {

TEST_CASE("nine cameras have 502 subsets of two and more, the same as by counting in binary") {
  const auto subsets = camera_subsets(9, 2, 9);
  CHECK(subsets.size() == 502);
  std::set<CameraSubset> by_bits;
  for (unsigned bits = 0; bits < 512; ++bits) {
    CameraSubset subset;
    for (std::size_t i = 0; i < 9; ++i) {
      if ((bits >> i & 1u) != 0) subset.push_back(i);
    }
    if (subset.size() >= 2) by_bits.insert(subset);
  }
  CHECK(std::set(subsets.begin(), subsets.end()) == by_bits);
}

TEST_CASE("small subsets first, then in lexicographic order") {
  const auto subsets = camera_subsets(4, 1, 3);
  const std::vector<CameraSubset> expected = {{0},       {1},       {2},       {3},      {0, 1},
                                              {0, 2},    {0, 3},    {1, 2},    {1, 3},   {2, 3},
                                              {0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
  CHECK(subsets == expected);
  CHECK(camera_subsets(3, 3, 3) == std::vector<CameraSubset>{{0, 1, 2}});
}

TEST_CASE("subsets that do not exist, or are too many, are refused") {
  const auto refused = [](std::size_t cameras, std::size_t least, std::size_t most) {
    test::expect_bad_input("cameras", "expected 1 to 3",
                           [&] { camera_subsets(cameras, least, most); });
  };
  refused(3, 0, 2);
  refused(3, 3, 2);
  refused(3, 2, 4);
  test::expect_error(ErrorCode::out_of_resources, "cameras", "more than 1000000 subsets",
                     [] { camera_subsets(40, 1, 40); });
}

}  // namespace vantage
