#include "core/reader/read_raw_scene.h"

#include "core/base/module.h"
#include "core/reader/file_kinds.h"
#include "core/reader/formats/scene_importers.h"
#include "core/reader/xml/parse_xml.h"

namespace neumann::reader {

namespace {

const SceneImporters& importers() {
    static const auto& loaded = offer_of_module<SceneImporters>(NEUMANN_SCENE_IMPORTERS, "neumann_scene_importers",
                                                                "scenes of other programs cannot be read");
    return loaded;
}

}  // namespace

RawScene read_raw_scene(const std::string& path, const NamedValues& definitions, Warnings& warnings, Problems& problems) {
    switch (scene_format(path)) {
        case SceneFormat::collada:
            return importers().collada(path, definitions, warnings, problems);
        case SceneFormat::gltf:
            return importers().gltf(path, definitions, warnings, problems);
        case SceneFormat::pbrt:
            return importers().pbrt(path, definitions, warnings, problems);
        case SceneFormat::tungsten:
            return importers().tungsten(path, definitions, warnings, problems);
        default:
            return {parse_xml(path), {path}};
    }
}

}  // namespace neumann::reader
