#include <doctest/doctest.h>

#include "cli/sha256.hpp"
#include "support/test_data.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {

TEST_CASE("the hash of a file is the standard's (FIPS 180-2, appendix B)") {
  const test::TemporaryFolder folder;
  CHECK(sha256_of_file(folder.write("abc", "abc")) ==
        "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(sha256_of_file(folder.write("empty", "")) ==
        "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK_THROWS_AS(sha256_of_file(folder / "missing"), Error);
}

}  // namespace vantage
