// Samples whole pictures of a scene by one method, replicate by replicate; each method implements this.
#pragma once

#include "operators/paths/walk/path_observer.h"
#include "operators/render/from_paths/own_samples.h"
#include "operators/render/from_paths/sampling_settings.h"
#include "operators/render/from_paths/tally.h"
#include "operators/statistics/sample_ranges.h"
#include "operators/watch.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace neumann {

class PictureSampler;
class TermEstimator;

// The paths of a render that can be traced again, group by group.
class PathsToInspect {
public:
    struct Group {
        std::uint32_t first, paths;
    };
    virtual ~PathsToInspect() = default;
    virtual std::uint32_t groups() const = 0;  // in a replicate
    virtual Group group(std::uint32_t number) const = 0;
    // Whether all of them are of replicate 0, because the data that its paths share take as long as a picture.
    virtual bool are_of_first_replicate() const { return false; }
    virtual void retrace(std::uint64_t replicate, const Group& group, PathObserver& observer) const = 0;
};

class PathSampler {
public:
    PathSampler(const Scene& scene, const SamplingSettings& settings)
        : scene_(&scene), settings_(settings), layout_(settings.layout(scene.film)) {}
    virtual ~PathSampler() = default;

    // The estimator for a single pixel, if pixels share nothing. Null: a replicate is a whole picture.
    virtual const TermEstimator* of_pixels() const { return nullptr; }

    // Adds a replicate's picture, all quantities of each pixel, black where a pixel has no samples. Returns false if `watch`
    // stopped it.
    virtual bool sample_picture(std::uint64_t replicate, std::vector<Rgb>& picture, SampleRanges& ranges, Tally& tally,
                                const Watch& watch) const = 0;

    // Calls `each` with the samples of all pixels, without the contributions of paths from the lights to pixels all
    // over the film. Returns the rays cast for data that pixels share; nothing if `watch` stopped it. std::logic_error
    // if all pixels share all paths.
    virtual bool has_own_samples() const { return false; }
    virtual std::optional<std::uint64_t> own_samples(std::uint64_t replicate, const OwnSamples& each, const Watch& watch) const;

    // Traces one group of paths again and reports it to `observer`; `first` is the first path of the group. Returns the samples,
    // path by path with all quantities, with the same bits as in sample_picture(); the plan leaves nothing out. std::logic_error
    // for a method without paths.
    virtual std::vector<Rgb> retrace(std::uint64_t replicate, std::uint32_t first, PathObserver& observer) const = 0;
    // For methods whose paths read light that others left (path_observer.h): traces again the group that contains the
    // path with number `path`, which has number of_read(path) in the group.
    virtual std::uint32_t of_read(std::uint32_t path) const;
    virtual void retrace_read(std::uint64_t replicate, std::uint32_t path, PathObserver& observer) const;
    virtual std::unique_ptr<const PathsToInspect> to_inspect() const;

    // For several methods together: the one that made a sample, and the sample's name there. A single method has no parts.
    struct OfPart {
        const PictureSampler& sampler;
        SampleName name;
        std::size_t part;
        const std::string& method;
    };
    virtual std::size_t parts() const { return 0; }
    virtual OfPart part_of(const SampleName& name) const;
    // The amount that a sample of a part with value 1 adds to the mean of its pixel, or of the pixel at a position on
    // the film, times the samples of a pixel.
    virtual double scale(std::size_t part, std::size_t quantity, std::uint32_t pixel) const;
    virtual double scale(std::size_t part, std::size_t quantity, const Vec2& position) const;

protected:
    const Scene* scene_;
    SamplingSettings settings_;
    SampleLayout layout_;
};

}  // namespace neumann
