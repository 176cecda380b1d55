// A diffuse scene with T, R and Le apart, small enough to carry along: what depends on geometry alone is traced once, and a change
// of a material or of a lamp needs no ray. With F the mean over a facet's rays of what they see, ρ the reflectance and A Le what
// arrives from the lamps, found by samples of them,
//
//     K Le = ρ A Le,    K^{i+1} Le = ρ F K^i Le,    Le = Σ_j Le_j over lamps.
#pragma once

#include "core/scene/scene.h"
#include "operators/watch.h"

#include <cstdint>
#include <string>
#include <vector>

namespace neumann {

struct SeparatingSettings {
    std::size_t patches = 1000;      // approximate number
    std::uint32_t rays = 64;         // per facet; a power of two, also the number of samples of each lamp if they are few
    std::uint32_t camera_rays = 8;   // per pixel; a power of two
    std::size_t pixels = 128 * 128;  // at most; pixels of the film are joined by a whole factor
    std::uint64_t seed = 0;
};

struct SeparatedScene {
    struct Facet {
        std::uint32_t material;
        double area;  // m²
        Rgb reflectance{0.0};
    };
    struct Material {
        std::string name;
        Rgb reflectance{0.0};  // the mean over its facets by area
        bool is_even = true;   // the same everywhere
    };
    // A lamp, or the rest of many.
    struct Lamp {
        std::string name;
        Rgb colour{0.0};  // of its light, in any unit
        // By facet, W·m⁻²·sr⁻¹: Le, and the mean of the radiance that arrives, A Le.
        std::vector<Rgb> emitted = {}, arriving = {};
        // By pixel, what the camera sees of the sky; empty for other lamps.
        std::vector<Rgb> background = {};
    };
    // The camera's rays of a pixel: Σ weight · field[facet]. Entries of pixel p are [first[p], first[p + 1]).
    struct Camera {
        std::vector<std::uint32_t> first, facet;
        std::vector<double> weight;
    };

    int width = 0, height = 0, factor = 1;  // of the picture, whose pixels are `factor` of the film's wide
    std::uint32_t rays = 0;
    std::vector<std::uint32_t> seen;  // the facet that each ray of each facet sees; their number if none
    std::vector<Facet> facets;
    std::vector<Material> materials;
    std::vector<Lamp> lamps;
    Camera camera;
};

// Throws InputError, with a place in the file, if a material is not diffuse, and as PatchSpace and RayTable do; Stopped if `watch`
// stops it.
SeparatedScene separate(const Scene& scene, const SeparatingSettings& settings, const Watch& watch = {});

// K^i Le for i = 0 … bounces as pictures, row by row: the plain series, of which others may be copies.
std::vector<std::vector<Rgb>> pictures_of_series(const SeparatedScene& scene, int bounces);

}  // namespace neumann
