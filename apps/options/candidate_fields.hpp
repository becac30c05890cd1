#pragma once

#include "options/field.hpp"
#include "vantage/planner/view_candidates.hpp"
#include "vantage/planner/view_constraints.hpp"

namespace vantage {

// The kinds of candidates, and where the camera may be. The descriptions point into what they
// describe; boxes, paths and lists of poses are not among the fields.

FieldGroup fields_of(HalfSpheres& spheres);
FieldGroup fields_of(BoxGrid& grid);
FieldGroup fields_of(AroundPath& around);
FieldGroup fields_of(ViewList& list);  ///< none
FieldGroup fields_of(CandidateSet& set);

Field clearance_field(ViewConstraints& constraints);
Field floor_field(ViewConstraints& constraints);

/// By name; a body that has none (a workcell's own box, say) has no value here.
Field camera_body_field(ViewConstraints& constraints);

/// Both.
FieldGroup body_fields(ViewConstraints& constraints);

}  // namespace vantage
