// Makes materials as <bsdf> elements.
#pragma once

#include "core/reader/formats/pbrt/importer.h"
#include "core/reader/formats/pbrt/textures.h"
#include "core/reader/xml/element.h"

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace neumann::reader::pbrt {

// What a shape needs to know of its material.
struct MadeMaterial {
    std::string id;
    bool is_interface = false;       // without media on its sides there is no surface
    bool needs_coordinates = false;  // for textures or directions on the surface
};

class Materials {
public:
    Materials(PbrtScene& scene, Textures& textures, Importer& importer);

    // Makes also the materials that no shape has, so that their errors are reported.
    void make_all();
    // Makes a material again where the coordinates differ and matter. Throws InputError if there is none of this name.
    MadeMaterial use(const MaterialUse& use, Coordinates coordinates);
    // Makes a material of which only the share `opacity` is there.
    MadeMaterial masked(const MadeMaterial& inner, const TextureValue& opacity, Coordinates coordinates, const Location& place);

    // Returns all materials that have been made.
    std::vector<Element> take() { return std::move(elements_); }

private:
    MadeMaterial make(std::size_t number, Coordinates coordinates);
    std::size_t find(const std::string& name, const Location& place) const;
    Element make_element(MaterialEntity& m, Coordinates coordinates, bool& needs_coordinates);
    Element make_mix(MaterialEntity& m, Coordinates coordinates, bool& needs_coordinates);
    std::string unused_id(const std::string& wanted);

    PbrtScene& scene_;
    Textures& textures_;
    Importer& importer_;
    std::map<std::string, std::size_t> by_name_;
    std::map<std::pair<std::size_t, Coordinates>, MadeMaterial> made_;
    std::set<std::size_t> open_;  // materials being made, to detect mixtures of themselves
    std::set<std::string> ids_;
    std::vector<Element> elements_;
};

}  // namespace neumann::reader::pbrt
