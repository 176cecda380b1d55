// The readers of scenes of other programs, which a module offers: it is loaded when such a scene is first read, so that nobody who
// has none waits for it to be compiled.
#pragma once

#include "core/base/warnings.h"
#include "core/reader/xml/problems.h"
#include "core/reader/xml/raw_scene.h"

#include <string>

namespace neumann::reader {

struct SceneImporters {
    // As read_raw_scene().
    using Import = RawScene(const std::string& path, const NamedValues& definitions, Warnings& warnings, Problems& problems);
    Import *collada, *gltf, *pbrt, *tungsten;
};

}  // namespace neumann::reader

extern "C" const neumann::reader::SceneImporters* neumann_scene_importers();
