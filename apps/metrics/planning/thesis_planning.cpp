#include "metrics/planning/thesis_planning.hpp"

#include <algorithm>

namespace vantage {
namespace {

// The Wall has two cameras (4.1.1): "front", which chapter 9 calls the side one, and "top".
constexpr std::string_view kWallSide = "wall:front", kWallTop = "wall:top",
                           kPillars = "two_pillars:front", kCorridor = "corridor:left,right";

constexpr std::array<ThesisPick, 12> kPicks{{
    {kWallSide, "Wall, side", "voxel", 9.43e-4, 9.43e-4, 1, 234.8, 1, 0.76},
    {kWallSide, "Wall, side", "shadowD6", 1.99e6, 9.43e-4, 1, 107.6, 1, 0.60},
    {kWallSide, "Wall, side", "mesh", 2.23e6, 9.43e-4, 1, 74.4, 1, 3.2},
    {kWallTop, "Wall, top", "voxel", 3.23e-4, 3.23e-4, 1, 174.9, 1, 0.62},
    {kWallTop, "Wall, top", "shadowD6", 0.796e6, 3.16e-4, 0.980, 100.9, 0.99, 0.51},
    {kWallTop, "Wall, top", "mesh", 0.559e6, 2.49e-4, 0.770, 52.2, 0.98, 2.6},
    {kPillars, "TwoPillars", "voxel", 22.81e-4, 22.81e-4, 1, 480.9, 1, 1.1},
    {kPillars, "TwoPillars", "shadowD6", 3.93e6, 22.71e-4, 0.996, 150.9, 0.96, 0.62},
    {kPillars, "TwoPillars", "mesh", 4.62e6, 20.87e-4, 0.915, 86.5, 1.09, 3.8},
    {kCorridor, "Corridor, both sides", "voxel", 6.20e-4, 6.20e-4, 1, 272.8, 1, 0.90},
    {kCorridor, "Corridor, both sides", "shadowD6", 1.49e6, 5.97e-4, 0.964, 152.3, 0.99, 0.72},
    {kCorridor, "Corridor, both sides", "mesh", 1.43e6, 5.95e-4, 0.960, 72.5, 0.99, 7.0},
}};

constexpr std::array<ThesisMean, 3> kMeans{{
    {"voxel", 1, 290.9, 1, 0.85},
    {"shadowD6", 0.985, 127.9, 0.99, 0.61},
    {"mesh", 0.911, 71.4, 1.02, 4.2},
}};

constexpr std::array<ThesisServo, 4> kServos{{
    {"9.1",
     kWallSide,
     "shadowD6",
     {{{0.011e6, 5.67e-4, 0.601},
       {1.51e6, 9.43e-4, 1},
       {1.66e6, 9.43e-4, 1},
       {1.56e6, 9.43e-4, 1},
       {1.99e6, 9.43e-4, 1},
       {1.56e6, 9.43e-4, 1}}}},
    {"9.2",
     kCorridor,
     "shadowD6",
     {{{0.019e6, 1.92e-4, 0.311},
       {1.26e6, 5.29e-4, 0.854},
       {1.49e6, 5.97e-4, 0.964},
       {1.07e6, 5.87e-4, 0.948},
       {1.43e6, 5.91e-4, 0.953},
       {1.18e6, 5.87e-4, 0.948}}}},
    {"9.3",
     kCorridor,
     "shadowD3",
     {{{0.082e6, 1.17e-4, 0.188},
       {0.158e6, 1.38e-4, 0.223},
       {1.85e6, 5.72e-4, 0.923},
       {3.48e6, 5.90e-4, 0.952},
       {1.41e6, 5.67e-4, 0.914},
       {3.72e6, 5.90e-4, 0.952}}}},
    {"9.4",
     kCorridor,
     "shadowD0",
     {{{1.05e6, 3.01e-4, 0.485},
       {22.94e6, 2.60e-4, 0.420},
       {3.58e6, 5.97e-4, 0.964},
       {4.42e6, 5.97e-4, 0.964},
       {3.44e6, 5.97e-4, 0.964},
       {4.39e6, 5.97e-4, 0.964}}}},
}};

template <class Row>
const Row* row_of(std::span<const Row> rows, std::string_view scene, std::string_view method) {
  const auto row = std::ranges::find_if(
      rows, [&](const Row& r) { return r.scene == scene && r.method == method; });
  return row == rows.end() ? nullptr : &*row;
}

}  // namespace

std::span<const ThesisPick> thesis_picks() {
  return kPicks;
}

const ThesisPick* thesis_pick(std::string_view scene, std::string_view method) {
  return row_of(thesis_picks(), scene, method);
}

std::span<const ThesisMean> thesis_means() {
  return kMeans;
}

const ThesisMean* thesis_mean(std::string_view method) {
  const auto mean = std::ranges::find(kMeans, method, &ThesisMean::method);
  return mean == kMeans.end() ? nullptr : &*mean;
}

std::span<const ThesisServo> thesis_servos() {
  return kServos;
}

const ThesisServo* thesis_servo(std::string_view scene, std::string_view method) {
  return row_of(thesis_servos(), scene, method);
}

}  // namespace vantage
