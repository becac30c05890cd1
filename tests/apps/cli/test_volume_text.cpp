#include "cli/volume_text.hpp"

#include <doctest/doctest.h>

namespace vantage::test {

TEST_CASE("volumes have three significant digits in the unit that reads best") {
  CHECK(volume_text(0) == "0");
  CHECK(volume_text(1.28e-9) == "1.28 mm³");
  CHECK(volume_text(9.627e-5) == "96.3 cm³");
  CHECK(volume_text(9.999e-4) == "1 l");
  CHECK(volume_text(0.0042061) == "4.21 l");
  CHECK(volume_text(0.9999) == "1 m³");
  CHECK(volume_text(1.284) == "1.28 m³");
  CHECK(volume_text(12345.6) == "12346 m³");
  CHECK(volume_text(-2e-5) == "-20 cm³");
}

}  // namespace vantage::test
