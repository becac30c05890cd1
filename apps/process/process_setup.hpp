#pragma once

#include <exception>
#include <string>
#include <vector>

namespace vantage {

/// Readies the process before anything else: messages go to stderr as printable text; writing to a
/// file that may not grow, or to a reader that is gone, fails instead of ending the process; stdin,
/// stdout and stderr are open, so that no file of ours gets their numbers; and exceptions that a
/// library throws where no handler is reached, for lack of threads or memory, ends with this exit
/// code.
void set_up_process(int used_up_exit_code);

/// What an exception says has run out, memory or threads, and what to do; empty for other ones. TBB
/// says so in words alone.
std::string used_up_resource(const std::exception& error);

/// The arguments as the parser wants them: "-.1", which it takes for an option, is "-0.1".
std::vector<std::string> plain_arguments(int argc, char** argv);

}  // namespace vantage
