#include "core/reader/formats/pbrt/read_directives.h"

#include "core/reader/formats/pbrt/directive_reader.h"

namespace neumann::reader::pbrt {

PbrtScene read_directives(const std::string& path, Warnings& warnings, Problems& problems) {
    PbrtScene scene({path, 1, 1});
    // Shapes without a directive Material have this material.
    scene.materials.push_back({{"diffuse", Parameters("material 'diffuse'", scene.start, problems)}, ""});
    DirectiveReader reader(scene, warnings, problems);
    reader.read_file(path);
    reader.check_end();
    return scene;
}

}  // namespace neumann::reader::pbrt
