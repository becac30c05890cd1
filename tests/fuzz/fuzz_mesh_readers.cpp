// libFuzzer on the mesh readers of ours. Not part of the default build; from the top folder:
//
//   clang++ -std=c++20 -g -O1 -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=undefined
//     -DFMT_HEADER_ONLY -I raycore/include -I raycore/src -isystem /usr/include/eigen3
//     tests/fuzz/fuzz_mesh_readers.cpp
//     raycore/src/{error,triangle_mesh,text_scanner,mesh_collector}.cpp
//     raycore/src/{mesh_stl,mesh_obj,mesh_ply,ply_header,ply_body}.cpp -o fuzz_mesh_readers
//   ./fuzz_mesh_readers -max_total_time=60 -max_len=4096
//
// The input's first byte chooses the format. A reader may only return a mesh or throw an Error.
#include <cstdint>
#include <cstdlib>

#include "mesh/mesh_readers.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vantage;
  if (size == 0) return 0;
  const std::span<const std::uint8_t> bytes(data + 1, size - 1);
  raycore::detail::MeshCollector collector("fuzz", 0.001);
  try {
    if (data[0] % 3 == 0) raycore::detail::read_stl(bytes, collector);
    if (data[0] % 3 == 1) raycore::detail::read_ply(bytes, collector);
    if (data[0] % 3 == 2) raycore::detail::read_obj(bytes, collector);
    const TriangleMesh mesh = std::move(collector).finish();
    if (mesh.empty()) std::abort();
  } catch (const Error& error) {
    if (error.where().empty() || error.message().empty()) std::abort();
  }
  return 0;
}
