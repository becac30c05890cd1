#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesh/decoder/child_process.hpp"
#include "mesh/mesh_builder.hpp"

namespace vantage::raycore::detail {

/// What a decoder's process sends: a mesh, or why there is none.
struct PolygonSoup {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::uint32_t> polygons;  ///< each: the number of corners, then their points' indices
  UpAxis up = UpAxis::z;
  std::string fault;  ///< if it is not empty, there is no mesh
};

/// In the child. Returns early if the pipe is closed.
void send(int pipe, const PolygonSoup& soup);

/// Takes what a child sends into the builder, and trusts none of it: sizes are limited to 512 MiB,
/// indices are checked.
/// @throws Error bad_input with the child's fault; out_of_resources beyond the limit.
/// @returns false if the message breaks off: `child.end()` says why.
bool receive(ChildProcess& child, MeshBuilder& mesh);

}  // namespace vantage::raycore::detail
