#include <doctest/doctest.h>
#include <openvdb/openvdb.h>
#include <sys/resource.h>

#include <csignal>
#include <cstring>
#include <functional>

#include "support/expect_error.hpp"
#include "support/test_data.hpp"
#include "vantage/volume/grid_files.hpp"
#include "volume/make_grid.hpp"

namespace vantage {
namespace {

using test::TemporaryFolder;
namespace fs = std::filesystem;

/// Larger than a tile of 128³ voxels, and no multiple of a block.
std::shared_ptr<const StateGrid> some_grid() {
  return test::make_grid(test::geometry_of(141, 133, 130), [](const Eigen::Vector3i& v) {
    if (v.x() < 130)
      return test::MadeVoxel{VoxelState::shadow, false, test::outside_if(v.y() < 70)};
    return test::random_voxels(8)(v);
  });
}

/// The header's literal, and where the array begins.
std::pair<std::string, std::size_t> npy_header(const std::string& bytes) {
  REQUIRE(bytes.size() > 10);
  CHECK(bytes.substr(0, 8) == std::string("\x93NUMPY\x01\x00", 8));
  const std::size_t length =
      std::size_t(std::uint8_t(bytes[8])) + 256 * std::size_t(std::uint8_t(bytes[9]));
  return {bytes.substr(10, length), 10 + length};
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
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  void (*handler_)(int);
  rlimit before_ = {};
};

template <class Grid>
typename Grid::Ptr read_grid(openvdb::io::File& file, const char* name) {
  const auto grid = openvdb::gridPtrCast<Grid>(file.readGrid(name));
  REQUIRE(grid);
  return grid;
}

}  // namespace

TEST_CASE("labels.npy: a header that NumPy reads, then every voxel's state, x slowest") {
  const auto grid = some_grid();
  const TemporaryFolder folder;
  write_labels_npy(folder / "labels.npy", *grid);
  const std::string bytes = test::read_text(folder / "labels.npy");
  const auto [header, begin] = npy_header(bytes);
  CHECK(header.find("{'descr': '|u1', 'fortran_order': False, 'shape': (141, 133, 130), }") == 0);
  CHECK(header.back() == '\n');
  CHECK(begin % 64 == 0);
  REQUIRE(bytes.size() == begin + grid->geometry().voxel_count());
  std::size_t next = begin, wrong = 0;
  test::for_each_voxel(grid->geometry(), [&](const Eigen::Vector3i& voxel) {
    wrong += int(bytes[next++]) != int(grid->at(voxel));
  });
  CHECK(wrong == 0);
}

TEST_CASE("regions.npy: the labels of the shadow regions as int32") {
  const auto grid = some_grid();
  const ShadowRegions regions(*grid);
  CHECK(regions.list().size() > 100);
  const TemporaryFolder folder;
  write_regions_npy(folder / "regions.npy", regions);
  const std::string bytes = test::read_text(folder / "regions.npy");
  const auto [header, begin] = npy_header(bytes);
  CHECK(header.find("{'descr': '<i4', 'fortran_order': False, 'shape': (141, 133, 130), }") == 0);
  CHECK(begin % 64 == 0);
  REQUIRE(bytes.size() == begin + 4 * grid->geometry().voxel_count());
  std::size_t next = begin, wrong = 0;
  test::for_each_voxel(grid->geometry(), [&](const Eigen::Vector3i& voxel) {
    std::int32_t label = 0;
    std::memcpy(&label, bytes.data() + next, sizeof label);
    next += sizeof label;
    wrong += label != regions.label(voxel);
  });
  CHECK(wrong == 0);
}

TEST_CASE("grid.vdb holds the states, as numbers and as sets, and stays sparse") {
  const auto grid = some_grid();
  const TemporaryFolder folder;
  grid->write_vdb(folder / "grid.vdb");
  openvdb::initialize();
  openvdb::io::File file((folder / "grid.vdb").string());
  file.open();
  CHECK(file.getGrids()->size() == 7);
  const auto states = read_grid<openvdb::Int32Grid>(file, "state");
  const std::pair<const char*, std::function<bool(const Eigen::Vector3i&)>> sets[] = {
      {"occupied", [&](const auto& v) { return grid->at(v) == VoxelState::occupied; }},
      {"shadow", [&](const auto& v) { return grid->at(v) == VoxelState::shadow; }},
      {"revealed", [&](const auto& v) { return grid->at(v) == VoxelState::revealed; }},
      {"measured", [&](const auto& v) { return grid->measured(v); }},
      {"unmeasured",
       [&](const auto& v) { return grid->shadow_cause(v) == ShadowCause::unmeasured; }},
      {"unseen", [&](const auto& v) { return grid->shadow_cause(v) == ShadowCause::outside; }}};
  const Eigen::Vector3i n = grid->geometry().size();
  const openvdb::CoordBBox around({-1, -1, -1}, {n.x(), n.y(), n.z()});
  std::size_t wrong = 0;
  const auto at_states = states->getConstAccessor();
  for (auto c = around.begin(); c; ++c) {
    const int expected = int(grid->at({(*c).x(), (*c).y(), (*c).z()}));
    wrong += at_states.getValue(*c) != expected || at_states.isValueOn(*c) != (expected != 0);
  }
  CHECK(wrong == 0);
  CHECK(states->tree().activeTileCount() > 0);
  CHECK(read_grid<openvdb::BoolGrid>(file, "shadow")->tree().activeTileCount() > 0);
  for (const auto& set_of : sets) {
    const auto& name = set_of.first;
    const auto& holds = set_of.second;
    CAPTURE(name);
    const auto set = read_grid<openvdb::BoolGrid>(file, name);
    CHECK_FALSE(set->background());
    CHECK(set->transform() == states->transform());
    std::size_t different = 0;
    const auto at = set->getConstAccessor();
    for (auto c = around.begin(); c; ++c) {
      const bool expected = holds({(*c).x(), (*c).y(), (*c).z()});
      different += at.getValue(*c) != expected || at.isValueOn(*c) != expected;
    }
    CHECK(different == 0);
  }
  const openvdb::Vec3d centre = states->indexToWorld(openvdb::Coord(3, 4, 5));
  CHECK((grid->geometry().centre({3, 4, 5}) - Eigen::Vector3d(centre.x(), centre.y(), centre.z()))
            .norm() < 1e-12);
  CHECK(fs::file_size(folder / "grid.vdb") < grid->geometry().voxel_count() / 2);
}

TEST_CASE("files that cannot be written, in a missing folder or on a full disk") {
  const auto grid = some_grid();
  const ShadowRegions regions(*grid);
  const std::pair<const char*, std::function<void(const fs::path&)>> writers[] = {
      {"grid.vdb", [&](const fs::path& p) { grid->write_vdb(p); }},
      {"labels.npy", [&](const fs::path& p) { write_labels_npy(p, *grid); }},
      {"regions.npy", [&](const fs::path& p) { write_regions_npy(p, regions); }}};
  const TemporaryFolder folder;
  for (const auto& writer : writers) {
    const auto& name = writer.first;
    const auto& write = writer.second;
    CAPTURE(name);
    test::expect_bad_input(name, "does not exist", [&] { write(folder / "missing" / name); });
    const FileSizeLimit limit(1000);
    test::expect_error(ErrorCode::out_of_resources, name, "cannot be written",
                       [&] { write(folder / name); });
  }
  CHECK(fs::is_empty(folder.path()));
}

}  // namespace vantage
