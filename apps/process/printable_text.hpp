#pragma once

#include <string>
#include <string_view>

namespace vantage {

/// Text that may hold names, values and paths of files, made safe to print: control characters
/// (which a terminal would obey) and bytes that are no UTF-8 become `\x1b` and the like. Line ends
/// and tabs stay.
std::string printable(std::string_view text);

/// A text of many kilobytes without its middle: messages repeat what was found, however long it is.
std::string shortened(std::string_view text);

}  // namespace vantage
