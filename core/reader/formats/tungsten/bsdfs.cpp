#include "core/reader/formats/tungsten/bsdfs.h"

#include "core/base/did_you_mean.h"
#include "core/reader/formats/make_elements.h"
#include "core/reader/formats/tungsten/bsdf_maker.h"
#include "core/reader/meshes/mesh_text.h"
#include "core/reader/xml/objects.h"

#include <algorithm>

#include <fmt/format.h>

namespace neumann::reader::tungsten {

namespace {

std::string text_in(const nlohmann::json& object, const char* name) {
    const auto found = object.find(name);
    return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

}  // namespace

std::optional<std::size_t> Bsdfs::find(const std::string& name) const {
    for (std::size_t i = 0; i < list_.size(); ++i)
        if (list_[i].is_object() && text_in(list_[i], "name") == name) return i;
    return std::nullopt;
}

bool Bsdfs::transmits(const nlohmann::json& value, std::size_t depth) {
    if (value.is_string()) {
        const auto index = find(value.get<std::string>());
        if (!index) return false;
        const auto [known, is_new] = transmits_.try_emplace(*index, false);
        if (is_new) transmits_[*index] = transmits(list_[*index], depth + 1);
        return transmits_[*index];
    }
    if (!value.is_object() || depth > max_nesting) return false;
    const std::string type = text_in(value, "type");
    const auto any_of = [&](std::initializer_list<const char*> names) {
        return std::any_of(names.begin(), names.end(), [&](const char* name) {
            const auto inner = value.find(name);
            return inner != value.end() && transmits(*inner, depth + 1);
        });
    };
    if (type == "dielectric" || type == "rough_dielectric") return value.value("enable_refraction", nlohmann::json(true)) != false;
    if (type == "mixed") return any_of({"bsdf0", "bsdf1"});
    if (type == "transparency") return any_of({"base"});
    if (type == "smooth_coat" || type == "rough_coat") return any_of({"substrate"});
    return type == "diffuse_transmission";
}

void Bsdfs::add_all() {
    for (std::size_t i = 0; i < list_.size(); ++i)
        importing_.notes.problems.attempt(list_.place_of(i), [&] {
            const auto [known, is_new] = transmits_.try_emplace(i, false);
            if (is_new) transmits_[i] = transmits(list_[i]);
            id_of(i, importing_.two_sided && !transmits_[i]);
        });
}

const std::string& Bsdfs::id_of(std::size_t index, bool sided) {
    const std::pair key{index, sided};
    const auto known = ids_.find(key);
    if (known != ids_.end()) {
        if (known->second.empty()) throw AlreadyReported();
        return known->second;
    }
    const Location place = list_.place_of(index);
    if (!open_.insert(key).second) throw InputError(place, "the bsdf stands inside itself");
    const auto made = importing_.notes.problems.attempt(place, [&] {
        JsonObject object = list_.object(index);
        const std::string name = object.text("name").value_or("");
        Element e = BsdfMaker(object, *this, textures_, importing_, sided).make();
        const std::string id = importing_.ids.unique(name.empty() ? fmt::format("bsdf_{}", index) : name);
        e.attributes.push_back({"id", id, place});
        if (has_textures(e)) textured_.insert(id);
        reader::add(importing_.scene.root, std::move(e));
        return id;
    });
    open_.erase(key);
    ids_[key] = made.value_or("");
    if (!made) throw AlreadyReported();
    return ids_[key];
}

bool Bsdfs::has_textures(const Element& e) const {
    if (e.tag == "texture") return true;
    if (e.tag == "ref") return textured_.contains(e.attribute("id").value);
    return std::any_of(e.children.begin(), e.children.end(), [&](const Element& child) { return has_textures(child); });
}

void Bsdfs::add(Element& parent, const nlohmann::json& value, const Location& place, bool sided) {
    if (value.is_string()) {
        const auto name = value.get<std::string>();
        const auto index = find(name);
        if (!index) {
            std::vector<std::string> names;
            for (std::size_t i = 0; i < list_.size(); ++i)
                if (list_[i].is_object()) names.push_back(text_in(list_[i], "name"));
            if (list_.broken()) throw AlreadyReported();
            throw InputError(place, fmt::format("there is no bsdf '{}'{}", printable(name), did_you_mean(name, names)));
        }
        add_reference(parent, id_of(*index, sided), place);
        return;
    }
    if (!value.is_object())
        throw InputError(place, fmt::format("the bsdf is {}, expected the name of one or an object", with_article(value)));
    if (depth_ >= max_nesting) throw InputError(place, fmt::format("bsdfs are nested more than {} deep", max_nesting));
    ++depth_;
    const auto made = importing_.notes.problems.attempt(place, [&] {
        return BsdfMaker({value, place, importing_.notes}, *this, textures_, importing_, sided).make();
    });
    --depth_;
    if (!made) throw AlreadyReported();
    reader::add(parent, *made);
}

bool Bsdfs::add_of(Element& shape, const nlohmann::json& value, const Location& place) {
    add(shape, value, place, importing_.two_sided && !transmits(value));
    return has_textures(shape.children.back());
}

bool Bsdfs::add_of(Element& shape, JsonObject& primitive, const std::string& name) {
    if (const nlohmann::json* value = primitive.value(name)) return add_of(shape, *value, primitive.place_of(name));
    if (default_id_.empty()) {
        const Location& place = importing_.scene.root.place;
        static const nlohmann::json white = {{"type", "lambert"}};
        Element e = BsdfMaker({white, place, importing_.notes}, *this, textures_, importing_, importing_.two_sided).make();
        default_id_ = importing_.ids.unique("default");
        e.attributes.push_back({"id", default_id_, place});
        reader::add(importing_.scene.root, std::move(e));
    }
    add_reference(shape, default_id_, primitive.place());
    return false;
}

bool Bsdfs::add_nested(Element& parent, JsonObject& bsdf, const std::string& name, bool sided) {
    const nlohmann::json* value = bsdf.value(name);
    if (!value) return false;
    add(parent, *value, bsdf.place_of(name), sided);
    return true;
}

}  // namespace neumann::reader::tungsten
