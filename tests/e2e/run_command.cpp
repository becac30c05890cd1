#include "run_command.hpp"

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/raycore/image_io.hpp"

namespace vantage::test {

namespace fs = std::filesystem;

CommandResult run_vantage(const std::string& arguments, const std::string& prefix) {
  const TemporaryFolder folder;
  const std::string command = prefix + " '" VANTAGE_COMMAND "' " + arguments + " >'" +
                              (folder / "out").string() + "' 2>'" + (folder / "err").string() +
                              "' </dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(folder / "out"),
          read_text(folder / "err")};
}

namespace {

/// Whether a process has a handler for Ctrl-C: bit 1 of the signals that it catches.
bool catches_interrupts(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);) {
    // Until it is the command, it has the handlers of this process, or those of the shell.
    if (line.starts_with("Name:") && !line.ends_with("vantage-command")) return false;
    if (!line.starts_with("SigCgt:")) continue;
    return (std::stoull(line.substr(7), nullptr, 16) >> (SIGINT - 1) & 1) != 0;
  }
  return false;
}

pid_t start_in_shell(const std::string& command) {
  const pid_t process = fork();
  if (process == 0) {
    execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    _exit(127);
  }
  return process;
}

}  // namespace

CommandResult interrupt_vantage(const std::string& arguments, double after_s) {
  constexpr int kPolls = 6000;
  constexpr auto kPoll = std::chrono::milliseconds(20);
  const TemporaryFolder folder;
  const pid_t process =
      start_in_shell("exec '" VANTAGE_COMMAND "' " + arguments + " >'" + (folder / "out").string() +
                     "' 2>'" + (folder / "err").string() + "' </dev/null");
  for (int i = 0; i < kPolls && !catches_interrupts(process); ++i) {
    std::this_thread::sleep_for(kPoll);
  }
  std::this_thread::sleep_for(std::chrono::duration<double>(after_s));
  kill(process, SIGINT);
  int status = 0;
  waitpid(process, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(folder / "out"),
          read_text(folder / "err")};
}

nlohmann::json scene_camera() {
  // At (0, -0.6, 0.4), looking along +y and down by 30 degrees.
  return {{"cam_K", {300, 0, 159.5, 0, 300, 119.5, 0, 0, 1}},
          {"depth_scale", 1.0},
          {"cam_R_w2c", {1, 0, 0, 0, -0.5, -0.8660254037844386, 0, 0.8660254037844386, -0.5}},
          {"cam_t_w2c", {0, 46.41016151377539, 719.6152422706632}}};
}

void write_scene_camera(const fs::path& scene, const nlohmann::json& entry) {
  const std::string text = nlohmann::json{{"7", entry}}.dump(1);
  std::FILE* file = std::fopen((scene / "scene_camera.json").c_str(), "wb");
  std::fwrite(text.data(), 1, text.size(), file);
  std::fclose(file);
}

std::string quoted(const std::filesystem::path& path) {
  return " '" + path.string() + "'";
}

std::string quoted_workcell(const std::string& name, const std::string& rest) {
  return quoted(assets() / "workcells" / (name + ".yaml" + rest));
}

void make_dataset(const std::string& workcell, const fs::path& folder, const std::string& options) {
  const CommandResult result = run_vantage("simulate" + quoted_workcell(workcell) + " -o" +
                                           quoted(folder) + " --samples 4 " + options);
  CAPTURE(result.err);
  REQUIRE(result.exit_code == 0);
}

fs::path write_scene(const TemporaryFolder& folder) {
  const fs::path scene = folder / "scene";
  fs::create_directories(scene / "depth");
  Eigen::Matrix3d R_w2c;
  R_w2c << 1, 0, 0, 0, -0.5, -std::sqrt(0.75), 0, std::sqrt(0.75), -0.5;
  const Pose T_cam_world = Pose::from_rotation(R_w2c, {0, 0.04641016151377539, 0.7196152422706632});
  SceneBuilder builder;
  builder.add_box(Box({-2, -2, -0.1}, {2, 3, 0}));
  builder.add_box(Box({-0.08, 0, 0}, {0.08, 0.06, 0.15}));
  const DepthImage depth = builder.build()->render_depth(
      PinholeCamera({320, 240, 300, 300, 159.5, 119.5}, T_cam_world.inverse(), {0.1, 10}));
  RawDepthImage counts(320, 240);
  for (std::size_t i = 0; i < counts.samples.size(); ++i) {
    const float metres = depth.metres()[i];
    if (metres > 0) counts.samples[i] = std::uint16_t(std::lround(1000 * metres));
  }
  write_png(scene / "depth/000007.png", counts);
  write_scene_camera(scene, scene_camera());
  return scene;
}

}  // namespace vantage::test
