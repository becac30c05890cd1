#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>

#include "cli/command.hpp"
#include "cli/inputs_json.hpp"
#include "cli/interruptible_run.hpp"
#include "cli/shared_options.hpp"
#include "evaluate/replay/replay_benchmark.hpp"
#include "evaluate/replay/replay_json.hpp"
#include "metrics/planning/replay_tables.hpp"
#include "options/command_line.hpp"
#include "options/field_json.hpp"
#include "options/unused_options.hpp"
#include "options/view_options.hpp"
#include "plan/plan_options.hpp"
#include "process/output_folder.hpp"
#include "process/result_output.hpp"
#include "vantage/raycore/detail/file.hpp"

namespace vantage {
namespace {

constexpr const char* kReplayExamples =
    "Examples:\n"
    "  vantage evaluate replay kitchen --work-area -0.7 -0.75 0 1.1 0.65 0.35 --voxel-size 0.02\n"
    "  vantage evaluate replay kitchen --workcell cell.yaml --pairs 50 -o out\n"
    "  vantage evaluate replay kitchen --workcell cell.yaml --methods expected,mesh --json";

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct ReplayCommandOptions {
  PlanOptions plan;
  std::vector<std::string> methods{"expected", "voxel", "mesh", "meshD6"};
  nlohmann::json given = nlohmann::json::object();  ///< fields of the settings
  fs::path folder;
  bool json = false;
  int threads = 0;
};

FieldGroup fields_of(ReplayBenchmarkOptions& settings) {
  return {"",
          "Replay",
          {{.key = "pairs",
            .value = &settings.pairs,
            .help = "Number of pairs of frames to plan from",
            .option = "--pairs",
            .range = from_to(1, 1000000)},
           {.key = "seed",
            .value = &settings.seed,
            .help = "Seed for selecting pairs",
            .option = "--seed"},
           {.key = "least_seen",
            .value = &settings.min_seen,
            .help = "Minimum share of the work area that each frame of a pair shows; all other "
                    "frames are candidates",
            .option = "--least-seen",
            .range = from_to(0, 1)}}};
}

bool has_mesh(const std::vector<std::string>& methods) {
  return std::ranges::any_of(named_methods(methods), [](const NamedMethod& method) {
    return std::holds_alternative<MeshMethod>(method.method);
  });
}

ReplayBenchmarkOptions options_of(const ReplayCommandOptions& arguments, const MeshMethod& mesh) {
  ReplayBenchmarkOptions settings;
  read_given(arguments.given, fields_of(settings));
  settings.methods = named_methods(arguments.methods);
  for (NamedMethod& method : settings.methods) {
    auto* const by_mesh = std::get_if<MeshMethod>(&method.method);
    if (by_mesh == nullptr) continue;
    const MeshMethod named = *by_mesh;
    *by_mesh = mesh;
    by_mesh->weight = named.weight;
    by_mesh->depth_power = named.depth_power;
  }
  return settings;
}

Json config_json(const ReplayCommandOptions& arguments, ReplayBenchmarkOptions settings,
                 const PlanInput& input) {
  PlanRequest request = input.request;
  request.method = input.mesh;
  const Json all = config_of(request);
  Json config = input.record.config;
  config["methods"] = arguments.methods;
  config.update(to_json(fields_of(settings)));
  config.update({{"work_area", all["work_area"]},
                 {"voxel_size_m", request.voxel_size_m},
                 {"volume", all["volume"]},
                 {"mesh", all["mesh"]}});
  return config;
}

std::string text_of(const ReplayEvaluation& evaluation) {
  std::string text;
  for (const ReportTable& table : replay_tables(evaluation)) {
    text += (text.empty() ? "" : "\n") + table_text(table);
  }
  return text;
}

ExitCode evaluate(const ReplayCommandOptions& arguments) {
  InterruptibleRun run(arguments.threads);
  refuse_unused_mesh(arguments.plan.given, has_mesh(arguments.methods), "mesh among --methods");
  PlanInput input = run.execute([&] { return load_plan_input(arguments.plan, run.stop()); });
  for (const std::string& warning : input.warnings) spdlog::warn("{}", warning);
  refuse_unused_filter(arguments.plan.given, input.request.volume);
  const ReplayBenchmarkOptions settings = options_of(arguments, input.mesh);
  const ReplayEvaluation evaluation =
      run.execute("replaying", [&] { return evaluate_replay(input, settings, run.stop()); });
  if (evaluation.pairs.empty()) return run.exit_code();
  Json json = replay_to_json(evaluation);
  json["partial"] = run.cancelled();
  json["config"] = config_json(arguments, settings, input);
  json["inputs"] = inputs_json(input.record.inputs);
  if (!arguments.folder.empty()) {
    make_output_folder(arguments.folder);
    write_file(arguments.folder / "replay.json", json_text(json));
    spdlog::info("wrote {}", (arguments.folder / "replay.json").string());
  }
  print_result(arguments.json, json, [&] { return text_of(evaluation); });
  return run.exit_code();
}

}  // namespace

void add_evaluate_replay(CLI::App& evaluate_verb, Action& action) {
  CLI::App* verb = evaluate_verb.add_subcommand(
      "replay",
      "Replay a recording from many known poses: plan from two frames with the others as "
      "candidates, and measure what the picked frame really reveals");
  const auto arguments = std::make_shared<ReplayCommandOptions>();
  add_input_options(*verb, arguments->plan);
  verb->add_option("--methods", arguments->methods,
                   "Methods, e.g. voxel,mesh,shadowD6; D and a number set the depth power")
      ->delimiter(',')
      ->capture_default_str()
      ->group("Replay");
  ReplayBenchmarkOptions settings;
  add_fields(*verb, fields_of(settings), arguments->given);
  MeshMethod mesh;
  add_fields(*verb, {"", "", {}, {fields_of(mesh)}}, arguments->plan.given);
  add_object_options(*verb, arguments->plan.objects);
  add_volume_options(*verb, arguments->plan);
  add_output_option(*verb, arguments->folder, "replay.json");
  add_json_flag(*verb, arguments->json, "replay.json");
  add_threads_option(*verb, arguments->threads);
  verb->footer(kReplayExamples);
  set_action(*verb, action, arguments, evaluate);
}

}  // namespace vantage
