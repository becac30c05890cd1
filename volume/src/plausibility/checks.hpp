#pragma once

#include <string>
#include <vector>

#include "plausibility/samples.hpp"
#include "vantage/raycore/box.hpp"
#include "vantage/raycore/world_model.hpp"

namespace vantage::volume::detail {

/// A camera with what is known of it by samples.
struct SampledCamera {
  const DepthCamera* camera;
  double coverage = 0;  ///< share of the work area's samples that fall into the image
  std::vector<DepthSample> depths = {};  ///< empty without depth
};

using Findings = std::vector<std::string>;

/// Cameras of which the image does not show the work area, or that are of another resolution.
void check_views(const std::vector<SampledCamera>& cameras, const Box& work_area,
                 Findings& findings);

/// Depth images without readings, without any in the range or the work area, or in coarse steps.
void check_depths(const std::vector<SampledCamera>& cameras, double voxel_size_m,
                  Findings& findings);

/// Depth images that see through what another one measured.
void check_agreement(const std::vector<SampledCamera>& cameras, const Box& work_area,
                     Findings& findings);

/// Cameras inside solids; objects of another unit than the work area; the work area's own size.
void check_objects(const WorldModel& world, const Box& work_area, double voxel_size_m,
                   Findings& findings);

}  // namespace vantage::volume::detail
