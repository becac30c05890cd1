#pragma once

#include <nlohmann/json.hpp>

#include "vantage/raycore/pose.hpp"

namespace vantage {

/// How our files and BOP's write geometry; documents/value_readers.hpp reads ours.

inline nlohmann::ordered_json to_json(const Eigen::Vector3d& v) {
  return nlohmann::ordered_json::array({v.x(), v.y(), v.z()});
}

/// Metres, and a quaternion.
inline nlohmann::ordered_json to_json(const Pose& pose) {
  const Eigen::Quaterniond q = pose.quaternion();
  return {{"rotation", {{"w", q.w()}, {"x", q.x()}, {"y", q.y()}, {"z", q.z()}}},
          {"translation_m", to_json(pose.translation())}};
}

/// Six rows of six.
inline nlohmann::ordered_json to_json(const Matrix6d& matrix) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (int i = 0; i < 6; ++i) {
    nlohmann::ordered_json row = nlohmann::ordered_json::array();
    for (int j = 0; j < 6; ++j) row.push_back(matrix(i, j));
    rows.push_back(row);
  }
  return rows;
}

/// BOP's nine numbers, row by row.
inline nlohmann::ordered_json bop_rotation(const Pose& pose) {
  nlohmann::ordered_json numbers = nlohmann::ordered_json::array();
  for (int i = 0; i < 9; ++i) numbers.push_back(pose.rotation()(i / 3, i % 3));
  return numbers;
}

/// BOP's millimetres.
inline nlohmann::ordered_json bop_translation(const Pose& pose) {
  return to_json(Eigen::Vector3d(1000 * pose.translation()));
}

}  // namespace vantage
