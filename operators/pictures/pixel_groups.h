// The pixels of a replicate that is a whole picture, where each pixel has samples of its own: group by group, on all threads.
#pragma once

#include "operators/pictures/path_group.h"
#include "operators/pictures/pixel_average.h"
#include "operators/pictures/sampling_settings.h"
#include "operators/pictures/tally.h"
#include "operators/watch.h"

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <algorithm>
#include <atomic>
#include <vector>

namespace neumann {

inline std::uint32_t pixels_of_group(const SamplingSettings& settings) {
    return std::max(paths_at_once / settings.replicate_size, 1u);
}

// Calls trace(first, samples, work), which samples these samples of the replicate, numbered pixel by pixel, into
// work.group.samples. A Workspace is made for a number of quantities and has a group, an average and a tally. As PictureSampler's
// samplers of pictures.
template <class Workspace, class Trace>
bool sample_groups(const SamplingSettings& settings, std::uint32_t pixels, std::uint64_t replicate, std::vector<Rgb>& picture,
                   SampleRanges& ranges, Tally& tally, const Watch& watch, const Trace& trace) {
    const std::size_t Q = settings.quantities();
    oneapi::tbb::enumerable_thread_specific<Workspace> workspaces([&] {
        Workspace work(Q);
        work.tally = without_smaller_samples(tally);
        return work;
    });
    const std::uint32_t size = settings.replicate_size, at_once = pixels_of_group(settings),
                        groups = (pixels + at_once - 1) / at_once;
    std::atomic<bool> dropped = false;
    std::atomic<std::uint32_t> done = 0;
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::uint32_t>(0, groups, 4), [&](const auto& range) {
        if (dropped) return;
        Workspace& work = workspaces.local();
        for (std::uint32_t group = range.begin(); group < range.end(); ++group) {
            const std::uint32_t begin = group * at_once, end = std::min(begin + at_once, pixels);
            trace(begin * size, (end - begin) * size, work);
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
