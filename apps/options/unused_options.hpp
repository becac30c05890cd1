#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "options/view_options.hpp"
#include "vantage/volume/volume_options.hpp"

namespace vantage {

/// @throws UsageError that says that `option` does nothing without what `needs` names, unless it is
/// used or was not given.
void refuse_unused(bool given, bool used, const std::string& option, const std::string& needs);

/// @throws UsageError that says that `option` does nothing together with what `by` names, if it was
/// given and is overridden.
void refuse_useless(bool given, bool overridden, const std::string& option, const std::string& by);

/// The same for all options of views and volumes that were given on the command line, by what is
/// asked for altogether, in the workcell or by other options.
/// @param given the values of options, by their fields' keys, as `add_fields` makes them.
void refuse_unused_fields(const nlohmann::json& given, const ViewOptions& views,
                          const VolumeOptions& volume);

/// Parts of it, for verbs that have these options alone.
void refuse_unused_mesh(const nlohmann::json& given, bool used, const std::string& needs);
void refuse_unused_servo(const nlohmann::json& given, const ServoOptions& servo);
void refuse_unused_filter(const nlohmann::json& given, const VolumeOptions& volume);

}  // namespace vantage
