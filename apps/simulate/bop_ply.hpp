#pragma once

#include <string>

#include "simulator/scene/textured_mesh.hpp"

namespace vantage {

/// The bytes of a PLY file as BOP's models are: ASCII, millimetres, a normal for each vertex (the
/// mean of its faces', weighted by their angles), and its colour, or where the mesh is textured
/// `texture_u`, `texture_v` (from the image's lower left corner, 0 to 1) and a comment that names
/// the texture.
std::string bop_ply(const TexturedMesh& shape, const std::string& name,
                    const std::string& texture_file);

}  // namespace vantage
