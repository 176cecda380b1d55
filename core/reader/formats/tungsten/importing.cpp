#include "core/reader/formats/tungsten/importing.h"

#include "core/base/did_you_mean.h"
#include "core/reader/formats/find_file.h"
#include "core/reader/meshes/mesh_text.h"

#include <algorithm>

#include <fmt/format.h>

namespace neumann::reader::tungsten {

std::optional<std::string> find_named_file(JsonObject& object, const std::string& name, const Importing& importing) {
    const std::optional<std::string> file = object.text(name);
    if (!file) return std::nullopt;
    return object.notes().problems.attempt(object.place_of(name),
                                           [&] { return find_file(*file, importing.main_file(), object.place_of(name)); });
}

std::optional<Vec3> find_vector(JsonObject& object, const std::string& name) {
    const nlohmann::json* value = object.value(name);
    if (!value) return std::nullopt;
    if (value->is_number()) return Vec3(object.number(name, 0.0));
    if (!value->is_array()) {
        object.complain(name, fmt::format("{} is {}, expected a number or an array of three", name, with_article(*value)));
        return std::nullopt;
    }
    const std::vector<double> numbers = object.numbers(name, {0.0, 0.0, 0.0});
    if (object.is_wrong(name)) return std::nullopt;
    return Vec3(numbers[0], numbers[1], numbers[2]);
}

std::string read_type(JsonObject& object, const std::string& what, const std::vector<std::string>& known,
                      const std::string& instead, Importing& importing) {
    const std::optional<std::string> type = object.text("type");
    if (!type) object.fail_missing("type", fmt::format("that of a {}", what));
    if (std::find(known.begin(), known.end(), *type) != known.end()) return *type;
    importing.refuse(object.place_of("type"), fmt::format("{} type '{}' is not supported", what, printable(*type)),
                     "; " + allowed_instead(*type, known), instead);
    return "";
}

void refuse_media(JsonObject& object, std::initializer_list<std::string> names, Importing& importing) {
    for (const std::string& name : names)
        if (const nlohmann::json* value = object.value(name); value && !value->is_null())
            importing.refuse(object.place_of(name), fmt::format("{}: media are not supported", name), ", expected empty space",
                             "left out");
}

}  // namespace neumann::reader::tungsten
