#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "documents/document_value.hpp"
#include "vantage/planner/view_candidates.hpp"
#include "vantage/planner/view_constraints.hpp"

namespace vantage {

/// The half-spheres of a set, `production` or `full`, at other radii if any are given: the full set
/// then shares its 1,369 positions out among them.
HalfSpheres half_spheres_of(std::string_view set, const std::vector<double>& radii_m);

/// What a workcell's `candidates` says. Files that it names are relative to `folder`, and added to
/// `files`.
/// @throws Error bad_input for keys of more than one kind of candidates, a box without volume, and
/// views as `read_views` does.
CandidateSet read_candidates(const Value& value, const std::filesystem::path& folder,
                             std::vector<std::filesystem::path>& files);

/// What a workcell (`root`) says of where the movable camera may be: `reach`, `view_cone`,
/// `camera_body` and `clearance_m`.
/// @param usual the limits where it says nothing.
/// @throws Error bad_input for a shell the wrong way round, a box without volume, a cone without a
/// direction, and a map as `read_npy_bytes` does.
ViewConstraints read_constraints(const Value& root, const std::filesystem::path& folder,
                                 const ViewConstraints& usual,
                                 std::vector<std::filesystem::path>& files);

}  // namespace vantage
