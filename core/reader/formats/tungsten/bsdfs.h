// Makes the materials as <bsdf>s.
#pragma once

#include "core/reader/formats/tungsten/textures.h"

#include <map>
#include <set>

namespace neumann::reader::tungsten {

class Bsdfs {
public:
    Bsdfs(JsonObject& root, Textures& textures, Importing& importing)
        : list_(root.list("bsdfs")), textures_(textures), importing_(importing) {}

    // Adds the materials of the list to the scene, so that problems of unused ones are reported.
    void add_all();
    // Adds the material of a primitive, which a property gives by name or as an object; if it is missing, one of albedo
    // 1. Returns whether it has textures. Throws InputError.
    bool add_of(Element& shape, JsonObject& primitive, const std::string& name = "bsdf");
    bool add_of(Element& shape, const nlohmann::json& value, const Location& place);
    // The same for a material inside another. `sided`: what reflects in it is the same from both sides. Returns false
    // if the property is missing.
    bool add_nested(Element& parent, JsonObject& bsdf, const std::string& name, bool sided);

private:
    std::optional<std::size_t> find(const std::string& name) const;
    // Whether light is let through in other ways than straight on; such a material has two different sides.
    bool transmits(const nlohmann::json& value, std::size_t depth = 0);
    void add(Element& parent, const nlohmann::json& value, const Location& place, bool sided);
    // The id of a material of the list, which is added to the scene if it is not there yet.
    const std::string& id_of(std::size_t index, bool sided);
    bool has_textures(const Element& e) const;

    JsonList list_;
    Textures& textures_;
    Importing& importing_;
    std::map<std::pair<std::size_t, bool>, std::string> ids_;  // empty: a reported error
    std::set<std::pair<std::size_t, bool>> open_;              // materials being made
    std::map<std::size_t, bool> transmits_;
    std::set<std::string> textured_;  // ids of materials with textures
    std::size_t depth_ = 0;
    std::string default_id_;
};

}  // namespace neumann::reader::tungsten
