// A scene: where things are, what they are made of, what shines, and who looks.
#pragma once

#include "core/base/error.h"
#include "core/base/warnings.h"
#include "core/emitter/emitters.h"
#include "core/geometry/geometry.h"
#include "core/material/materials.h"
#include "core/sensor/sensor.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace neumann {

enum class SamplerKind { independent, sobol };

// Where a shape comes from, for messages: "shape 'cube'" and "bsdf 'diffuse'".
struct Origin {
    Location place;
    std::string shape, bsdf;
};

// What a scene says beside what is in it: of its file, and of how it is meant to be rendered.
struct SceneNotes {
    // What the scene file asks for, if it does; the command line overrides it.
    std::optional<int> bounces;
    std::optional<SamplerKind> sampler;
    // Camera rays go through lights, and what surrounds the scene is black to them: there is no bounce 0.
    bool hide_emitters = false;

    std::string hash;                  // of all files the scene was read from; empty for a scene made otherwise
    std::vector<Origin> origins = {};  // by shape; likewise
    Warnings warnings;
};

// It does not change once it is made; copies share what is large, which is built once.
class Scene : public SceneNotes {
    std::shared_ptr<const Geometry> shared_geometry_;
    std::shared_ptr<const Emitters> shared_emitters_;

public:
    Scene(Geometry geometry, Materials materials, Emitters emitters, const Sensor& camera, const Film& film, SceneNotes notes);
    // The same scene made of other materials.
    Scene with(Materials materials) const;

    const Geometry& geometry;
    Materials materials;
    const Emitters& emitters;
    Sensor camera;
    Film film;
};

// The parts of a scene one by one, as the reader and the tests put it together.
struct SceneParts : SceneNotes {
    std::vector<Shape> shapes;
    std::vector<Bsdf> bsdfs;
    std::vector<Materials::Sides> sides_of_shape;
    Lights lights;
    SensorOptions camera;
    Film film;
};

// Builds the search structures, and warns of what is odd but accepted: degenerate triangles, lights without area, no surfaces, no
// light, albedo above 1. Throws InputError as Geometry does.
Scene make_scene(SceneParts parts);

}  // namespace neumann
