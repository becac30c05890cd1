#include "cli/volume_text.hpp"

#include <fmt/format.h>

#include <cmath>

namespace vantage {

std::string volume_text(double m3) {
  if (m3 == 0) return "0";
  const double size = std::abs(m3);
  if (size < 0.9995e-6) return fmt::format("{:.3g} mm³", 1e9 * m3);
  if (size < 0.9995e-3) return fmt::format("{:.3g} cm³", 1e6 * m3);
  if (size < 0.9995) return fmt::format("{:.3g} l", 1e3 * m3);
  return size < 999.5 ? fmt::format("{:.3g} m³", m3) : fmt::format("{:.0f} m³", m3);
}

}  // namespace vantage
