#pragma once

#include <nlohmann/json.hpp>

namespace vantage {

/// The files of assets/schema, compiled in: the binary needs no folder beside it.
const nlohmann::json& workcell_schema();
const nlohmann::json& knowledge_schema();
const nlohmann::json& plan_schema();
const nlohmann::json& world_schema();
const nlohmann::json& observation_schema();
const nlohmann::json& evaluation_schema();
const nlohmann::json& planning_schema();
const nlohmann::json& shadow_filters_schema();
const nlohmann::json& replay_schema();
const nlohmann::json& tracking_schema();
const nlohmann::json& reasoning_schema();
const nlohmann::json& stability_schema();
const nlohmann::json& sequence_schema();
const nlohmann::json& views_schema();

}  // namespace vantage
