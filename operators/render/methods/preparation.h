// The work of a method before its first sample, foretold from the patches of the scene, at least one for each side.
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

    // Foretells the work for fields and tables for paths, and for the first and smallest fields of methods that read
    // pictures from fields; zero for methods whose preparation does not grow with the scene.
    Preparation of(const Method& method) const;
    // The method, or the finest of its coarser versions, whose preparation takes at most this many seconds.
    std::optional<Method> fitting(double seconds, const Method& method) const;
    // The same for the preparation that fits into a render of this many seconds. Throws InputError if there is none.
    Method in_time(double seconds, const Method& method) const;

    struct ShapeSides {
        double share = 0.0;  // of the area
        double sides = 0.0;  // number of sides that reflect or emit
    };

private:
    std::vector<ShapeSides> shapes_;
    double faces_ = 0.0;
    double seconds_per_ray_;
};

// Whether a method of paths prepares fields or tables on patches.
bool prepares_fields(const Method& method);

// The seconds after which a preparation is given up in a render of `seconds`: the forecast may be wrong by a half.
double cut_off_preparation(double seconds);

// "its fields on 4000 patches would take about 3.6 s to make"
std::string describe(const Preparation& preparation);

}  // namespace neumann
