#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "mesh/mesh_builder.hpp"

namespace vantage::raycore::detail {

// The readers behind read_mesh, one for each format. Each takes the file's bytes and fills the
// builder, which knows the file's name. They allocate no more than a small multiple of the file's
// size, whatever the file claims. All throw Error bad_input.

void read_stl(std::span<const std::uint8_t> bytes, MeshBuilder& mesh);
void read_ply(std::span<const std::uint8_t> bytes, MeshBuilder& mesh);
void read_obj(std::span<const std::uint8_t> bytes, MeshBuilder& mesh);
void read_off(std::span<const std::uint8_t> bytes, MeshBuilder& mesh);

/// glTF 2.0, as text or binary (GLB): the bytes tell. Takes the path for the buffers in files
/// beside it.
void read_gltf(std::span<const std::uint8_t> bytes, const std::filesystem::path& path,
               MeshBuilder& mesh);

/// For DAE, FBX, 3DS and 3MF. Takes the path for the format, and for files beside it.
void read_with_assimp(std::span<const std::uint8_t> bytes, const std::filesystem::path& path,
                      MeshBuilder& mesh);

inline std::string_view as_text(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace vantage::raycore::detail
