#pragma once

#include <cstddef>

#include "vantage/raycore/detail/limits.hpp"

namespace vantage {

/// How much of a document is read. They are checked while reading, before memory is taken.
struct DocumentLimits {
  std::size_t max_bytes = limits::kMaxJsonBytes;    ///< of the file; of keys and words, expanded
  std::size_t max_values = limits::kMaxJsonValues;  ///< lists and mappings count, too; expanded
  int max_depth = limits::kMaxDocumentDepth;        ///< lists and mappings in each other
  std::size_t max_key_bytes = limits::kMaxKeyBytes;
};

/// Of what people write.
inline constexpr DocumentLimits kYamlLimits = {.max_bytes = limits::kMaxYamlBytes,
                                               .max_values = limits::kMaxYamlValues};

/// Of what programs write: scenes of thousands of images are this large.
inline constexpr DocumentLimits kJsonLimits = {};

}  // namespace vantage
