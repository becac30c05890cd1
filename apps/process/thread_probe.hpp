#pragma once

namespace vantage {

/// Starts this many threads at once, for a moment: TBB, whose own threads start when there is work,
/// would end the process if the system refused them.
/// @throws Error out_of_resources if they cannot all be started.
void check_threads_start(int count);

}  // namespace vantage
