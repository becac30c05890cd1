#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

namespace vantage::raycore::detail {

/// A glTF 2.0 taken apart: the JSON, and the binary chunk of a GLB, which is empty for a .gltf.
struct GltfFile {
  nlohmann::json json;
  std::span<const std::uint8_t> binary;
};

/// Nothing is built from JSON that is nested deeper than 64, or that has more than 8 million
/// values.
/// @param bytes have to outlive the result.
/// @throws Error bad_input for glTF 1, for sizes that do not fit, and for what is no JSON;
/// out_of_resources for more values.
GltfFile open_gltf(std::span<const std::uint8_t> bytes, const std::string& file);

}  // namespace vantage::raycore::detail
