// Makes the <bsdf> of one material.
#pragma once

#include "core/reader/formats/make_elements.h"
#include "core/reader/formats/pbrt/importer.h"
#include "core/reader/formats/pbrt/textures.h"

#include <string>
#include <vector>

namespace neumann::reader::pbrt {

class BsdfMaker {
public:
    BsdfMaker(MaterialEntity& material, Textures& textures, Importer& importer, Coordinates coordinates)
        : p_(material.parameters), type_(material.type), textures_(textures), importer_(importer), coordinates_(coordinates) {}

    // Throws InputError for a type that is not known, and AlreadyReported if parameters are wrong.
    Element make();
    // Whether textures, or the direction in which the surface is brushed, need coordinates.
    bool needs_coordinates() const { return needs_coordinates_; }

    static const std::vector<std::string>& types();

private:
    struct Alphas {
        TextureValue u{Rgb(0.0)}, v{Rgb(0.0)};
        bool is_smooth = true, is_isotropic = true;
    };
    // A metal by η and k, which may have a name that Mitsuba knows as well, or by a colour that varies.
    struct Metal {
        Rgb eta{1.0}, k{0.0};
        std::optional<std::string> name = {};
        std::optional<TextureValue> colour = {};
    };

    Element make_type();
    Element make_diffuse();
    Element make_conductor();
    Element make_dielectric();
    Element make_thin_dielectric();
    Element make_diffuse_transmission();
    Element make_coated_diffuse();
    Element make_coated_conductor();

    TextureValue reflectance(const std::string& name, double missing);
    double index(const std::string& name, double missing);
    Alphas read_alphas(const std::string& prefix);
    void add_alphas(Element& e, const Alphas& alphas);
    void add(Element& e, const std::string& name, const TextureValue& t, bool is_number = false);
    Metal read_metal(const std::string& prefix);
    void check_layers();

    Element bsdf(const std::string& type) const { return make_object("bsdf", type, p_.place()); }
    // Makes the bsdf reflect the same from both sides, as pbrt's does.
    Element two_sided(Element inner) const;
    // Puts `normalmap` or `bumpmap` around the bsdf, if the material has one.
    Element with_normals(Element inner);

    Parameters& p_;
    const std::string& type_;
    Textures& textures_;
    Importer& importer_;
    Coordinates coordinates_;
    bool needs_coordinates_ = false;
};

}  // namespace neumann::reader::pbrt
