#include "core/reader/read_raw_scene.h"

#include "core/reader/formats/collada/read_collada.h"
#include "core/reader/formats/file_kinds.h"
#include "core/reader/formats/gltf/import_gltf.h"
#include "core/reader/formats/pbrt/import_pbrt.h"
#include "core/reader/formats/tungsten/import_tungsten.h"
#include "core/reader/xml/parse_xml.h"

namespace neumann::reader {

RawScene read_raw_scene(const std::string& path, const NamedValues& definitions, Warnings& warnings, Problems& problems) {
    switch (scene_format(path)) {
        case SceneFormat::collada:
            return read_collada(path, definitions, warnings, problems);
        case SceneFormat::gltf:
            return import_gltf(path, definitions, warnings, problems);
        case SceneFormat::pbrt:
            return import_pbrt(path, definitions, warnings, problems);
        case SceneFormat::tungsten:
            return import_tungsten(path, definitions, warnings, problems);
        default:
            return {parse_xml(path), {path}};
    }
}

}  // namespace neumann::reader
