// The materials as <bsdf>s.
#pragma once

#include "core/reader/formats/tungsten/textures.h"

#include <map>
#include <set>

namespace neumann::reader::tungsten {

class Bsdfs {
public:
    Bsdfs(JsonObject& root, Textures& textures, Importing& importing)
        : list_(root.list("bsdfs")), textures_(textures), importing_(importing) {}

    // Adds those of the list to the scene, which tells what is wrong with them.
    void add_all();
    // Adds the one that a property of a primitive means, by name or as an object; where it is missing, one of albedo 1. Returns
    // whether textures are on it. Throws InputError.
    bool add_of(Element& shape, JsonObject& primitive, const std::string& name = "bsdf");
    bool add_of(Element& shape, const nlohmann::json& value, const Location& place);
    // The same for one inside another, which is `sided`: what reflects in it is the same from both sides. Returns false where the
    // property is missing.
    bool add_nested(Element& parent, JsonObject& bsdf, const std::string& name, bool sided);

private:
    std::optional<std::size_t> find(const std::string& name) const;
    // What lets light through by other ways than straight on has two different sides.
    bool transmits(const nlohmann::json& value, std::size_t depth = 0);
    void add(Element& parent, const nlohmann::json& value, const Location& place, bool sided);
    // Of one of the list, which is added to the scene if it is not there yet.
    const std::string& id_of(std::size_t index, bool sided);
    bool has_textures(const Element& e) const;

    JsonList list_;
    Textures& textures_;
    Importing& importing_;
    std::map<std::pair<std::size_t, bool>, std::string> ids_;  // empty: has been told
    std::set<std::pair<std::size_t, bool>> open_;              // being made
    std::map<std::size_t, bool> transmits_;
    std::set<std::string> textured_;  // ids
    std::size_t depth_ = 0;
    std::string default_id_;
};

}  // namespace neumann::reader::tungsten
