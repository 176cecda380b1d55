// Samples the terms by an irradiance cache (operators/paths/cache/cache_walk.h). All pixels of a replicate read the same records,
// so a replicate is a whole picture: a pass, in which all records have sampled their rays anew.
#pragma once

#include "core/sampling/sampler.h"
#include "operators/paths/cache/record_places.h"
#include "operators/paths/walk/observer.h"
#include "operators/render/from_paths/path_sampler.h"

#include <memory>
#include <optional>
#include <vector>

namespace neumann {

class CachePass;
class DirectLightSampler;
class RecordTracer;

class CachePaths : public PathMethod {
public:
    explicit CachePaths(std::shared_ptr<const RecordPlaces> records) : records_(std::move(records)) {}
    const RecordPlaces& records() const { return *records_; }

    std::shared_ptr<const PathSampler> sampler(const Scene& scene, const SamplingSettings& settings) const override;
    bool is_prepared() const override { return true; }
    std::uint64_t rays() const override { return records_->rays(); }
    double walks_worth(int, std::span<const double>) const override { return 16.0; }
    // The radii are r√2 and r, and the bias changes its sign between records. Where light has edges the error is of
    // order r, and the difference is 0.41 of it; where it is smooth the error is of order r², and the difference is all
    // of it. One third is taken, as in the grid convergence index for two grids and an order of 2 (Roache, Perspective:
    // A Method for Uniform Reporting of Grid Refinement Studies, 1994).
    std::optional<TwoRadii> two_radii() const override {
        return TwoRadii{.part_of_bias = 1.0 / 3.0, .errs_both_ways = true, .difference_is_of_kernel = false};
    }
    // Samples are bounded because records stand at fixed places, at a distance from what they see.
    bool is_bounded(const SamplingSettings&) const override { return true; }
    bool has_events() const override { return false; }  // samples are means of many rays
    std::string why_no_checkup() const override {
        return "records are shared by all pixels, and those of a pass are filled together";
    }
    std::optional<std::vector<Remedy>> remedies(const Scene&, bool) const override { return {{Remedy::bidirectional}}; }

private:
    std::shared_ptr<const RecordPlaces> records_;
};

class CacheSampler : public PathSampler {
public:
    CacheSampler(const Scene& scene, const SamplingSettings& settings, std::shared_ptr<const RecordPlaces> records);

    bool sample_picture(std::uint64_t replicate, std::vector<Rgb>& picture, SampleRanges& ranges, Tally& tally,
                        const Watch& watch) const override;
    // Fills the cache of the replicate again.
    std::vector<Rgb> retrace(std::uint64_t replicate, std::uint32_t first, PathObserver& observer) const override;
    // `ray`: the number of a ray of a record.
    std::uint32_t of_read(std::uint32_t) const override { return 0; }
    void retrace_read(std::uint64_t replicate, std::uint32_t ray, PathObserver& observer) const override;

private:
    struct Workspace;
    template <class Observer = NoObserver>
    void trace_group(std::uint64_t replicate, const PixelGroup& pixels, const CachePass& pass, Workspace& work,
                     const Observer& observer = {}) const;

    std::shared_ptr<const RecordPlaces> records_;
    std::shared_ptr<const DirectLightSampler> direct_;
    std::shared_ptr<const RecordTracer> tracer_;
};

}  // namespace neumann
