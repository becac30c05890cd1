#include "grid/write_stream.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <system_error>

#include "vantage/raycore/detail/file.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage::volume::detail {

void write_stream(const std::filesystem::path& path,
                  const std::function<void(std::ostream&)>& write) {
  write_file_with(path, [&](const std::filesystem::path& temporary) {
    errno = 0;
    std::ofstream file(temporary, std::ios::binary);
    write(file);
    file.close();
    if (file) return;
    // The temporary could be made, so its folder is fine: it is the space that is used up.
    throw Error(ErrorCode::out_of_resources, path.string(),
                fmt::format("cannot be written: {}", std::generic_category().message(errno)));
  });
}

}  // namespace vantage::volume::detail
