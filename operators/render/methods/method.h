// The methods that compute the terms of the series: a closed set, each with its own options and no others.
#pragma once

#include "core/scene/scene.h"
#include "operators/paths/cache/cache_settings.h"
#include "operators/paths/walk/hemisphere_continuation.h"
#include "operators/paths/walk/left_out.h"
#include "operators/paths/walk/tree_ratios.h"
#include "operators/paths/walk/walk_settings.h"
#include "operators/render/from_paths/allocation.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

namespace neumann {

class PathMethod;
class Prepared;
struct MethodOption;
struct SamplingSettings;
struct Watch;

namespace method {

struct Preparing {
    const Scene& scene;
    const SamplingSettings& settings;
    double memory;       // bytes, approximately
    Prepared& prepared;  // shared with pilots and with the renders that follow
    const Watch& watch;
};

enum class LeavingOut {
    by_plan,  // leave out the work that the plan proves unnecessary in this scene (operators/render/plan)
    nothing
};

// The size of fields or tables on patches that a method prepares, from which the time is foretold (preparation.h).
struct FieldNeeds {
    std::size_t patches;
    double rays_of_facet;
};

// The decisions of a plan that a method follows.
using Decisions = std::vector<bool LeftOut::*>;

// The options and functions of all methods that sample paths; a method that differs has a member of the same name. Each
// method has `name` and `help`, and prepare(), which makes everything that it needs before its first sample, such as
// tables, fields or photons, and returns how it samples; prepare() throws InputError, and Stopped if `watch` stops it.
// Options that no other method has are in own_options().
struct PathOptions {
    std::optional<SamplerKind> sampler = {};  // default: the scene's sampler, or Sobol' points if the scene names none
    LeavingOut plan = LeavingOut::by_plan;

    // Throw InputError if options exclude each other (`lights`: --lights was given), if the method cannot render the
    // scene, and if replicates of this many samples a pixel are too small for it.
    void expect_sense(bool /*lights*/) const {}
    void expect(const Scene&) const {}
    void expect_room(const Film&, std::uint32_t /*replicate_size*/) const {}
    // Decides about what pays only from a number of samples on, expected in each pixel where a walk would be one.
    void expect_samples(double /*samples*/, const Film&) {}
    // Sets the options that were left open to the values that were taken.
    void complete(const SamplingSettings&, const Film&) {}

    // The plan's decisions that the method follows; nothing if it leaves nothing out.
    std::optional<Decisions> leaves_out() const { return std::nullopt; }
    std::optional<FieldNeeds> needs() const { return std::nullopt; }
    static constexpr bool shows_fields_first = false;  // the first pictures are by fields, which show what it will make
    static constexpr bool is_studied = true;           // a study that names no methods includes it
    static constexpr bool is_biased = false;
    static constexpr const char* why_no_replay = "";
    bool operator==(const PathOptions&) const = default;
};

// Chooses among these methods the one that promises least error for its cost in the scene (choose_method.h).
struct Auto : PathOptions {
    static constexpr const char* name = "auto";
    static constexpr const char* help =
        "of walk, guided, corrected and bidirectional the one that promises least error in this scene, by a short pilot, the "
        "default "
        "(walk, if an option is given that auto does not have, or the render is small)";
    static constexpr bool shows_fields_first = true;
    static constexpr bool is_studied = false;
    std::optional<LeastError> adaptive = {};  // as in Walk; default: all, if a pilot for it pays
    bool bias_allowed = false;                // also choose among methods with a bias, which they state
    bool operator==(const Auto&) const = default;
};

// Path tracing: walks from the camera sample directions by the BSDF. One walk gives a sample of every bounce.
struct Walk : PathOptions {
    static constexpr const char* name = "walk";
    static constexpr const char* help = "one walk from the camera for all bounces";
    static constexpr bool shows_fields_first = true;
    DirectLightSettings direct = {};
    Roulette roulette = {};
    Split split = {};
    std::optional<LeastError> adaptive = {};         // pixels have different numbers of samples, to make this error least
    bool reuse = false;                              // walks of neighbouring pixels use each other's tails
    std::optional<TreeGoal> tree = {};               // the walk splits and ends by the best numbers for this goal
    std::optional<HemisphereDensity> indirect = {};  // directions in which it goes on; nothing: those of the material

    void expect_sense(bool lights) const;
    std::optional<Decisions> leaves_out() const;
    std::shared_ptr<const PathMethod> prepare(const Preparing& preparing) const;
    static std::vector<MethodOption> own_options();
    bool operator==(const Walk&) const = default;
};

// Path tracing whose diffuse reflections sample tables of the incident light (path guiding).
struct Guided : PathOptions {
    static constexpr const char* name = "guided";
    static constexpr const char* help = "walks with directions sampled from a matrix solution";
    static constexpr bool shows_fields_first = true;
    std::optional<std::size_t> patches = {};
    std::optional<std::uint32_t> directions = {};
    std::optional<LeastError> adaptive = {};  // as in Walk

    std::optional<Decisions> leaves_out() const;
    std::optional<FieldNeeds> needs() const;
    std::shared_ptr<const PathMethod> prepare(const Preparing& preparing) const;
    // The same method with ever coarser values of the options that were left open.
    std::vector<Guided> coarser() const;
    void complete(const SamplingSettings& settings, const Film& film);
    bool operator==(const Guided&) const = default;
};

// Corrected fields: walks from the camera read approximate fields on patches at the second diffuse surface, and the errors of the
// fields are carried by points that all pixels share.
struct Corrected : PathOptions {
    static constexpr const char* name = "corrected";
    static constexpr const char* help = "walks that read approximate fields on patches and remove their errors";
    static constexpr bool shows_fields_first = true;
    std::optional<std::size_t> patches = {};
    std::optional<std::uint32_t> directions = {};
    std::optional<LeastError> adaptive = {};  // as in Walk; all, if there are samples enough

    std::optional<FieldNeeds> needs() const;
    void expect_samples(double samples, const Film& film);
    std::shared_ptr<const PathMethod> prepare(const Preparing& preparing) const;
    std::vector<Corrected> coarser() const;  // as in Guided
    void complete(const SamplingSettings& settings, const Film& film);
    bool operator==(const Corrected&) const = default;
};

// Walks from the camera that choose the next vertex uniformly by area on all surfaces.
struct Surface : PathOptions {
    static constexpr const char* name = "surface";
    static constexpr const char* help = "walks with points sampled on all surfaces";
    static constexpr DirectLight direct_light = DirectLight::light;

    std::optional<Decisions> leaves_out() const;
    std::shared_ptr<const PathMethod> prepare(const Preparing& preparing) const;
    bool operator==(const Surface&) const = default;
};

// Light tracing: walks from the lights, joined to the camera.
struct Light : PathOptions {
    static constexpr const char* name = "light";
    static constexpr const char* help = "walks from the lights to the camera";
    Roulette roulette = {};

    void expect(const Scene& scene) const;
    std::shared_ptr<const PathMethod> prepare(const Preparing& preparing) const;
    bool operator==(const Light&) const = default;
};

// Source shooting: walks from the lights, every vertex of which is joined to the point that the camera sees.
struct Shooting : PathOptions {
    static constexpr const char* name = "shooting";
    static constexpr const char* help = "walks from the lights, joined to what the camera sees";
    static constexpr bool is_studied = false;
    static constexpr DirectLight direct_light = DirectLight::light;
    Roulette roulette = {};

    void expect(const Scene& scene) const;
    std::shared_ptr<const PathMethod> prepare(const Preparing& preparing) const;
    bool operator==(const Shooting&) const = default;
};

// Bidirectional path tracing: subpaths from both ends, joined at every pair of vertices.
struct Bidirectional : PathOptions {
    static constexpr const char* name = "bidirectional";
    static constexpr const char* help = "walks from both ends, joined everywhere";
    static constexpr bool shows_fields_first = true;
    DirectLightSettings direct = {};  // must be multiple importance sampling: it both samples lights and hits them
    Roulette roulette = {};
    Split split = {};
    std::optional<LeastError> adaptive = {};  // as in Walk
    std::optional<int> ways = {};             // show every way (s, t) to make this bounce (ways.h)

    void expect(const Scene& scene) const;
    void expect_sense(bool lights) const;
    std::shared_ptr<const PathMethod> prepare(const Preparing& preparing) const;
    static std::vector<MethodOption> own_options();
    bool operator==(const Bidirectional&) const = default;
};

// Progressive photon maps: paths from the lights leave their power where they are reflected, and walks from the camera
// read nearby photons.
struct Photon : PathOptions {
    static constexpr const char* name = "photon";
    static constexpr const char* help = "photon maps, for caustics, with a bias that falls";
    std::optional<std::uint32_t> photons = {};  // paths from the lights in each pass
    std::optional<double> radius = {};          // in the first pass; a pilot finds it if it is not given
    bool gather = false;                        // one more reflection is sampled before a map is read
    static constexpr bool is_biased = true;

    std::shared_ptr<const PathMethod> prepare(const Preparing& preparing) const;
    static std::vector<MethodOption> own_options();
    void complete(const SamplingSettings& settings, const Film& film);
    bool operator==(const Photon&) const = default;
};

// An irradiance cache: records on diffuse surfaces hold the irradiance of each bounce, computed from that of the bounce
// before, and walks from the camera read nearby records.
struct Cache : PathOptions {
    static constexpr const char* name = "cache";
    static constexpr const char* help = "an irradiance cache, for diffuse rooms, with a bias that stays";
    Spacing records = Spacing::hessian;            // the rule by which records are placed
    std::optional<double> accuracy = {};           // the error allowed to records (cache_settings.h)
    std::optional<std::uint32_t> directions = {};  // rays of a record in each pass
    static constexpr bool is_biased = true;

    // The settings, with defaults for options that are not given.
    CacheSettings settings() const;

    std::shared_ptr<const PathMethod> prepare(const Preparing& preparing) const;
    static std::vector<MethodOption> own_options();
    void complete(const SamplingSettings& settings, const Film& film);
    bool operator==(const Cache&) const = default;
};

// Multiplexed Metropolis light transport: for each bounce, Markov chains among the paths of the bidirectional method.
struct Metropolis : PathOptions {
    static constexpr const char* name = "metropolis";
    static constexpr const char* help = "chains of paths that mutate, for light that is hard to find";
    std::optional<std::uint32_t> chain = {};  // states of each chain in a replicate

    void expect(const Scene& scene) const;
    void expect_room(const Film& film, std::uint32_t replicate_size) const;
    std::shared_ptr<const PathMethod> prepare(const Preparing& preparing) const;
    static std::vector<MethodOption> own_options();
    void complete(const SamplingSettings& settings, const Film& film);
    bool operator==(const Metropolis&) const = default;
};

// Walk, guided, corrected, bidirectional, light and metropolis together: each block of the picture and each bounce is a
// mean of their pictures, weighted by their precision there, which a pilot estimates (best_mixture.h).
struct Mixed : PathOptions {
    static constexpr const char* name = "mixed";
    static constexpr const char* help =
        "walk, guided, corrected, bidirectional, light and metropolis, each for the blocks and the bounces where it is best";
    static constexpr bool shows_fields_first = true;
    static constexpr bool is_studied = false;
    std::optional<LeastError> adaptive = {};  // the error that it makes least; default: all

    std::shared_ptr<const PathMethod> prepare(const Preparing& preparing) const;
    bool operator==(const Mixed&) const = default;
};

// Classic ray tracing (Whitted): walks go on through mirrors and glass alone.
struct Classic : PathOptions {
    static constexpr const char* name = "classic";
    static constexpr const char* help = "mirrors and glass alone, which leaves out other paths";
    static constexpr bool is_studied = false;
    static constexpr DirectLight direct_light = DirectLight::light;

    std::optional<Decisions> leaves_out() const;
    std::shared_ptr<const PathMethod> prepare(const Preparing& preparing) const;
    bool operator==(const Classic&) const = default;
};

// Each bounce is sampled by walks of its own.
struct Pointwise : PathOptions {
    static constexpr const char* name = "pointwise";
    static constexpr const char* help = "each bounce by itself, slow and plain";
    static constexpr bool shows_fields_first = true;
    static constexpr bool is_studied = false;
    static constexpr const char* why_no_replay = "each of its bounces is asked for anew";

    void expect(const Scene& scene) const;
    std::shared_ptr<const PathMethod> prepare(const Preparing& preparing) const;
    bool operator==(const Pointwise&) const = default;
};

// Options of all methods with fields on patches. Options that are not given are chosen to reach the goal.
struct FieldOptions {
    std::optional<std::size_t> patches = {};
    std::optional<std::uint32_t> directions = {};  // rays per side of a patch, in all replicates together
    static constexpr bool is_biased = true;
    bool operator==(const FieldOptions&) const = default;
};

// Computes the series with T and R on patches and interpolates the field at the pixel.
struct Matrix : FieldOptions {
    static constexpr const char* name = "matrix";
    static constexpr const char* help = "T and R on patches, fast";
    bool operator==(const Matrix&) const = default;
};

// The same as Matrix, with K applied once more at the pixel (final gathering).
struct Gather : FieldOptions {
    static constexpr const char* name = "gather";
    static constexpr const char* help = "T and R on patches, with K applied once more at the pixel";
    bool operator==(const Gather&) const = default;
};

// Shows the piecewise constant field on the patches as it is.
struct Patches : FieldOptions {
    static constexpr const char* name = "patches";
    static constexpr const char* help = "the patches as they are";
    bool importance = false;  // show K*^i We in place of K^i Le
    bool operator==(const Patches&) const = default;
};

}  // namespace method

using Method =
    std::variant<method::Auto, method::Walk, method::Guided, method::Corrected, method::Surface, method::Light, method::Shooting,
                 method::Bidirectional, method::Mixed, method::Photon, method::Cache, method::Metropolis, method::Classic,
                 method::Pointwise, method::Matrix, method::Gather, method::Patches>;

inline const char* name_of(const Method& method) {
    return std::visit([](const auto& m) { return m.name; }, method);
}

template <class M>
concept MakesPaths = std::derived_from<M, method::PathOptions>;
template <class M>
concept HasFields = std::derived_from<M, method::FieldOptions>;

inline bool has_fields(const Method& method) {
    return std::visit([]<class M>(const M&) { return HasFields<M>; }, method);
}

// The error for which pixels have different numbers of samples; nothing if they have the same number.
inline std::optional<LeastError> adaptive_of(const Method& method) {
    return std::visit(
        [](const auto& m) -> std::optional<LeastError> {
            if constexpr (requires { m.adaptive; })
                return m.adaptive;
            else
                return {};
        },
        method);
}

// Whether the method's pictures have an error that samples do not show, and which it estimates.
inline bool is_biased(const Method& method) {
    return std::visit([](const auto& m) { return m.is_biased; }, method);
}

}  // namespace neumann
