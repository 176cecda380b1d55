// A scene: where things are, what they are made of, what shines, and who looks.
#pragma once

#include "core/base/error.h"
#include "core/base/warnings.h"
#include "core/emitter/emitters.h"
#include "core/geometry/geometry.h"
#include "core/material/materials.h"
#include "core/sensor/sensor.h"

#include <optional>
#include <string>

namespace neumann {

enum class SamplerKind { independent, sobol };

// Where a shape comes from, for messages: "shape 'cube'" and "bsdf 'diffuse'".
struct Origin {
    Location place;
    std::string shape, bsdf;
};

struct Scene {
    Geometry geometry;
    Materials materials;
    Emitters emitters;
    Sensor camera;
    Film film;

    // What the scene file asks for, if it does; the command line overrides it.
    std::optional<int> bounces;
    std::optional<SamplerKind> sampler;
    // Camera rays go through lights, and what surrounds the scene is black to them: there is no bounce 0.
    bool hide_emitters = false;

    std::string hash;             // of all files the scene was read from; empty for a scene made otherwise
    std::vector<Origin> origins;  // by shape; likewise
    Warnings warnings;
};

// The parts of a scene one by one, as the reader and the tests put it together.
struct SceneParts {
    std::vector<Shape> shapes;
    std::vector<Bsdf> bsdfs;
    std::vector<Materials::Sides> sides_of_shape;
    Lights lights;
    SensorOptions camera;
    Film film;
    std::optional<int> bounces;
    std::optional<SamplerKind> sampler;
    bool hide_emitters = false;
    std::string hash;
    std::vector<Origin> origins = {};
    Warnings warnings;
};

// Builds the search structures, and warns of what is odd but accepted: degenerate triangles, lights without area, no surfaces, no
// light, albedo above 1. Throws InputError as Geometry does.
Scene make_scene(SceneParts parts);

}  // namespace neumann
