#include "mesh/gltf/gltf_accessors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <optional>
#include <string_view>

#include "core/byte_order.hpp"
#include "mesh/gltf/file_beside.hpp"
#include "mesh/gltf/uri.hpp"
#include "mesh/text_scanner.hpp"

namespace vantage::raycore::detail {
namespace {

// glTF's numbers for the types of components.
enum Component : std::uint64_t {
  kInt8 = 5120,
  kUint8 = 5121,
  kInt16 = 5122,
  kUint16 = 5123,
  kUint32 = 5125,
  kFloat32 = 5126,
};

std::uint64_t bytes_of(std::uint64_t component, const GltfValue& where) {
  switch (component) {
    case kInt8:
    case kUint8:
      return 1;
    case kInt16:
    case kUint16:
      return 2;
    case kUint32:
    case kFloat32:
      return 4;
    default:
      where.fail(
          fmt::format("has the componentType {}; expected 5120 to 5123, 5125 or 5126", component));
  }
}

/// Integers that stand for -1 … 1 or 0 … 1, as KHR_mesh_quantization has them.
double component_at(const std::uint8_t* bytes, std::uint64_t component, bool normalized) {
  const auto little = std::endian::little;
  const auto scaled = [&](double value, double largest) {
    return normalized ? std::max(value / largest, -1.0) : value;
  };
  switch (component) {
    case kInt8:
      return scaled(load<std::int8_t>(bytes, little), 127);
    case kUint8:
      return scaled(load<std::uint8_t>(bytes, little), 255);
    case kInt16:
      return scaled(load<std::int16_t>(bytes, little), 32767);
    case kUint16:
      return scaled(load<std::uint16_t>(bytes, little), 65535);
    case kUint32:
      return load<std::uint32_t>(bytes, little);
    default:
      return double(load<float>(bytes, little));
  }
}

/// Whether `count` elements of `size` bytes, `stride` apart, lie in `available` bytes from
/// `offset`.
bool fit(std::uint64_t count, std::uint64_t size, std::uint64_t stride, std::uint64_t offset,
         std::uint64_t available) {
  if (count == 0) return true;
  if (offset > available || available - offset < size) return false;
  return count - 1 <= (available - offset - size) / stride;
}

}  // namespace

/// What an accessor says of its elements.
struct GltfAccessors::Layout {
  std::uint64_t count, component, size;
  bool normalized;

  Layout(const GltfValue& accessor, const char* type, std::uint64_t numbers)
      : count(accessor.integer("count")),
        component(accessor.integer("componentType")),
        size(numbers * bytes_of(component, accessor)),
        normalized(accessor.truth("normalized")) {
    if (accessor.member("type").text() == type) return;
    accessor.member("type").fail(
        fmt::format("is {}; expected {}", in_quotes(accessor.member("type").text()), type));
  }
};

std::vector<std::uint8_t> GltfAccessors::load_buffer(const GltfValue& value) {
  const GltfValue uri = value.member("uri");
  const std::string_view text = uri.text();
  if (!text.starts_with("data:")) return read_file_beside(path_, without_percent(text));
  std::optional<std::vector<std::uint8_t>> bytes = data_of_uri(text);
  if (!bytes) uri.fail("is not base64 data; expected \"data:…;base64,\" and the bytes");
  return std::move(*bytes);
}

std::span<const std::uint8_t> GltfAccessors::buffer(std::uint64_t index) {
  const GltfValue value = root_.element("buffers", index);
  std::span<const std::uint8_t> bytes = binary_;
  if (index > 0 || value.has("uri")) {
    auto found = loaded_.find(index);
    if (found == loaded_.end()) {
      found = loaded_.emplace(index, load_buffer(value)).first;
      bytes_used_ += found->second.size();
    }
    bytes = found->second;
  }
  const std::uint64_t stated = value.integer("byteLength");
  if (stated > bytes.size()) {
    value.fail(fmt::format("states {} bytes; there are {}, so the file is truncated or damaged",
                           stated, bytes.size()));
  }
  return bytes.first(stated);
}

std::span<const std::uint8_t> GltfAccessors::view(std::uint64_t index, std::uint64_t& stride) {
  const GltfValue value = root_.element("bufferViews", index);
  const std::span<const std::uint8_t> bytes = buffer(value.integer("buffer"));
  const std::uint64_t offset = value.integer("byteOffset", 0), length = value.integer("byteLength");
  if (offset > bytes.size() || length > bytes.size() - offset) {
    value.fail(fmt::format("has {} bytes from byte {} on; its buffer has {}", length, offset,
                           bytes.size()));
  }
  stride = value.integer("byteStride", stride);
  return bytes.subspan(offset, length);
}

template <class Put>
void GltfAccessors::read_elements(const GltfValue& accessor, const Layout& layout, const Put& put) {
  if (accessor.has("bufferView")) {
    std::uint64_t stride = layout.size;
    const std::span<const std::uint8_t> bytes = view(accessor.integer("bufferView"), stride);
    const std::uint64_t offset = accessor.integer("byteOffset", 0);
    if (stride < layout.size || !fit(layout.count, layout.size, stride, offset, bytes.size())) {
      accessor.fail(
          fmt::format("has {} elements of {} bytes, {} bytes apart, from byte {} on; its "
                      "buffer view has {} bytes",
                      layout.count, layout.size, stride, offset, bytes.size()));
    }
    for (std::uint64_t i = 0; i < layout.count; ++i) put(i, bytes.data() + offset + i * stride);
  }
  if (accessor.has("sparse")) read_sparse(accessor, layout, put);
}

std::vector<std::uint32_t> GltfAccessors::sparse_indices(const GltfValue& sparse,
                                                         std::uint64_t count) {
  const GltfValue indices = sparse.member("indices");
  const std::uint64_t component = indices.integer("componentType");
  const std::uint64_t size = bytes_of(component, indices);
  std::uint64_t stride = size;
  const std::span<const std::uint8_t> bytes = view(indices.integer("bufferView"), stride);
  const std::uint64_t offset = indices.integer("byteOffset", 0);
  if (!fit(count, size, size, offset, bytes.size()) || component == kFloat32) {
    indices.fail(fmt::format("are {} integers of {} bytes from byte {} on; the buffer view has {}",
                             count, size, offset, bytes.size()));
  }
  std::vector<std::uint32_t> result;
  for (std::uint64_t i = 0; i < count; ++i) {
    const double value = component_at(bytes.data() + offset + i * size, component, false);
    result.push_back(value >= 0 ? std::uint32_t(value) : 0xFFFFFFFFu);
  }
  return result;
}

template <class Put>
void GltfAccessors::read_sparse(const GltfValue& accessor, const Layout& layout, const Put& put) {
  const GltfValue sparse = accessor.member("sparse");
  const std::uint64_t count = sparse.integer("count");
  if (count > layout.count) {
    sparse.fail(fmt::format("replaces {} of {} elements", count, layout.count));
  }
  const std::vector<std::uint32_t> indices = sparse_indices(sparse, count);
  const GltfValue values = sparse.member("values");
  std::uint64_t stride = layout.size;
  const std::span<const std::uint8_t> bytes = view(values.integer("bufferView"), stride);
  const std::uint64_t offset = values.integer("byteOffset", 0);
  if (!fit(count, layout.size, layout.size, offset, bytes.size())) {
    values.fail(fmt::format("are {} elements of {} bytes from byte {} on; the buffer view has {}",
                            count, layout.size, offset, bytes.size()));
  }
  for (std::uint64_t i = 0; i < count; ++i) {
    if (indices[i] >= layout.count) {
      sparse.fail(fmt::format("replaces element {} of {}", indices[i], layout.count));
    }
    put(indices[i], bytes.data() + offset + i * layout.size);
  }
}

std::vector<Eigen::Vector3d> GltfAccessors::points(std::uint64_t index) {
  const GltfValue accessor = root_.element("accessors", index);
  const Layout layout(accessor, "VEC3", 3);
  // Without a buffer view all elements are zero, and their number is only a claim.
  constexpr std::uint64_t kMaxZeros = 1'000'000;
  if (!accessor.has("bufferView") && layout.count > kMaxZeros) {
    accessor.fail(fmt::format("has {} elements but no bufferView; expected at most {} zeros",
                              layout.count, kMaxZeros));
  }
  std::vector<Eigen::Vector3d> result;
  if (!accessor.has("bufferView")) result.resize(layout.count, Eigen::Vector3d::Zero());
  const std::uint64_t size = layout.size / 3;
  read_elements(accessor, layout, [&](std::uint64_t i, const std::uint8_t* bytes) {
    if (i == result.size()) result.emplace_back();  // only now is it known to be there
    for (std::uint64_t axis = 0; axis < 3; ++axis) {
      result[i][Eigen::Index(axis)] =
          component_at(bytes + axis * size, layout.component, layout.normalized);
    }
  });
  return result;
}

std::vector<std::uint32_t> GltfAccessors::indices(std::uint64_t index) {
  const GltfValue accessor = root_.element("accessors", index);
  const Layout layout(accessor, "SCALAR", 1);
  if (layout.component == kFloat32 || layout.component == kInt8 || layout.component == kInt16) {
    accessor.fail(
        fmt::format("has the componentType {}; indices are 5121, 5123 or 5125", layout.component));
  }
  if (!accessor.has("bufferView")) accessor.fail("has no bufferView; expected indices");
  std::vector<std::uint32_t> result;
  read_elements(accessor, layout, [&](std::uint64_t i, const std::uint8_t* bytes) {
    if (i == result.size()) result.emplace_back();
    result[i] = std::uint32_t(component_at(bytes, layout.component, false));
  });
  return result;
}

}  // namespace vantage::raycore::detail
