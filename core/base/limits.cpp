#include "core/base/limits.h"

#include "core/base/memory.h"

#include <oneapi/tbb/global_control.h>

namespace neumann {

struct ThreadLimit::Limit {
    oneapi::tbb::global_control control;
};

double memory_limit(const std::optional<double>& gibibytes) { return gibibytes ? *gibibytes * 0x1p30 : default_memory(); }

ThreadLimit::ThreadLimit(int threads) {
    if (threads > 0)
        limit_ = std::make_unique<Limit>(
            oneapi::tbb::global_control(oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads)));
}

ThreadLimit::~ThreadLimit() = default;

}  // namespace neumann
