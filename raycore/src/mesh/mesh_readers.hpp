#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "mesh/mesh_builder.hpp"

namespace vantage::raycore::detail {

// The readers behind read_mesh, one for each format. Each takes the file's bytes and fills the
// collector, which knows the file's name. They allocate no more than a small multiple of the
// file's size, whatever the file claims. All throw Error bad_input.

void read_stl(std::span<const std::uint8_t> bytes, MeshCollector& mesh);
void read_ply(std::span<const std::uint8_t> bytes, MeshCollector& mesh);
void read_obj(std::span<const std::uint8_t> bytes, MeshCollector& mesh);

/// For other formats. Takes the path, as a scene may name further files beside it.
void read_with_assimp(const std::filesystem::path& path, MeshCollector& mesh);

inline std::string_view as_text(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace vantage::raycore::detail
