// A scene: geometry, materials, emitters, sensor and film.
#pragma once

#include "core/base/error.h"
#include "core/base/warnings.h"
#include "core/emitter/emitters.h"
#include "core/geometry/geometry.h"
#include "core/material/materials.h"
#include "core/sampling/sampler.h"
#include "core/sensor/sensor.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace neumann {

// Where a shape and its material come from, for messages: "shape 'lamp'" by its id, or "shape 'cube'" by its type, and likewise
// "bsdf 'white'" or "bsdf 'diffuse'".
struct Origin {
    Location place;
    std::string shape, bsdf;
};

// Additional data of a scene: its file's settings for rendering, hash, origins and warnings.
struct SceneNotes {
    // Settings of the scene file, if it has them; the command line overrides them.
    std::optional<int> bounces;
    std::optional<SamplerKind> sampler;
    // Camera rays pass through lights and see a black environment, so bounce 0 is black.
    bool hide_emitters = false;

    std::string hash;                  // of all files the scene was read from; empty if it was not read from files
    std::vector<Origin> origins = {};  // by shape; empty if it was not read from files
    Warnings warnings;
    // What a lenient reader replaced or left out, with its place in the file, in the order of the file; also among the warnings.
    std::vector<std::string> replaced = {};
};

// A scene is immutable. Copies share large data.
class Scene : public SceneNotes {
    std::shared_ptr<const Geometry> shared_geometry_;
    std::shared_ptr<const Emitters> shared_emitters_;

public:
    Scene(std::shared_ptr<const Geometry> geometry, Materials materials, Emitters emitters, const Sensor& camera, const Film& film,
          SceneNotes notes);
    // The same scene with other materials.
    Scene with(Materials materials) const;
    // The same scene in the light of others; shapes that shone are dark. `lights.of_shape` may be empty.
    Scene with(Lights lights) const;
    // The same scene, seen on another film, and by another sensor.
    Scene with(const Film& film) const { return with(camera.options(), film); }
    Scene with(const SensorOptions& sensor, const Film& film) const;

    const Geometry& geometry;
    Materials materials;
    const Emitters& emitters;
    Sensor camera;
    Film film;
};

// The parts from which the reader and the tests make a scene.
struct SceneParts : SceneNotes {
    std::vector<Shape> shapes;
    std::vector<Bsdf> bsdfs;
    std::vector<Materials::Sides> sides_of_shape;
    Lights lights;
    SensorOptions camera;
    Film film;
};

// Builds the acceleration structures, and warns of odd but accepted input: degenerate triangles, lights without area, no surfaces,
// no light, albedo above 1, light that a meter misses. Throws InputError as Geometry and Sensor do.
Scene make_scene(SceneParts parts);

}  // namespace neumann
