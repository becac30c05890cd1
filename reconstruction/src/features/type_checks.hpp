#pragma once

#include "vantage/reconstruction/object_type.hpp"

namespace vantage::reconstruction::detail {

/// Checks what a type says of itself alone.
/// @throws Error bad_input as MemoryKnowledgeBase does.
void check_type(const ObjectType& type);

/// Where a type is described: its place, or its name if it has none.
std::string place_of(const ObjectType& type);

}  // namespace vantage::reconstruction::detail
