#pragma once

#include <string>
#include <string_view>

#include "vantage/raycore/mesh_io.hpp"

namespace vantage::raycore::detail {

/// The <up_axis> of a COLLADA document, which is Y_UP where it says nothing. Looks at the
/// document's first one: its <asset> comes before everything else.
UpAxis collada_up(std::string_view xml);

}  // namespace vantage::raycore::detail
