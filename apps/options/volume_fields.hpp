#pragma once

#include "options/field.hpp"
#include "vantage/volume/volume_options.hpp"

namespace vantage {

// How the work area is classified. The description points into what it describes.

FieldGroup fields_of(StereoNoise& noise);
FieldGroup fields_of(VolumeOptions& volume);

/// The voxel's edge, which stands beside the volume's options in files.
Field voxel_size_field(double& voxel_size_m);

}  // namespace vantage
