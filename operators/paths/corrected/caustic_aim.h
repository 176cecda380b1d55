// Where caustics (caustics.h) come from: densities of the random numbers of paths from the lamps, and directions from surfaces.
#pragma once

#include "core/sampling/sampler.h"
#include "core/scene/scene.h"
#include "operators/paths/corrected/number_tree.h"
#include "operators/paths/guided/direction_tables.h"
#include "operators/watch.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace neumann {

// What a pilot learns of where caustics come from. It refers to no scene, but to the patches of the tables that it is given.
class CausticAim {
public:
    // Caustics of up to `bounces` reflections, the last one of which is diffuse. `tables`: of directions from diffuse sides; null
    // if there are none. Throws Stopped if `watch` stops it.
    CausticAim(const Scene& scene, int bounces, std::uint64_t seed, const DirectionTables* tables, const Watch& watch = {});

    // Whether there are caustics, and paths from the lamps find them better than walks that hit lamps by chance.
    bool pays() const { return pays_; }
    std::uint64_t rays() const { return rays_; }

    // Tables that also lead where caustics come from, for walks that make them; null if there are none.
    const DirectionTables* tables() const { return tables_ ? &*tables_ : nullptr; }

    using Numbers = NumberTree::Numbers;
    // A number for each density that is drawn from in turn: path i belongs to density i % densities().
    std::size_t densities() const { return trees_.size(); }
    Numbers draw(std::size_t density, const Numbers& uniform) const { return trees_[density].draw(uniform); }
    // The mean of all densities.
    double density(const Numbers& at) const;

private:
    std::optional<DirectionTables> tables_;
    std::vector<NumberTree> trees_ = std::vector<NumberTree>(1);  // the first is uniform
    bool pays_ = false;
    std::uint64_t rays_ = 0;
};

// The random numbers of an aimed path: a Sampler whose first numbers are moved by the tree.
class AimedNumbers {
public:
    // The numbers of a path of this density.
    AimedNumbers(const Sampler& sampler, const CausticAim& aim, std::size_t density) : sampler_(sampler) {
        NumberTree::Numbers uniform;
        for (std::size_t d = 0; d < NumberTree::dimensions; d += 2) {
            const Vec2 u = sampler_.next2();
            uniform[d] = u.x;
            uniform[d + 1] = u.y;
        }
        at_ = aim.draw(density, uniform);
        density_ = aim.density(at_);
    }
    const NumberTree::Numbers& at() const { return at_; }
    double density() const { return density_; }
    Vec2 next2() {
        if (given_ == NumberTree::dimensions) return sampler_.next2();
        given_ += 2;
        return {at_[given_ - 2], at_[given_ - 1]};
    }
    double next() { return sampler_.next(); }

private:
    Sampler sampler_;
    NumberTree::Numbers at_;
    double density_;
    std::size_t given_ = 0;
};

}  // namespace neumann
