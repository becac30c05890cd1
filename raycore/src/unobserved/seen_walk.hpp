#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "scene/embree.hpp"
#include "unobserved/lattice_probe.hpp"
#include "vantage/raycore/advanced/unobserved_space.hpp"
#include "vantage/raycore/box.hpp"
#include "vantage/raycore/camera.hpp"

namespace vantage::raycore::detail {

/// A lattice's volume as a walk from one origin needs it.
struct WalkVolume {
  ProbeView probe;
  RTCScene scene;
  float apex[3];        ///< the lattice's camera, relative to the rays' origin
  float step;           ///< what is thinner than this may be taken for seen
  bool from_apex;       ///< rays start at the lattice's camera: they cross neither border nor wall
  float clear_depth;    ///< no surface is nearer to the camera; in metres along its axis
  std::uint32_t index;  ///< of the lattice
};

/// The shell that nothing outside of counts as unseen, if there is one.
struct WalkShell {
  RTCScene scene = nullptr;
  float origin[3] = {};  ///< of the rays, in the world
};

/// What all walks from one camera share.
struct WalkJob {
  WalkShell shell;
  std::vector<WalkVolume> volumes;
  float box_min[3], box_max[3];  ///< relative to the rays' origin
  float t_far;
  float step;  ///< as a volume's, for the box
};

void walk_tiles(const WalkJob& job, const PinholeCamera& camera, std::span<const PixelTile> tiles,
                UnseenHits* hits);

}  // namespace vantage::raycore::detail
