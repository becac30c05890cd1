#pragma once

#include <string>

namespace vantage {

/// A volume with three significant digits, in the unit that reads best: "96.3 cm³", "4.21 l",
/// "1.28 m³"; "0" for none.
std::string volume_text(double m3);

}  // namespace vantage
