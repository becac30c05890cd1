#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <stdexcept>
#include <thread>
#include <vantage/raycore/detail/file.hpp>

#include "support/expect_error.hpp"
#include "support/test_data.hpp"

using namespace vantage;
namespace fs = std::filesystem;

namespace {

int file_count(const fs::path& folder) {
  return int(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// As on a full disk: nothing can be written beyond `bytes` of any file.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit = {bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  void (*handler_)(int);
  rlimit before_ = {};
};

}  // namespace

TEST_CASE("a file comes back as it was written") {
  const test::TemporaryFolder folder;
  const std::string bytes("a\0b\n\xff", 5);
  write_file(folder / "x.bin", bytes);
  const std::vector<std::uint8_t> read = read_file(folder / "x.bin");
  CHECK(std::string(read.begin(), read.end()) == bytes);
  write_file(folder / "x.bin", "");
  CHECK(read_file(folder / "x.bin").empty());
  CHECK(file_count(folder.path()) == 1);
}

TEST_CASE("a new file has the permissions that the user's mask leaves") {
  const test::TemporaryFolder folder;
  const mode_t before = umask(022);
  write_file(folder / "x", "1");
  umask(before);
  CHECK(fs::status(folder / "x").permissions() == fs::perms(0644));
}

TEST_CASE("abandoned temporary files are removed, those in use and others' stay") {
  const test::TemporaryFolder folder;
  for (const char* name : {".vantage-7-1", ".vantage-7-12.png", ".vantage-x-1", ".vantage-7-",
                           ".vantage--1", ".vantage-7-1x", "vantage-7-1"}) {
    folder.write(name, "x");
  }
  fs::create_symlink(folder / "vantage-7-1", folder / ".vantage-8-1");
  write_file_with(folder / "y", [&](const fs::path& temporary) {
    remove_abandoned_files(folder.path());  // as another process would
    CHECK(fs::exists(temporary));
    CHECK(temporary.filename().string().starts_with(".vantage-"));
  });
  CHECK(fs::exists(folder / "y"));
  CHECK(!fs::exists(folder / ".vantage-7-1"));
  CHECK(!fs::exists(folder / ".vantage-7-12.png"));
  CHECK(fs::is_symlink(folder / ".vantage-8-1"));
  CHECK(file_count(folder.path()) == 7);
  CHECK_NOTHROW(remove_abandoned_files(folder / "nowhere"));
}

TEST_CASE("what cannot be read is named with the reason") {
  const test::TemporaryFolder folder;
  test::expect_bad_input("missing.bin", "No such file", [&] { read_file(folder / "missing.bin"); });
  test::expect_bad_input(folder.path().string(), "is a folder", [&] { read_file(folder.path()); });
  REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  test::expect_bad_input("pipe", "not a regular file", [&] { read_file(folder / "pipe"); });
  folder.write("big", "12345");
  test::expect_bad_input("big", "has 5 bytes; the limit is 4",
                         [&] { read_file(folder / "big", 4); });
  CHECK(read_file(folder / "big", 5).size() == 5);
}

TEST_CASE("what cannot be written is named with the reason") {
  const test::TemporaryFolder folder;
  test::expect_bad_input("none/x", "does not exist; make it",
                         [&] { write_file(folder / "none/x", ""); });
  test::expect_bad_input(folder.path().string(), "is a folder",
                         [&] { write_file(folder.path(), ""); });
  test::expect_bad_input("folder/", "is a folder", [&] { write_file(folder / "folder/", ""); });
  folder.write("file", "");
  test::expect_bad_input("file/x", "Not a directory", [&] { write_file(folder / "file/x", ""); });
  REQUIRE(mkfifo((folder / "pipe").c_str(), 0600) == 0);
  test::expect_bad_input("pipe", "not a regular file", [&] { write_file(folder / "pipe", ""); });
  CHECK(file_count(folder.path()) == 2);
}

TEST_CASE("a write that fails leaves the old file and nothing else") {
  const test::TemporaryFolder folder;
  folder.write("x", "old");
  {
    const FileSizeLimit limit(4096);
    test::expect_error(ErrorCode::out_of_resources, "/x", "cannot be written",
                       [&] { write_file(folder / "x", std::string(100000, 'n')); });
  }
  CHECK(test::read_text(folder / "x") == "old");
  CHECK(file_count(folder.path()) == 1);
}

TEST_CASE("a writer that throws leaves the old file and nothing else") {
  const test::TemporaryFolder folder;
  folder.write("x", "old");
  CHECK_THROWS_AS(write_file_with(folder / "x",
                                  [](const fs::path& temporary) {
                                    write_file(temporary, "half");
                                    throw std::runtime_error("stop");
                                  }),
                  std::runtime_error);
  CHECK(test::read_text(folder / "x") == "old");
  CHECK(file_count(folder.path()) == 1);
}

TEST_CASE("a writer gets a path beside the target with the same ending") {
  const test::TemporaryFolder folder;
  write_file_with(folder / "grid.vdb", [&](const fs::path& temporary) {
    CHECK(temporary.parent_path() == folder.path());
    CHECK(temporary.extension() == ".vdb");
    CHECK(temporary != folder / "grid.vdb");
    CHECK_FALSE(fs::exists(folder / "grid.vdb"));
    write_file(temporary, "whole");
  });
  CHECK(test::read_text(folder / "grid.vdb") == "whole");
}

TEST_CASE("writers of one file at once each write it whole") {
  const test::TemporaryFolder folder;
  std::vector<std::thread> threads;
  for (char c = 'a'; c < 'e'; ++c) {
    threads.emplace_back([&folder, c] {
      for (int i = 0; i < 20; ++i) write_file(folder / "x", std::string(10000, c));
    });
  }
  for (std::thread& thread : threads) thread.join();
  const std::string text = test::read_text(folder / "x");
  CHECK(text == std::string(10000, text.at(0)));
  CHECK(file_count(folder.path()) == 1);
}
