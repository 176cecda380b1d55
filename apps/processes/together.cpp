#include "apps/processes/together.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>

namespace neumann {

void end_all(const Processes& processes, const std::exception& error) {
    std::fputs(fmt::format("neumann: process {} on {}: {}\n", processes.rank(), processes.machine(), error.what()).c_str(), stderr);
    std::fflush(nullptr);
    std::_Exit(1);
}

}  // namespace neumann
