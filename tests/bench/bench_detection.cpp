// How long it takes to find the markers of a 640 x 480 image, beside OpenCV's own detection, which
// is a part of it and leaves the corners a pixel off.

#include <benchmark/benchmark.h>

#include <opencv2/imgproc.hpp>

#include "features/opencv_aruco.hpp"
#include "support/board_picture.hpp"
#include "vantage/reconstruction/detector.hpp"

namespace vantage {
namespace {

const Lens kLens({640, 480, 600, 600, 319.5, 239.5}, {.k1 = -0.1, .k2 = 0.03});

/// Six by four markers of 25 mm.
ColorImage photograph(const char* dictionary) {
  test::PrintedBoard board;
  for (int i = 0; i < 24; ++i) {
    board.markers.push_back(
        {dictionary, i, 0.025,
         Pose::from_translation({0.05 * (i % 6) - 0.125, 0.05 * (i / 6) - 0.075, 0})});
  }
  return test::BoardCamera(board, kLens, Pose::looking_at({0.05, -0.2, 0.35}, {0, 0, 0}))
      .photograph();
}

void opencv_alone(benchmark::State& state) {
  const ColorImage image = photograph("4X4_50");
  const cv::Mat rgb(image.height, image.width, CV_8UC3,
                    const_cast<unsigned char*>(image.samples.data()));
  const auto dictionary = reconstruction::detail::aruco_dictionary("4X4_50");
  std::vector<int> ids;
  for (auto _ : state) {
    cv::Mat grey;
    cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
    std::vector<std::vector<cv::Point2f>> corners;
    reconstruction::detail::detect_in_grey(grey, *dictionary, ids, corners);
  }
  state.counters["markers"] = double(ids.size());
}
BENCHMARK(opencv_alone)->Unit(benchmark::kMillisecond)->UseRealTime();

void detect(benchmark::State& state, std::vector<std::string> dictionaries,
            std::optional<Lens> lens) {
  const ColorImage image = photograph(dictionaries[0].c_str());
  const ArucoDetector detector({std::move(dictionaries), std::move(lens)});
  std::size_t markers = 0;
  for (auto _ : state) markers = detector.detect(image).size();
  state.counters["markers"] = double(markers);
}
BENCHMARK_CAPTURE(detect, 4X4, {"4X4_50"}, std::nullopt)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(detect, 4X4_with_lens, {"4X4_50"}, kLens)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(detect, 6X6, {"6X6_250"}, std::nullopt)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(detect, 4X4_and_6X6, {"4X4_50", "6X6_250"}, std::nullopt)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
}  // namespace vantage

BENCHMARK_MAIN();
