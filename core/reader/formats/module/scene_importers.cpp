#include "core/reader/formats/scene_importers.h"

#include "core/reader/formats/collada/read_collada.h"
#include "core/reader/formats/gltf/import_gltf.h"
#include "core/reader/formats/pbrt/import_pbrt.h"
#include "core/reader/formats/tungsten/import_tungsten.h"

extern "C" const neumann::reader::SceneImporters* neumann_scene_importers() {
    using namespace neumann::reader;
    static const SceneImporters importers{read_collada, import_gltf, import_pbrt, import_tungsten};
    return &importers;
}
