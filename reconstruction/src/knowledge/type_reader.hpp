#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "documents/document_value.hpp"
#include "vantage/reconstruction/object_type.hpp"

namespace vantage::reconstruction::detail {

/// Reads the types of knowledge base files; remembers the markers of all of them.
class TypeReader {
 public:
  /// @param files  gets every mesh file that is read; has to outlive the reader.
  explicit TypeReader(std::vector<std::filesystem::path>& files) : files_(files) {}

  /// @param folder  of the file in which `value` stands: names of meshes are relative to it.
  ObjectType read(const Value& value, const std::filesystem::path& folder);

 private:
  std::vector<ObjectFeature> read_features(const Value& type);

  /// 4X4_50's markers are the first of 4X4_250's, so that one name for both keeps its user from
  /// thinking that they are two.
  void take_dictionary(const Marker& marker, const Value& value);

  std::vector<std::filesystem::path>& files_;
  std::map<FeatureKey, std::pair<std::string, std::string>> dictionaries_;  // name, where it stands
};

}  // namespace vantage::reconstruction::detail
