#include "track/track_options.hpp"

namespace vantage {
namespace {

std::vector<Field> expert_fields_of(TrackOptions& options) {
  return {{.key = "creep_m",
           .value = &options.creep_m,
           .help = "Standard deviation by which a standing object creeps in a second",
           .option = "--creep-m",
           .unit = "m",
           .range = positive(),
           .expert = true},
          {.key = "creep_rad",
           .value = &options.creep_rad,
           .help = "Standard deviation by which a standing object turns in a second",
           .option = "--creep-rad",
           .unit = "rad",
           .range = positive(),
           .expert = true},
          {.key = "mean_time_to_move_s",
           .value = &options.mean_time_to_move_s,
           .help = "Mean time until any one object is moved",
           .option = "--mean-time-to-move-s",
           .unit = "s",
           .range = positive(),
           .expert = true},
          {.key = "mean_time_to_change_s",
           .value = &options.mean_time_to_change_s,
           .help = "Mean time until an object is added or taken away",
           .option = "--mean-time-to-change-s",
           .unit = "s",
           .range = positive(),
           .expert = true},
          {.key = "min_existence",
           .value = &options.min_existence,
           .help = "Objects that are less likely to be at their place have left it",
           .option = "--min-existence",
           .range = {.min = 0, .max = 0.499, .without_min = true},
           .expert = true}};
}

}  // namespace

FieldGroup fields_of(TrackOptions& options) {
  FieldGroup group{"",
                   "Tracking",
                   {{.key = "filter",
                     .value = choice(options.filter, {{"none", TemporalFilter::none},
                                                      {"features", TemporalFilter::features},
                                                      {"kalman", TemporalFilter::kalman}}),
                     .help = "How poses are filtered over time: none: each snapshot's own; "
                             "features: older features count, too, with weights that decay; "
                             "kalman: an error-state Kalman filter for each object",
                     .option = "--filter"},
                    {.key = "feature_decay_s",
                     .value = &options.feature_decay_s,
                     .help = "Filter features: the weight of a feature falls by a factor of e in "
                             "this time",
                     .option = "--feature-decay-s",
                     .unit = "s",
                     .range = positive(),
                     .expert = true},
                    {.key = "confirmations",
                     .value = &options.confirmations,
                     .help = "Number of snapshots in which a new object, or an object at a new "
                             "place, has to be seen before it is reported",
                     .option = "--confirmations",
                     .range = from_to(1, 1000)},
                    {.key = "max_carry_s",
                     .value = &options.max_carry_s,
                     .help = "Time for which an object that left its place may be carried, before "
                             "it is said to have disappeared",
                     .option = "--max-carry-s",
                     .unit = "s",
                     .range = positive()},
                    {.key = "min_move_m",
                     .value = &options.min_move_m,
                     .help = "Smaller steps are corrections of a pose, not moves",
                     .option = "--min-move-m",
                     .unit = "m",
                     .range = positive()},
                    {.key = "min_move_rad",
                     .value = &options.min_move_rad,
                     .help = "Smaller turns are corrections of a pose, not moves",
                     .option = "--min-move-rad",
                     .unit = "rad",
                     .range = positive()}}};
  for (Field& field : expert_fields_of(options)) group.fields.push_back(std::move(field));
  return group;
}

}  // namespace vantage
