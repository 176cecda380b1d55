// Samples a replicate that is a whole picture, in which each pixel has its own samples: in groups, on all threads.
#pragma once

#include "operators/paths/walk/path_group.h"
#include "operators/render/from_paths/pixel_average.h"
#include "operators/render/from_paths/sampling_settings.h"
#include "operators/render/from_paths/tally.h"
#include "operators/watch.h"

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <atomic>
#include <vector>

namespace neumann {

// Calls trace(group, work), which samples these pixels of the replicate into work.group.samples. A Workspace is constructed from
// the number of quantities and has a group, an average and a tally. Otherwise like PathSampler::sample_picture().
template <class Workspace, class Trace>
bool sample_groups(const SamplingSettings& settings, const SampleLayout& layout, std::uint64_t replicate, std::vector<Rgb>& picture,
                   SampleRanges& ranges, Tally& tally, const Watch& watch, const Trace& trace) {
    const std::size_t Q = settings.quantities();
    oneapi::tbb::enumerable_thread_specific<Workspace> workspaces([&] {
        Workspace work(Q);
        work.tally = without_smaller_samples(tally);
        return work;
    });
    const std::uint32_t groups = layout.groups();
    std::atomic<bool> dropped = false;
    std::atomic<std::uint32_t> done = 0;
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::uint32_t>(0, groups, 4), [&](const auto& range) {
        if (dropped) return;
        Workspace& work = workspaces.local();
        for (std::uint32_t number = range.begin(); number < range.end(); ++number) {
            const PixelGroup group = layout.group(number);
            const auto [begin, end, size] = group;
            trace(group, work);
            for (std::uint32_t pixel = begin; pixel < end; ++pixel) {
                average(std::span(work.group.samples).subspan((pixel - begin) * size * Q, size * Q), size, pixel, replicate,
                        settings.colors, work.average, std::span(ranges.of).subspan(pixel * Q, Q), work.tally);
                std::copy(work.average.mean.begin(), work.average.mean.end(),
                          picture.begin() + static_cast<std::ptrdiff_t>(pixel * Q));
            }
        }
        done += static_cast<std::uint32_t>(range.size());
        watch.progress({.fraction = static_cast<double>(done) / groups});
        if (watch.stop()) dropped = true;
    });
    if (dropped) return false;
    for (const Workspace& work : workspaces) tally.merge(work.tally);
    return true;
}

}  // namespace neumann
