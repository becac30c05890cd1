#pragma once

#include "vantage/planner/plan.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/image.hpp"
#include "vantage/raycore/world_model.hpp"

namespace vantage {

/// Writes on a plan's overview what its colours mean, in the corner where it hides the least; and
/// the number of each suggested camera on its body, if there are several. A picture that is too
/// small for words to be read stays as it is.
void add_legend(ColorImage& overview, const Plan& plan, const WorldModel& world,
                const PinholeCamera& camera);

}  // namespace vantage
