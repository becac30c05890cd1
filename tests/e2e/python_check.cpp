#include "python_check.hpp"

#include <doctest/doctest.h>
#include <sys/wait.h>

#include <cstdlib>

#include "support/test_data.hpp"

namespace vantage::test {

void check_in_python(const std::string& script, const std::filesystem::path& folder) {
  const TemporaryFolder logs;
  const std::string log = (logs / "log").string();
  const std::string command = VANTAGE_PYTHON " '" VANTAGE_E2E_FOLDER "/" + script + "' '" +
                              folder.string() + "' >'" + log + "' 2>&1";
  const int status = std::system(command.c_str());
  const int exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  const std::string output = read_text(log);
  if (exit_code == 77 || exit_code == 127) {  // 127: there is no Python at all
    MESSAGE("not checked in Python (apps/setup.sh --test installs what it needs): " << output);
    return;
  }
  CAPTURE(output);
  CHECK(exit_code == 0);
}

}  // namespace vantage::test
