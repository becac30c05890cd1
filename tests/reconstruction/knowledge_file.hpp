#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "support/expect_error.hpp"
#include "support/test_data.hpp"
#include "vantage/reconstruction/knowledge_base.hpp"

namespace vantage::test {

inline const std::string kCubeShape = "shape: {box: {size_m: [0.05, 0.05, 0.05]}}";

/// One type from the lines of its mapping, the first of which stands in line 2.
inline std::string type_text(const std::string& lines) {
  return "object_types:\n  - " + lines + "\n";
}

inline FileKnowledgeBase load(const TemporaryFolder& folder, const std::string& text) {
  return FileKnowledgeBase({folder.write("types.yaml", text)});
}

inline void expect_type_refused(const std::string& lines, std::string_view where,
                                std::initializer_list<std::string_view> parts) {
  CAPTURE(lines);
  TemporaryFolder folder;
  expect_refused([&] { load(folder, type_text(lines)); }, where, parts);
}

inline std::string with_marker(const std::string& marker, const std::string& shape = kCubeShape) {
  return "{name: a, " + shape + ",\n     features: [{type: aruco, " + marker + "}]}";
}

inline std::string with_feature(const std::string& keys) {
  return "{name: a, " + kCubeShape + ",\n     features: [{" + keys + "}]}";
}

}  // namespace vantage::test
