#pragma once

#include <map>
#include <string>

namespace vantage::bench {

/// What a probe measured, by name.
using Figures = std::map<std::string, double>;

/// The first argument that makes this program a probe.
inline constexpr const char* kProbe = "--probe";

/// Classifies `scene` ("wall", "cell" or "objects") on two threads in a fresh process, so that the
/// peak memory is that of the classification. Figures: base_mb and peak_mb (resident), ms
/// (median of three, from world model to grid), voxels, shadow, occupied.
Figures run_probe(const std::string& scene, const std::string& mode, double voxel_size_m);

/// The other side: measures, and prints the figures.
/// @param arguments scene, mode ("mesh" or "voxels") and voxel size.
int answer_probe(char** arguments);

}  // namespace vantage::bench
