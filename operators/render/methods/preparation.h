// What a method makes ready before its first sample, foretold from the patches of the scene: each side of a shape is one at least.
#pragma once

#include "operators/render/from_paths/pilot.h"
#include "operators/render/methods/method.h"

#include <optional>
#include <string>
#include <vector>

namespace neumann {

struct Preparation {
    double facets = 0.0;  // sides of patches
    double rays = 0.0;
    double seconds = 0.0;
};

class Preparations {
public:
    Preparations(const Scene& scene, const Pilot& pilot);

    // Of fields and tables for paths, and of the first and smallest fields of methods that read pictures from fields; nothing for
    // methods whose preparation does not grow with the scene.
    Preparation of(const Method& method) const;
    // The method, or the finest of those with an option less fine, of which the preparation takes at most so long.
    std::optional<Method> fitting(double seconds, const Method& method) const;
    // The one that takes no longer than it may in a render of so many seconds. Throws InputError if there is none.
    Method in_time(double seconds, const Method& method) const;

    struct ShapeSides {
        double share = 0.0;  // of the area
        double sides = 0.0;  // that reflect or shine
    };

private:
    std::vector<ShapeSides> shapes_;
    double faces_ = 0.0;
    double seconds_per_ray_;
};

// Whether a method of paths makes fields or tables on patches ready.
bool prepares_fields(const Method& method);

// A preparation is given up after so many seconds: what was foretold may be wrong by a half.
double cut_off_preparation(double seconds);

// "its fields on 4000 patches would take about 3.6 s to make"
std::string describe(const Preparation& preparation);

}  // namespace neumann
