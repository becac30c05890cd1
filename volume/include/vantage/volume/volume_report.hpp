#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace vantage {

/// A known object that depth images see through by more than their noise explains (single voxels,
/// a thin layer): its pose or its presence is in doubt.
struct ObjectConflict {
  std::string object;
  std::uint64_t voxels = 0;     ///< of the object's voxels, those seen through
  std::uint64_t of_voxels = 0;  ///< the object's voxels in the work area
};

/// Counts of a classification in addition to the states, in voxels.
struct VolumeReport {
  /// Shadow by `ShadowCause`; the rest of it is hidden.
  std::uint64_t unmeasured_shadow = 0;
  std::uint64_t outside_shadow = 0;

  /// Shadow that anti-aliasing removed, or would have removed where it is off.
  std::uint64_t aliased_shadow = 0;

  /// Shadow that `without_false_shadow` took away.
  std::uint64_t false_shadow = 0;

  /// Objects with conflicts only, in the order of the world model (objects, then structures).
  std::vector<ObjectConflict> conflicts;

  /// Warnings for the user; each names its subject.
  std::vector<std::string> warnings;
};

}  // namespace vantage
