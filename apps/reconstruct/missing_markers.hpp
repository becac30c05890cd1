#pragma once

#include <string>
#include <vector>

#include "vantage/reconstruction/color_image.hpp"

namespace vantage {

/// Why none of the expected markers may be seen in a picture: it is mirrored, or shows markers of
/// another dictionary. Looks through all dictionaries, which takes seconds.
/// @param dictionaries that were looked for, as `ArucoOptions` has them.
/// @returns a clause for the user; empty if nothing convincing is found.
std::string missing_markers_hint(const ColorImage& picture,
                                 const std::vector<std::string>& dictionaries);

}  // namespace vantage
