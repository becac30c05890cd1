#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "run_command.hpp"

namespace vantage {
namespace {

using test::CommandResult;
using test::TemporaryFolder;
namespace fs = std::filesystem;

CommandResult shell(const TemporaryFolder& folder, const std::string& options,
                    const std::string& prefix, const std::string& suffix) {
  const std::string scene = test::quoted(folder / "scene");
  return test::run_vantage("plan" + scene + test::kSceneArea + " " + options + suffix, prefix);
}

void expect_lost(const CommandResult& result, std::string_view part) {
  CAPTURE(result.err);
  CHECK(result.exit_code == 6);
  CHECK(result.err.find(part) != std::string::npos);
  CHECK(result.err.find("bug") == std::string::npos);
}

std::string bash(const std::string& script) {
  return "bash -c '" + script + "' bash";
}

}  // namespace

TEST_CASE("a stdout that cannot be written is reported, after all files were written") {
  const TemporaryFolder folder;
  test::write_scene(folder);
  const std::string out = " -o" + test::quoted(folder / "out");
  expect_lost(shell(folder, "--json --save-grid" + out, bash("\"$@\" > /dev/full"), ""), "stdout");
  CHECK(fs::exists(folder / "out/plan.json"));
  CHECK(fs::exists(folder / "out/grid.vdb"));
  expect_lost(shell(folder, "", bash("exec \"$@\" >&-"), ""), "stdout");
  expect_lost(shell(folder, "", bash("set -o pipefail; \"$@\" | true"), ""), "stdout");
  expect_lost(test::run_vantage("--help", bash("\"$@\" > /dev/full")), "stdout");
}

TEST_CASE("a file that may not grow does not end the process") {
  const TemporaryFolder folder;
  test::write_scene(folder);
  const fs::path out = folder / "out";
  // bash alone would be killed by the signal, too: its own limit is raised by none of this.
  const CommandResult result =
      shell(folder, "-o" + test::quoted(out), bash("ulimit -f 1; exec \"$@\" 2>/dev/null"), "");
  CHECK(result.exit_code == 6);
  CHECK(fs::is_empty(out));
}

TEST_CASE("what a killed run left is cleared away, what others are writing is not") {
  const TemporaryFolder folder;
  test::write_scene(folder);
  fs::create_directories(folder / "out");
  folder.write("out/.vantage-1-1.vdb", "left");
  folder.write("out/.vantage-notes", "not one of ours");
  const fs::path busy = folder.write("out/.vantage-1-2.png", "being written");
  const int lock = ::open(busy.c_str(), O_RDWR | O_CLOEXEC);
  REQUIRE(::flock(lock, LOCK_EX) == 0);
  CHECK(shell(folder, "-o" + test::quoted(folder / "out"), "", "").exit_code == 0);
  CHECK(!fs::exists(folder / "out/.vantage-1-1.vdb"));
  CHECK(fs::exists(folder / "out/.vantage-notes"));
  CHECK(fs::exists(busy));
  ::close(lock);
  CHECK(shell(folder, "-o" + test::quoted(folder / "out"), "", "").exit_code == 0);
  CHECK(!fs::exists(busy));
}

TEST_CASE("threads that the system does not give end in exit code 6") {
  if (::getuid() != 0) {
    MESSAGE("skipped: only root becomes a user without other processes");
    return;
  }
  const TemporaryFolder folder;
  test::write_scene(folder);
  fs::permissions(folder.path(), fs::perms::all);
  const CommandResult result = shell(
      folder, "--threads 64",
      "setpriv --reuid 64999 --regid 64999 --clear-groups " + bash("ulimit -u 8; exec \"$@\""), "");
  expect_lost(result, "--threads");
}

}  // namespace vantage
