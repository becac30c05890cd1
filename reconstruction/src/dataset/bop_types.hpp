#pragma once

#include <filesystem>
#include <vector>

#include "vantage/reconstruction/object_type.hpp"

namespace vantage::reconstruction::detail {

/// Reads a folder of BOP models: every one of models_info.json, from obj_%06d.ply, in the order of
/// their ids. Millimetres become metres. A type is called obj_000001 and carries a feature {"pose",
/// "obj_000001"} at its origin, as pose estimators that were trained on such models report them.
/// @param files  gets every file that is read.
/// @throws Error bad_input with the file and the key for a file that is missing or damaged, an
/// invalid id, and invalid symmetries.
std::vector<ObjectType> read_bop_types(const std::filesystem::path& folder,
                                       std::vector<std::filesystem::path>& files);

}  // namespace vantage::reconstruction::detail
