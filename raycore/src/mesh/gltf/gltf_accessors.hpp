#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <vector>

#include "mesh/gltf/gltf_value.hpp"

namespace vantage::raycore::detail {

/// Takes numbers out of a glTF's buffers: in the GLB, in the JSON itself (base64), or in files
/// beside it. Every offset, stride and count is checked against the buffer's size before memory is
/// taken.
class GltfAccessors {
 public:
  /// @param root and `binary` have to outlive this.
  GltfAccessors(const GltfValue& root, std::span<const std::uint8_t> binary,
                const std::filesystem::path& path)
      : root_(root), binary_(binary), path_(path) {}

  // All throw Error bad_input with the place in the JSON.

  /// The points of an accessor of three-vectors.
  std::vector<Eigen::Vector3d> points(std::uint64_t accessor);

  /// The integers of an accessor of scalars.
  std::vector<std::uint32_t> indices(std::uint64_t accessor);

  /// The bytes of all buffers that were used so far.
  std::uint64_t bytes_used() const { return bytes_used_; }

 private:
  struct Layout;

  std::span<const std::uint8_t> buffer(std::uint64_t index);
  std::vector<std::uint8_t> load_buffer(const GltfValue& value);
  std::span<const std::uint8_t> view(std::uint64_t index, std::uint64_t& stride);
  /// Calls `put(element, bytes)` for every element that the buffers have.
  template <class Put>
  void read_elements(const GltfValue& accessor, const Layout& layout, const Put& put);
  template <class Put>
  void read_sparse(const GltfValue& accessor, const Layout& layout, const Put& put);
  std::vector<std::uint32_t> sparse_indices(const GltfValue& sparse, std::uint64_t count);

  const GltfValue& root_;
  std::span<const std::uint8_t> binary_;
  const std::filesystem::path& path_;
  std::map<std::uint64_t, std::vector<std::uint8_t>> loaded_;
  std::uint64_t bytes_used_ = 0;
};

}  // namespace vantage::raycore::detail
