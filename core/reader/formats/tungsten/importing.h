// What the parts of the importer share.
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
    // Tells of what is not known at a place, and goes on.
    void refuse(const Location& place, const std::string& what, const std::string& expected, const std::string& instead) {
        notes.problems.add(Unknown(place, what, expected, instead), place);
    }
};

// The file that a property names, found; nothing where that is a problem or is not there.
std::optional<std::string> find_named_file(JsonObject& object, const std::string& name, const Importing& importing);

// A vector: three numbers, or one for all three.
std::optional<Vec3> find_vector(JsonObject& object, const std::string& name);

// The `type` of an object; "" for one that is not among those known, after a problem, and a lenient reader makes of it what
// `instead` says. Throws InputError where there is none.
std::string read_type(JsonObject& object, const std::string& what, const std::vector<std::string>& known,
                      const std::string& instead, Importing& importing);

// Tells of what is in the space around or inside something.
void refuse_media(JsonObject& object, std::initializer_list<std::string> names, Importing& importing);

}  // namespace neumann::reader::tungsten
