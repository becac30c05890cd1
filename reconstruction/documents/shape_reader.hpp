#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "documents/document_value.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage {

/// The solid that a `shape` of a workcell or a knowledge base describes: one of solids.hpp's, or a
/// mesh file relative to `folder`, which is added to `files`.
/// @throws Error bad_input with the place of the size that makes no solid, or of the file that is
/// not there; with the mesh file for one that is damaged.
TriangleMesh read_shape(const Value& shape, const std::filesystem::path& folder,
                        std::vector<std::filesystem::path>& files);

/// Reads what the key `mesh` names: a file, or {file, unit_m, up}.
/// @param unit_m what a key beside `mesh` says, which `mesh` may say itself.
TriangleMesh read_mesh_value(const Value& mesh, const std::filesystem::path& folder,
                             std::vector<std::filesystem::path>& files,
                             const std::optional<double>& unit_m = {});

}  // namespace vantage
