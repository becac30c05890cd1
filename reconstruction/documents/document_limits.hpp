#pragma once

#include <cstddef>

namespace vantage {

/// How much of a document is read. They are checked while reading, before memory is taken.
struct DocumentLimits {
  std::size_t max_bytes = std::size_t(64) << 20;  ///< of the file; of keys and words, expanded
  std::size_t max_values = 2'000'000;             ///< lists and mappings count; aliases expanded
  int max_depth = 64;                             ///< lists and mappings in each other
  std::size_t max_key_bytes = 1024;
};

/// Of what people write, YAML: libyaml takes a quarter of a second for this.
inline constexpr DocumentLimits kYamlLimits = {.max_bytes = std::size_t(16) << 20,
                                               .max_values = 1'000'000};

/// Of what programs write, JSON: scenes of thousands of images are this large.
inline constexpr DocumentLimits kJsonLimits = {};

}  // namespace vantage
