// The state that the parts of the importer share.
#pragma once

#include "core/reader/formats/json_object.h"
#include "core/reader/formats/names.h"
#include "core/reader/xml/raw_scene.h"

#include <string>
#include <vector>

namespace neumann::reader::tungsten {

struct Importing {
    RawScene& scene;
    const NamedValues& definitions;
    Notes notes;
    Names ids = {}, mesh_names = {}, picture_names = {};
    bool two_sided = true;  // what reflects looks the same from its back

    const std::string& main_file() const { return scene.files.front(); }
    // Reports what is not known at a place, and goes on.
    void refuse(const Location& place, const std::string& what, const std::string& expected, const std::string& instead) {
        notes.problems.add(Unknown(place, what, expected, instead), place);
    }
};

// The path of the file that a property names; nothing if that is missing, or (with a problem) not found.
std::optional<std::string> find_named_file(JsonObject& object, const std::string& name, const Importing& importing);

// Reads a vector: three numbers, or one for all three.
std::optional<Vec3> find_vector(JsonObject& object, const std::string& name);

// The `type` of an object; "" for one that is not `known`, which is a problem, and of which a lenient reader makes what
// `instead` says. Throws InputError if there is no type.
std::string read_type(JsonObject& object, const std::string& what, const std::vector<std::string>& known,
                      const std::string& instead, Importing& importing);

// Reports media around or inside something.
void refuse_media(JsonObject& object, std::initializer_list<std::string> names, Importing& importing);

}  // namespace neumann::reader::tungsten
