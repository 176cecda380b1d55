#include "core/reader/formats/pbrt/materials.h"

#include "core/base/did_you_mean.h"
#include "core/reader/formats/make_elements.h"
#include "core/reader/formats/pbrt/bsdf_maker.h"
#include "core/reader/meshes/mesh_text.h"

#include <fmt/format.h>

namespace neumann::reader::pbrt {

namespace {

bool is_interface(const MaterialEntity& m) { return m.type == "interface" || m.type.empty() || m.type == "none"; }

}  // namespace

Materials::Materials(PbrtScene& scene, Textures& textures, Importer& importer)
    : scene_(scene), textures_(textures), importer_(importer) {
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        if (!scene.materials[i].name.empty()) by_name_.try_emplace(scene.materials[i].name, i);
}

void Materials::make_all() {
    for (std::size_t i = 1; i < scene_.materials.size(); ++i) {
        bool is_made = false;
        for (const Coordinates c : {Coordinates::same, Coordinates::sphere, Coordinates::disk})
            is_made = is_made || made_.contains({i, c});
        if (!is_made) importer_.problems.attempt(scene_.materials[i].place(), [&] { make(i, Coordinates::same); });
    }
}

std::size_t Materials::find(const std::string& name, const Location& place) const {
    const auto found = by_name_.find(name);
    if (found != by_name_.end()) return found->second;
    std::vector<std::string> names;
    for (const auto& [other, number] : by_name_) names.push_back(other);
    throw InputError(place, fmt::format("there is no material '{}'{}", printable(name), did_you_mean(name, names)));
}

MadeMaterial Materials::use(const MaterialUse& use, Coordinates coordinates) {
    return make(use.name.empty() ? use.number : find(use.name, use.place), coordinates);
}

MadeMaterial Materials::make(std::size_t number, Coordinates coordinates) {
    for (const Coordinates c : {Coordinates::same, Coordinates::sphere, Coordinates::disk}) {
        const auto known = made_.find({number, c});
        if (known != made_.end() && (c == coordinates || !known->second.needs_coordinates)) return known->second;
    }
    MaterialEntity& m = scene_.materials[number];
    MadeMaterial result;
    result.is_interface = is_interface(m);
    if (result.is_interface) {
        m.parameters.finish();
        return made_[{number, coordinates}] = result;
    }
    if (!open_.insert(number).second)
        throw InputError(m.place(), fmt::format("material '{}' is a mixture of itself", printable(m.name)));
    constexpr std::size_t max_depth_of_mixtures = 100;
    if (open_.size() > max_depth_of_mixtures) {
        open_.erase(number);
        throw InputError(m.place(), fmt::format("mixtures are nested more than {} deep", max_depth_of_mixtures));
    }
    std::optional<Element> e =
        importer_.problems.attempt(m.place(), [&] { return make_element(m, coordinates, result.needs_coordinates); });
    open_.erase(number);
    if (!e) {  // unknown, or unused because of a problem
        e = make_object("bsdf", "twosided", m.place());
        add(*e, make_object("bsdf", "diffuse", m.place()));
    }
    result.id = unused_id(m.name.empty() ? fmt::format("{}-{}", m.type, m.place().line) : m.name);
    e->attributes.push_back(make_object("bsdf", "", m.place(), result.id).attributes.back());
    elements_.push_back(std::move(*e));
    return made_[{number, coordinates}] = result;
}

Element Materials::make_element(MaterialEntity& m, Coordinates coordinates, bool& needs_coordinates) {
    if (m.type == "mix") return make_mix(m, coordinates, needs_coordinates);
    BsdfMaker maker(m, textures_, importer_, coordinates);
    Element e = maker.make();
    needs_coordinates = maker.needs_coordinates();
    return e;
}

// pbrt takes the second material with the probability `amount`.
Element Materials::make_mix(MaterialEntity& m, Coordinates coordinates, bool& needs_coordinates) {
    Parameters& p = m.parameters;
    const std::vector<std::string> names = p.texts("materials");
    if (names.size() != 2)
        p.complain("materials", fmt::format("materials of {} are {} names, expected two", p.title(), names.size()));
    const TextureValue amount = textures_.find_number(p, "amount").value_or(TextureValue{Rgb(0.5)});
    if (const Rgb* c = amount.constant(); c && !(c->r >= 0.0 && c->r <= 1.0))
        p.complain("amount", fmt::format("amount of {} is {}, expected from 0 to 1", p.title(), c->r));
    p.finish();
    if (p.is_wrong()) throw AlreadyReported();
    Element e = make_object("bsdf", "blendbsdf", m.place());
    add_texture(e, "weight", amount, coordinates, true, p.place("amount"));
    needs_coordinates = !amount.constant();
    for (const std::string& name : names) {
        const MadeMaterial part = make(find(name, p.place("materials")), coordinates);
        if (part.is_interface)
            throw InputError(p.place("materials"),
                             fmt::format("'{}' in {} is an interface, which cannot be mixed", printable(name), p.title()));
        needs_coordinates = needs_coordinates || part.needs_coordinates;
        add_reference(e, part.id, p.place("materials"));
    }
    return e;
}

MadeMaterial Materials::masked(const MadeMaterial& inner, const TextureValue& opacity, Coordinates coordinates,
                               const Location& place) {
    const std::string id = unused_id(inner.id + "-mask");
    Element e = make_object("bsdf", "mask", place, id);
    add_texture(e, "opacity", opacity, coordinates, true, place);
    add_reference(e, inner.id, place);
    MadeMaterial result = inner;
    result.id = id;
    result.needs_coordinates = inner.needs_coordinates || !opacity.constant();
    elements_.push_back(std::move(e));
    return result;
}

std::string Materials::unused_id(const std::string& wanted) {
    std::string id = wanted;
    const auto is_taken = [&] { return ids_.contains(id) || (id != wanted && by_name_.contains(id)); };
    for (int i = 2; is_taken(); ++i) id = fmt::format("{}-{}", wanted, i);
    ids_.insert(id);
    return id;
}

}  // namespace neumann::reader::pbrt
