#include "core/reader/import/read_raw_scene.h"

#include "core/base/error.h"
#include "core/reader/import/file_kinds.h"
#include "core/reader/pbrt/import_pbrt.h"
#include "core/reader/xml/parse_xml.h"

namespace neumann::reader {

RawScene read_raw_scene(const std::string& path, Warnings& warnings, Problems& problems) {
    switch (scene_format(path)) {
        case SceneFormat::mitsuba:
            return {parse_xml(path), {path}};
        case SceneFormat::pbrt:
            return import_pbrt(path, warnings, problems);
        case SceneFormat::collada:
        case SceneFormat::gltf:
            break;
    }
    throw InputError(path + ": scenes of this format cannot be read yet");
}

}  // namespace neumann::reader
