#include "mesh/gltf/gltf_file.hpp"

#include <fmt/format.h>

#include <bit>
#include <string_view>

#include "core/byte_order.hpp"
#include "mesh/text_scanner.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage::raycore::detail {
namespace {

constexpr std::size_t kMaxDepth = 64;
constexpr std::size_t kMaxValues = 8'000'000;
constexpr std::uint32_t kJson = 0x4E4F534A, kBinary = 0x004E4942;

/// Before anything is built: the parser itself would go as deep as the text does.
void check_json_size(std::string_view text, const std::string& file) {
  std::size_t depth = 0, values = 1;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '\\') ++i;
      if (c == '"') quoted = false;
      continue;
    }
    if (c == '"') quoted = true;
    if (c == ',' || c == ':') ++values;
    if (c == '[' || c == '{') ++depth, ++values;
    if ((c == ']' || c == '}') && depth > 0) --depth;
    if (depth > kMaxDepth) {
      throw bad_input(
          file,
          fmt::format("its JSON is nested deeper than {} at byte {}; it is damaged", kMaxDepth, i));
    }
  }
  if (values <= kMaxValues) return;
  throw Error(ErrorCode::out_of_resources, file,
              fmt::format("its JSON has about {} values; at most {} are read", values, kMaxValues));
}

nlohmann::json parse(std::string_view text, const std::string& file) {
  check_json_size(text, file);
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& error) {
    throw bad_input(file, fmt::format("its JSON cannot be read: {}", in_quotes(error.what())));
  }
}

std::uint32_t word_at(std::span<const std::uint8_t> bytes, std::size_t at) {
  return load<std::uint32_t>(bytes.data() + at, std::endian::little);
}

/// A chunk's bytes, and what follows it.
struct Chunk {
  std::uint32_t type;
  std::span<const std::uint8_t> bytes, rest;
};

Chunk next_chunk(std::span<const std::uint8_t> bytes, const std::string& file) {
  if (bytes.size() < 8) {
    throw bad_input(file, "ends where a chunk of the binary glTF should begin; it is truncated");
  }
  const std::uint32_t size = word_at(bytes, 0);
  if (size > bytes.size() - 8) {
    throw bad_input(file,
                    fmt::format("has a chunk of {} bytes; {} are left, so the file is truncated "
                                "or damaged",
                                size, bytes.size() - 8));
  }
  return {word_at(bytes, 4), bytes.subspan(8, size), bytes.subspan(8 + size)};
}

GltfFile open_glb(std::span<const std::uint8_t> bytes, const std::string& file) {
  if (bytes.size() < 12) throw bad_input(file, "ends within the header; it is truncated");
  if (const std::uint32_t version = word_at(bytes, 4); version != 2) {
    throw bad_input(file,
                    fmt::format("is binary glTF of version {}; expected version 2: convert it, "
                                "for example with gltf-pipeline or Blender",
                                version));
  }
  if (const std::uint32_t length = word_at(bytes, 8); length > bytes.size() || length < 12) {
    throw bad_input(file, fmt::format("states a length of {} bytes and has {}; it is truncated or "
                                      "damaged",
                                      length, bytes.size()));
  }
  const Chunk json = next_chunk(bytes.subspan(12, word_at(bytes, 8) - 12), file);
  if (json.type != kJson) throw bad_input(file, "has no JSON in its first chunk; it is damaged");
  const std::string_view text(reinterpret_cast<const char*>(json.bytes.data()), json.bytes.size());
  GltfFile result{parse(text, file), {}};
  if (json.rest.empty()) return result;
  if (const Chunk binary = next_chunk(json.rest, file); binary.type == kBinary) {
    result.binary = binary.bytes;
  }
  return result;
}

void check_version(const nlohmann::json& json, const std::string& file) {
  std::string version = "unknown";
  if (json.is_object() && json.contains("asset") && json["asset"].is_object()) {
    version = json["asset"]
                  .value("version", nlohmann::json("unknown"))
                  .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }
  if (version.starts_with("\"2.")) return;
  throw bad_input(file,
                  fmt::format("is glTF of the version {}; expected 2.0: convert it, for example "
                              "with gltf-pipeline or Blender",
                              in_quotes(version)));
}

}  // namespace

GltfFile open_gltf(std::span<const std::uint8_t> bytes, const std::string& file) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  GltfFile result =
      text.starts_with("glTF") ? open_glb(bytes, file) : GltfFile{parse(text, file), {}};
  check_version(result.json, file);
  return result;
}

}  // namespace vantage::raycore::detail
