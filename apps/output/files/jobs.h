// Runs jobs that are independent of one another, such as writing the files of a render.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace neumann {

// Runs the jobs in parallel, `at_once` at most (at least 1), and begins them in their order. If some throw, the exception of the
// first of them in that order is thrown, which is the same on any number of threads; those that follow it may be skipped.
void run_jobs(const std::vector<std::function<void()>>& jobs, std::size_t at_once);

}  // namespace neumann
