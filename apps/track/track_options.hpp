#pragma once

#include "options/field.hpp"
#include "vantage/reconstruction/tracking.hpp"

namespace vantage {

/// How objects are tracked. The description points into what it describes.
FieldGroup fields_of(TrackOptions& options);

}  // namespace vantage
