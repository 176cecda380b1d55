// The guide of method guided: fields on patches of the scene, and the tables of directions that follow from them.
#pragma once

#include "core/base/memory.h"
#include "core/scene/scene.h"
#include "operators/paths/guided/direction_tables.h"
#include "operators/watch.h"

#include <cstdint>
#include <optional>

namespace neumann {

struct GuideSettings {
    std::size_t patches = 2000;        // approximate number
    std::uint32_t rays = 2048;         // per facet, to fill its tables; a power of two, at least CellDistribution::cells
    std::uint32_t field_rays = 64;     // per facet, for the fields; a power of two
    double share_of_material = 0.4;    // α of the tables
    int bounces = 8;                   // N: the last bounce wanted
    std::uint64_t seed = 0;            // random numbers are independent of those of walks with the same seed
    double memory = default_memory();  // approximate limit in bytes
};

class Guide {
public:
    // Keeps a reference to the scene. Throws InputError as scene_patches() does, and if the tables do not fit in
    // memory; and Stopped if `watch` stops it.
    Guide(const Scene& scene, const GuideSettings& settings, const Watch& watch = {});
    Guide(const Guide&) = delete;

    const DirectionTables& tables() const { return *tables_; }
    const GuideSettings& settings() const { return settings_; }
    std::uint64_t rays() const { return rays_; }

private:
    GuideSettings settings_;
    PatchSpace space_;
    std::optional<DirectionTables> tables_;
    std::uint64_t rays_ = 0;
};

}  // namespace neumann
