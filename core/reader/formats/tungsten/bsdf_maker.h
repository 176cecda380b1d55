// Makes the <bsdf> of one material.
#pragma once

#include "core/reader/formats/tungsten/bsdfs.h"

namespace neumann::reader::tungsten {

class BsdfMaker {
public:
    // `sided`: what reflects is the same from both sides, which Tungsten assumes unless light is let through.
    BsdfMaker(JsonObject object, Bsdfs& all, Textures& textures, Importing& importing, bool sided)
        : o_(std::move(object)), all_(all), textures_(textures), importing_(importing), sided_(sided) {}

    // Throws InputError.
    Element make();

private:
    Element make_type(const std::string& type);
    Element make_lambert();
    Element make_oren_nayar();
    Element make_phong();
    Element make_mirror();
    Element make_conductor(bool is_rough);
    Element make_dielectric(bool is_rough);
    Element make_plastic(bool is_rough);
    Element make_thin_sheet();
    Element make_diffuse_transmission();
    Element make_mixed();
    Element make_transparency();
    Element make_coat(bool is_rough);

    TextureValue albedo() { return textures_.find_color(o_, "albedo").value_or(TextureValue{o_.place(), Rgb(1.0)}); }
    double index_of_refraction(double missing);
    void add_indices(Element& e, double missing);
    void add_roughness(Element& e, double missing);
    void add_metal(Element& e);
    // Refuses a layer that absorbs.
    void refuse_absorption();
    void check_bump();
    Element bsdf(const std::string& type) const;
    Element two_sided(Element inner) const;
    // Makes the bsdf the same from both sides, if `sided`.
    Element sided(Element inner) const { return sided_ ? two_sided(std::move(inner)) : inner; }

    JsonObject o_;
    Bsdfs& all_;
    Textures& textures_;
    Importing& importing_;
    bool sided_;
};

}  // namespace neumann::reader::tungsten
