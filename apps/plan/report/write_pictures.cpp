#include "plan/report/write_pictures.hpp"

#include <spdlog/spdlog.h>
#include <tbb/task_group.h>

#include <memory>

#include "cli/progress_line.hpp"
#include "vantage/raycore/image_io.hpp"

namespace vantage {
namespace {

constexpr int kSmallFile = 6, kFast = 1;  // zlib's levels

/// Draws pictures from number `first` on, and writes each while the next one is drawn.
/// @returns the first that was not drawn, because `stop` asked to stop.
std::size_t draw_from(std::size_t first, const PlanPictures& pictures,
                      const std::filesystem::path& folder, int effort, const StopToken& stop) {
  for (std::size_t i = first; i < pictures.count(); ++i) stop.expect(pictures.steps(i));
  tbb::task_group writing;
  std::size_t done = first;
  {
    const ProgressLine progress("drawing", stop);
    for (; done < pictures.count() && !stop.stop_requested(); ++done) {
      auto image = pictures.draw(done, stop);
      if (!image) break;
      const auto shared = std::make_shared<const ColorImage>(std::move(*image));
      writing.run([path = folder / pictures.name(done), shared, effort] {
        write_png(path, *shared, effort);
      });
    }
    writing.wait();
  }
  for (std::size_t i = first; i < done; ++i) {
    spdlog::info("wrote {}", (folder / pictures.name(i)).string());
  }
  return done;
}

}  // namespace

void write_pictures(const std::filesystem::path& folder, const Plan& plan, const WorldModel& world,
                    const PictureRequest& request) {
  std::size_t done = 0;
  if (request.quality == PictureQuality::final) {
    const PlanPictures pictures(plan, world, request.width, PictureQuality::final);
    done = draw_from(0, pictures, folder, kSmallFile, request.in_time);
    if (done == pictures.count() || request.stop.stop_requested()) return;
    spdlog::info("the deadline has passed: drawing {} as {}",
                 done == 0 ? "the pictures" : "the rest of the pictures",
                 pictures.count() - done == 1 ? "a draft" : "drafts");
  }
  const PlanPictures drafts(plan, world, request.width, PictureQuality::draft);
  draw_from(done, drafts, folder, kFast, request.stop);
}

}  // namespace vantage
