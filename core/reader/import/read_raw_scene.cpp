#include "core/reader/import/read_raw_scene.h"

#include "core/base/error.h"
#include "core/reader/gltf/import_gltf.h"
#include "core/reader/import/file_kinds.h"
#include "core/reader/xml/parse_xml.h"

namespace neumann::reader {

RawScene read_raw_scene(const std::string& path, const std::map<std::string, std::string>& definitions, Warnings& warnings,
                        Problems& problems) {
    switch (scene_format(path)) {
        case SceneFormat::mitsuba:
            return {parse_xml(path), {path}};
        case SceneFormat::gltf:
            return import_gltf(path, definitions, warnings, problems);
        case SceneFormat::collada:
        case SceneFormat::pbrt:
            break;
    }
    throw InputError(path + ": scenes of this format cannot be read yet");
}

}  // namespace neumann::reader
