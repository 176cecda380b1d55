// The samples of pixels one by one, without contributions from the paths of other pixels.
#pragma once

#include "operators/render/from_paths/sample_layout.h"
#include "operators/watch.h"

#include <oneapi/tbb/parallel_for.h>

#include <atomic>
#include <functional>
#include <span>

namespace neumann {

// Gets the samples of a group of pixels, path by path with all quantities of a path together, and their rays; on any thread.
using OwnSamples = std::function<void(const PixelGroup&, std::span<const Rgb> samples, std::span<const std::uint64_t> rays)>;

// Calls f(group) for all groups of pixels, on all threads; false if `watch` stops it.
template <class F>
bool for_groups(const SampleLayout& layout, const Watch& watch, const F& f) {
    std::atomic<bool> stopped = false;
    oneapi::tbb::parallel_for(std::uint32_t{0}, layout.groups(), [&](std::uint32_t number) {
        if (stopped || watch.stop())
            stopped = true;
        else
            f(layout.group(number));
    });
    return !stopped;
}

}  // namespace neumann
