// The numbers of branches of a tree (tree_walk.h) by place: where a walk with weight β stands, and in which direction it came, say
// how many samples are best from there on (Rath, Grittmann, Herholz, Weier, Slusallek, EARS: Efficiency-Aware Russian Roulette and
// Splitting, 2022). The goal is the relative squared error of the sum of bounces. With X the light that a branch of weight 1
// brings, c its rays, I the light of the pixel, C and V the rays and the relative variance of a path,
//
//     r = β/I √(E[X²] / c · C / V)    where this is below 1: Russian roulette,
//     r = β/I √(Var X / c · C / V)    where this is above 1: splitting, and no change between the two.
//
// Var X is that of branches from one vertex, E[X²] − E[E[X | vertex]²]: no splitting takes away what varies between vertices.
// Splitting is rounded to whole numbers, because a random number of branches would bring variance even where X has none.
// The moments are learned by walks that already branch so, in rounds, cube by cube, each of which also splits at one vertex. I is
// that of the cube that the camera sees.
#pragma once

#include "core/geometry/place_cells.h"
#include "operators/paths/walk/walker.h"

#include <cstdint>
#include <unordered_map>

namespace neumann {

// Branches at a reflection: within these, because a pilot may have missed something.
constexpr double least_branches = 0.1, largest_branches = 16.0;

class PlaceRatios {
public:
    // E[X²], Var X and |E X|, over the channels, and c of branches from a cube.
    struct Moments {
        double second, variance, mean, rays;
    };
    // A cube, by place, direction and the number of reflections that may still follow.
    using Key = std::uint64_t;

    // Walks that neither split nor end, of this last bounce.
    PlaceRatios(PlaceCells cells, int bounces) : cells_(cells), bounces_(bounces) {}
    // `rays_by_variance`: C / V; `dark`: is added to I, as the eye does not see the relative error of what is dark.
    PlaceRatios(PlaceCells cells, int bounces, const std::unordered_map<Key, Moments>& learned, double rays_by_variance,
                double dark);

    // r before the reflection of this bounce, where `light` is that of the pixel; 1 where nothing was learned, and in the rest.
    double at(int bounce, const Walker& w, double light) const;
    // I of a path, by its first vertex.
    double light(const Walker& w) const;
    Key key(int bounce, const Walker& w) const;

private:
    struct Factors {
        float of_roulette, of_splitting;  // r I / β
        float light;
    };

    PlaceCells cells_;
    int bounces_;
    double dark_ = 1.0;
    std::unordered_map<Key, Factors> factors_;
};

}  // namespace neumann
