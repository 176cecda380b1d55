#include "core/reader/import/read_raw_scene.h"

#include "core/base/error.h"
#include "core/reader/collada/read_collada.h"
#include "core/reader/import/file_kinds.h"
#include "core/reader/xml/parse_xml.h"

namespace neumann::reader {

RawScene read_raw_scene(const std::string& path, Warnings& warnings, Problems& problems) {
    switch (scene_format(path)) {
        case SceneFormat::mitsuba:
            return {parse_xml(path), {path}};
        case SceneFormat::collada:
            return read_collada(path, warnings, problems);
        case SceneFormat::gltf:
        case SceneFormat::pbrt:
            break;
    }
    throw InputError(path + ": scenes of this format cannot be read yet");
}

}  // namespace neumann::reader
