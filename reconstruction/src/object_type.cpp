#include "vantage/reconstruction/object_type.hpp"

namespace vantage {

FeatureKey marker_key(const std::string& dictionary, int id) {
  return {"aruco", marker_family(dictionary) + "/" + std::to_string(id)};
}

}  // namespace vantage
