// A way of sampling the terms by paths: its sampler, and everything that a render, its report and its health need to
// know about it. A method is one class, beside its sampler; no other code distinguishes methods.
#pragma once

#include "core/base/warnings.h"
#include "core/scene/scene.h"
#include "operators/render/from_paths/least_error.h"
#include "operators/watch.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace neumann {

class PathSampler;
struct Allocation;
struct SamplingSettings;

// The set of paths that a method makes.
enum class Paths {
    all,
    without_specular,  // no reflection by a delta lobe (mirror, glass)
    without_caustics,  // no light by a delta lobe onto the first vertex that the camera sees, by mirrors and glass or without
    seen_directly,     // the vertex that the camera sees is on a surface and does not scatter by a delta lobe
    specular           // all reflections are by delta lobes, except the last one, which samples the lights
};

enum class Remedy {
    sample_lights,  // the walk with multiple importance sampling: the vertex that hit the light could have sampled it
    // Two neighbouring vertices, or the camera and the first vertex, can be connected: paths from the lights find light
    // behind a delta lobe more often than walks hit it by chance.
    bidirectional,
    more_bounces  // the rest is sampled from the camera alone, so a larger N helps
};

// Describes a method that reads light within two radii, whose difference estimates its bias (picture_bias.h).
struct TwoRadii {
    double part_of_bias;  // the difference as a part of the bias
    bool errs_both_ways;  // the bias has both signs, so that the difference is 0 in places where the bias is not
    // Whether the variance of the difference is half of the picture's; otherwise it is that of the terms.
    bool difference_is_of_kernel;
};

class PathMethod {
public:
    virtual ~PathMethod() = default;

    // Keeps a reference to the scene.
    virtual std::shared_ptr<const PathSampler> sampler(const Scene& scene, const SamplingSettings& settings) const = 0;
    // Distributes samples over pixels by a pilot (allocation.h). Throws Stopped if `watch` stops it.
    virtual std::shared_ptr<const Allocation> allocate(const Scene& scene, const SamplingSettings& settings, LeastError least,
                                                       const Watch& watch) const;
    // The number of pictures of a sample: the terms 0 … N and the rest.
    virtual std::size_t pictures(int bounces) const { return static_cast<std::size_t>(bounces) + 2; }

    // Whether something is prepared before the first sample, and the rays cast for it.
    virtual bool is_prepared() const { return false; }
    virtual std::uint64_t rays() const { return 0; }
    // The time of a sample relative to a plain walk, which casts `rays_of_walk` rays for each bounce.
    virtual double walks_worth(int bounces, std::span<const double> rays_of_walk) const = 0;
    // Whether its first picture is given up if it is not finished in time; that of the walk is waited for.
    virtual bool first_may_be_late() const { return true; }

    // The paths that it makes, and its warnings for a scene.
    virtual Paths paths(const Scene&) const { return Paths::all; }
    virtual void warn(const Scene& scene, Warnings& warnings) const;
    // Whether it samples the rest beyond bounce N.
    virtual bool has_rest() const { return true; }
    // Whether it makes no bounce beyond the first.
    virtual bool ends_at_first(const Scene&) const { return false; }

    // Whether samples contribute to pixels all over the film.
    virtual bool splats() const { return false; }
    // Whether all pixels must have equally many samples, because they share all paths.
    virtual bool has_even_samples() const { return false; }
    // The number of consecutive pixels that share paths.
    virtual std::uint32_t sharing_pixels() const { return 1; }
    // Whether paths start at the camera, and whether at the lights.
    virtual bool starts_at_camera() const { return true; }
    virtual bool starts_at_lights() const { return false; }
    virtual std::optional<TwoRadii> two_radii() const { return std::nullopt; }

    // Whether samples of bounces 0 … N are proven to be bounded if no light is without extent (bounded_samples.h).
    virtual bool is_bounded(const SamplingSettings& settings) const = 0;
    // Whether the contribution of a path to this quantity has no bound: it falls with the distance of a vertex from the
    // camera or with the radius in which photons are read, and grows with 1/p of a light that is seldom chosen.
    virtual bool is_boundless(std::size_t /*quantity*/) const { return false; }
    // Whether a pixel's value is a sum of events, none of which is negative.
    virtual bool has_events() const { return true; }
    virtual bool has_chains() const { return false; }
    // Whether a walk goes on until its roulette ends it: its cost in a furnace is then known.
    virtual bool ends_by_roulette() const { return false; }

    // Why its paths are not checked, have no balance of energy, or a pixel no history, in words; "" if there is no reason.
    virtual std::string why_no_checkup() const { return ""; }
    virtual std::string why_no_balance() const { return ""; }
    virtual std::string why_no_history() const { return ""; }
    // False if rays end at sampled points, which may lie in the plane of their start.
    virtual bool rays_meet_surfaces() const { return true; }
    // The remedies against its fireflies; nothing if they depend on the path.
    virtual std::optional<std::vector<Remedy>> remedies(const Scene&, bool /*of_rest*/) const { return std::nullopt; }

protected:
    // Warns of light from lights without extent that is not found where there are mirrors; null if there is none.
    static constexpr const char* unfound_from_both_ends =
        "what is seen in a mirror of a light without extent is not found from either end and is missing";
    virtual const char* unfound_in_mirrors() const;
};

// The method as an M, or null if it is another one.
template <class M>
const M* as(const std::shared_ptr<const PathMethod>& method) {
    return dynamic_cast<const M*>(method.get());
}

}  // namespace neumann
