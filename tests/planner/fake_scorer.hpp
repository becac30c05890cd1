#pragma once

#include <atomic>
#include <cmath>
#include <cstring>

#include "vantage/planner/view_scorer.hpp"

namespace vantage::test {

/// A number that looks random but depends on the bits of a pose only.
inline std::uint64_t hash_of(const Pose& pose, std::uint64_t seed) {
  std::uint64_t hash = seed * 0x9E3779B97F4A7C15u + 1;
  const auto mix = [&](double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    hash ^= bits + 0x9E3779B97F4A7C15u + (hash << 6) + (hash >> 2);
    hash *= 0xBF58476D1CE4E5B9u;
    hash ^= hash >> 31;
  };
  for (int i = 0; i < 3; ++i) mix(pose.translation()[i]);
  for (int i = 0; i < 9; ++i) mix(pose.rotation()(i / 3, i % 3));
  return hash;
}

/// Scores that are hashes of the pose, 0 to `most`: small ranges have many equals. It leaves what
/// is not needed at an upper bound, as real scorers do, but not always.
class FakeScorer final : public ViewScorer {
 public:
  FakeScorer(std::uint64_t seed, Score most, Score slack)
      : seed_(seed), max_(most), slack_(slack) {}

  std::string_view name() const noexcept override { return "fake"; }
  double unit() const noexcept override { return 0.5; }
  std::string_view unit_name() const noexcept override { return "points"; }
  using ViewScorer::score;

  Score true_score(const Pose& pose) const { return hash_of(pose, seed_) % (max_ + 1); }

  Score upper_bound(const PinholeCamera& view) const override {
    return true_score(view.T_world_cam()) + hash_of(view.T_world_cam(), seed_ + 1) % (slack_ + 1);
  }

  void score(std::span<const PinholeCamera> views, std::span<const Score> needed,
             std::span<ScoreBound> results, const StopToken& stop) const override {
    for (std::size_t i = 0; i < views.size(); ++i) {
      const Pose& pose = views[i].T_world_cam();
      const Score exact = true_score(pose);
      const bool leave = exact < needed[i] && hash_of(pose, seed_ + 2) % 3 != 0;
      if (stop.stop_requested()) {
        results[i] = {};
      } else if (leave) {
        results[i] = {ScoreBound::Known::at_most, exact + (needed[i] - 1 - exact) / 2};
      } else {
        results[i] = {ScoreBound::Known::exact, exact};
        ++exact_scores_;
      }
    }
  }

  std::vector<ScoreTerm> terms(const PinholeCamera& view) const override {
    return {{"score", double(true_score(view.T_world_cam()))}};
  }

  std::size_t exact_scores() const { return exact_scores_; }

 private:
  std::uint64_t seed_;
  Score max_, slack_;
  mutable std::atomic<std::size_t> exact_scores_{0};
};

}  // namespace vantage::test
