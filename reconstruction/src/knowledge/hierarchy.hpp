#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace vantage::reconstruction::detail {

/// Name → the names of its parents.
using Parents = std::map<std::string, std::vector<std::string>, std::less<>>;

/// Adds parents to those that `name` has, each once.
void add_parents(Parents& parents, const std::string& name, const std::vector<std::string>& more);

/// Whether there is a way of zero or more steps up from `name` to `ancestor`.
bool has_ancestor(const Parents& parents, std::string_view name, std::string_view ancestor);

/// @param places  name → where its parents are said; a name that is missing stands for itself.
/// @throws Error bad_input for a name that is its own ancestor; the message has the way around.
void check_no_circle(const Parents& parents, const std::map<std::string, std::string>& places);

}  // namespace vantage::reconstruction::detail
