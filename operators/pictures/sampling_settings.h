// How the terms are sampled.
#pragma once

#include "core/scene/scene.h"
#include "operators/walk/walk_settings.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

namespace neumann {

class DirectionTables;

enum class PathMethod {
    walk,           // from the camera, by directions of the material
    guided,         // the same by directions from which light comes, as tables tell
    surface,        // by points on all surfaces
    light,          // from the lights
    bidirectional,  // from both ends
    classic,        // the walk in mirrors and through glass alone
    pointwise       // each term by itself
};
// What its samples find counts for pixels all over the film.
inline bool splats(PathMethod method) { return method == PathMethod::light || method == PathMethod::bidirectional; }

struct SamplingSettings {
    PathMethod method = PathMethod::walk;
    std::shared_ptr<const DirectionTables> tables = {};  // of `guided`
    WalkSettings walk;
    SamplerKind sampler = SamplerKind::sobol;
    std::uint64_t seed = 0;
    std::uint32_t replicate_size = 8;  // samples a pixel; a power of two
    // What the pictures and their errors are of: this matrix times the samples' RGB. RGB itself without it.
    std::optional<glm::dmat3> colors = {};
    // Of `bidirectional`: in place of the terms, the ways (s, t) to make bounce N, weighted and then unweighted, N + 2 of each.
    bool ways_of_last_bounce = false;

    std::size_t quantities() const { return (static_cast<std::size_t>(walk.bounces) + 2) * (ways_of_last_bounce ? 2 : 1); }
};

// Is told how many pixels are done as work goes on, from any thread, and drops the work by answering true.
using PixelWatch = std::function<bool(std::uint64_t pixels_done)>;

}  // namespace neumann
