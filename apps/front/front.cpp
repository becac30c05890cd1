// What people start as `vantage`. Loading the libraries of all verbs takes a fifth of a second, so
// this program has none of them: it says its version, and becomes vantage-command for all else.
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "version.hpp"

namespace {

namespace fs = std::filesystem;

/// Where vantage-command is: beside this program in a build, or where it is installed.
fs::path command_path() {
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  const fs::path built = folder / "vantage-command";
  return fs::exists(built, error) ? built : folder.parent_path() / VANTAGE_COMMAND_INSTALLED;
}

int print_version() {
  const bool printed = std::printf("%s\n", vantage::kVersion) > 0 && std::fflush(stdout) == 0;
  if (!printed) std::fprintf(stderr, "error: stdout: %s\n", std::strerror(errno));
  return printed ? 0 : 6;  // out of resources, as of every command
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::string_view(argv[1]) == "--version") return print_version();
  const fs::path command = command_path();
  ::execv(command.c_str(), argv);
  std::fprintf(stderr, "error: %s: cannot be started: %s; install vantage again\n", command.c_str(),
               std::strerror(errno));
  return 1;
}
