#include "apps/output/files/jobs.h"

#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>
#include <atomic>
#include <exception>

namespace neumann {

void run_jobs(const std::vector<std::function<void()>>& jobs, std::size_t at_once) {
    std::vector<std::exception_ptr> thrown(jobs.size());
    std::atomic<bool> failed = false;
    std::size_t next = 0;
    const auto take = oneapi::tbb::make_filter<void, std::size_t>(oneapi::tbb::filter_mode::serial_in_order,
                                                                  [&](oneapi::tbb::flow_control& flow) {
                                                                      if (next == jobs.size() || failed) flow.stop();
                                                                      return next++;
                                                                  });
    const auto work = oneapi::tbb::make_filter<std::size_t, void>(oneapi::tbb::filter_mode::parallel, [&](std::size_t i) {
        try {
            // A job that waits for its own parallel work must not begin another, because both would hold their memory.
            oneapi::tbb::this_task_arena::isolate(jobs[i]);
        } catch (...) {
            thrown[i] = std::current_exception();
            failed = true;
        }
    });
    oneapi::tbb::parallel_pipeline(at_once, take & work);
    for (const std::exception_ptr& exception : thrown)
        if (exception) std::rethrow_exception(exception);
}

}  // namespace neumann
