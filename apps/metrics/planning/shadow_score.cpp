#include "metrics/planning/shadow_score.hpp"

#include <algorithm>
#include <array>

namespace vantage {
namespace {

template <class Visit>
void for_each_voxel(const Eigen::Vector3i& first, const Eigen::Vector3i& end, const Visit& visit) {
  for (int i = first.x(); i < end.x(); ++i)
    for (int j = first.y(); j < end.y(); ++j)
      for (int k = first.z(); k < end.z(); ++k) visit(Eigen::Vector3i(i, j, k));
}

std::optional<double> share(double part, double rest) {
  if (part + rest > 0) return part / (part + rest);
  return std::nullopt;
}

}  // namespace

std::optional<double> ShadowScore::precision() const {
  return share(true_m3, false_m3);
}

std::optional<double> ShadowScore::recall() const {
  return share(true_m3, missed_m3);
}

std::optional<double> ShadowScore::f1() const {
  if (!precision() || !recall()) return std::nullopt;
  return 2 * true_m3 / (2 * true_m3 + false_m3 + missed_m3);
}

TrueShadow::TrueShadow(const StateGrid& truth)
    : geometry_(truth.geometry()), kinds_(std::size_t(geometry_.voxel_count())) {
  std::vector<bool> seen(kinds_.size());
  for_each_voxel(Eigen::Vector3i::Zero(), geometry_.size(), [&](const Eigen::Vector3i& voxel) {
    const VoxelState state = truth.at(voxel);
    const std::size_t at = index(voxel);
    seen[at] = state == VoxelState::free;
    const bool hidden = truth.shadow_cause(voxel) == ShadowCause::hidden;
    kinds_[at] = seen[at] ? Kind::seen : hidden ? Kind::hidden : Kind::nothing;
  });
  mark_boundary(seen);
}

std::size_t TrueShadow::index(const Eigen::Vector3i& voxel) const {
  const Eigen::Vector3i n = geometry_.size();
  return (std::size_t(voxel.x()) * std::size_t(n.y()) + std::size_t(voxel.y())) *
             std::size_t(n.z()) +
         std::size_t(voxel.z());
}

void TrueShadow::mark_boundary(const std::vector<bool>& seen) {
  const Eigen::Vector3i one = Eigen::Vector3i::Ones();
  for_each_voxel(Eigen::Vector3i::Zero(), geometry_.size(), [&](const Eigen::Vector3i& voxel) {
    const std::size_t at = index(voxel);
    if (kinds_[at] == Kind::nothing) return;
    bool mixed = false;
    for_each_voxel((voxel - one).cwiseMax(0), (voxel + 2 * one).cwiseMin(geometry_.size()),
                   [&](const Eigen::Vector3i& other) { mixed |= seen[index(other)] != seen[at]; });
    if (mixed) kinds_[at] = Kind::boundary;
  });
}

ShadowScore TrueShadow::score(const StateGrid& found) const {
  std::array<std::uint64_t, 4> voxels{};
  const Points centres = found.centres(VoxelState::shadow);
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const auto voxel = geometry_.voxel_at(centres[i].cast<double>());
    if (voxel) ++voxels[std::size_t(kinds_[index(*voxel)])];
  }
  const auto hidden = std::uint64_t(std::ranges::count(kinds_, Kind::hidden));
  const auto volume = [&](std::uint64_t count) {
    return double(count) * geometry_.voxel_volume_m3();
  };
  const std::uint64_t found_hidden = voxels[std::size_t(Kind::hidden)];
  return {volume(found_hidden), volume(voxels[std::size_t(Kind::seen)]),
          volume(hidden - found_hidden), volume(voxels[std::size_t(Kind::boundary)])};
}

}  // namespace vantage
