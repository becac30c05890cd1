#pragma once

#include "scoring/mesh/mesh_pixels.hpp"
#include "vantage/planner/view_scorer.hpp"
#include "vantage/raycore/camera.hpp"

namespace vantage::detail {

/// What the pixels of a view may show of the volume behind the unseen surfaces that they meet: of
/// each pixel on the image (1 - v) (E³ - D³) / far³, in steps of 2^-35. D is where its ray meets
/// unseen space, or near; E is where that ends (`UnseenHits::end`), a known object is, or far.
/// A pixel of one step of depth spans D² dD / (fx fy), so that a sum is a volume times 3 fx fy.
///
/// What the ray passes between D and E and a camera saw through counts, too: it is what the view
/// reveals at most. A pixel counts no more than (E / far)³.
Score unseen_volume(const PinholeCamera& view, const MeshTiles& tiles);

}  // namespace vantage::detail
