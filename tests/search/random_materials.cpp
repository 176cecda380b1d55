#include "tests/search/scene_elements.h"

#include <algorithm>

namespace neumann::search {

namespace {

constexpr int deepest = 2;

void add_tiling(Node texture, Making& making) {
    if (making.random.chance(0.6))
        add_operation(add_transform(texture, "to_uv"), "scale", fmt::format("{}", making.random.between(0.5, 4.0)));
}

// A picture of 3×2 texels, as a portable float map.
std::string add_picture(double most, Making& making) {
    std::string bytes = "PF\n3 2\n-1.0\n";
    for (int i = 0; i < 18; ++i) {
        const auto value = static_cast<float>(making.random.between(0.0, most));
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    const std::string name = fmt::format("picture{}.pfm", making.files.size());
    making.files[name] = bytes;
    return name;
}

void add_texture(Node parent, const std::string& name, double most, bool coloured, Making& making) {
    RandomNumbers& random = making.random;
    // Pictures are rare, for the library that reads them takes longer to load than a scene to render.
    if (coloured && random.chance(0.15)) {
        Node bitmap = add_object(parent, "texture", "bitmap", name);
        add_value(bitmap, "string", "filename", add_picture(most, making));
        if (random.chance(0.5)) add_value(bitmap, "string", "filter_type", "nearest");
        add_tiling(bitmap, making);
        return;
    }
    Node squares = add_object(parent, "texture", "checkerboard", name);
    for (const char* square : {"color0", "color1"})
        if (coloured)
            add_value(squares, "rgb", square, random.colour(0.0, most));
        else
            add_number(squares, square, random.between(0.0, most));
    add_tiling(squares, making);
}

void add_roughness(Node bsdf, bool may_be_anisotropic, Making& making) {
    RandomNumbers& random = making.random;
    if (random.chance(0.5)) add_value(bsdf, "string", "distribution", "ggx");
    const auto alpha = [&] { return random.chance(0.15) ? random.between(0.03, 0.15) : random.between(0.15, 0.7); };
    if (may_be_anisotropic && random.chance(0.3)) {
        add_number(bsdf, "alpha_u", alpha());
        add_number(bsdf, "alpha_v", alpha());
    } else {
        add_number(bsdf, "alpha", alpha());
    }
}

void add_metal(Node bsdf, Making& making) {
    static const std::array<const char*, 5> metals{"Au", "Cu", "Al", "Cr", "none"};
    add_value(bsdf, "string", "material", making.random.one_of(metals));
    if (making.random.chance(0.5)) add_colour(bsdf, "specular_reflectance", 1.0, making);
}

void add_glass(Node bsdf, Making& making) {
    if (making.random.chance(0.5)) add_number(bsdf, "int_ior", making.random.between(1.05, 2.5));
    if (making.random.chance(0.2)) add_colour(bsdf, "specular_reflectance", 1.0, making);
    if (making.random.chance(0.3)) add_colour(bsdf, "specular_transmittance", 1.0, making);
}

void add_plastic(Node bsdf, Making& making) {
    add_colour(bsdf, "diffuse_reflectance", 0.9, making);
    if (making.random.chance(0.3)) add_number(bsdf, "int_ior", making.random.between(1.1, 2.2));
    if (making.random.chance(0.3)) add_value(bsdf, "boolean", "nonlinear", "true");
}

void add_disney(Node bsdf, bool thin, bool may_transmit, Making& making) {
    RandomNumbers& random = making.random;
    add_colour(bsdf, "base_color", 0.9, making);
    add_number(bsdf, "roughness", random.between(0.2, 0.9));
    static const std::array<const char*, 6> solid{"metallic", "clearcoat", "sheen", "spec_tint", "anisotropic", "flatness"};
    static const std::array<const char*, 4> sheet{"sheen", "spec_tint", "anisotropic", "flatness"};
    const std::string name = thin ? random.one_of(sheet) : random.one_of(solid);
    if (random.chance(0.7)) add_number(bsdf, name, random.between(0.0, 1.0));
    if (may_transmit) add_number(bsdf, "spec_trans", random.between(0.1, 1.0));
    if (thin) add_number(bsdf, "diff_trans", random.between(0.0, 2.0));
}

const char* choose_reflecting(int depth, RandomNumbers& random) {
    static const std::array<const char*, 13> plain{"diffuse",        "diffuse",        "diffuse",      "diffuse", "conductor",
                                                   "roughconductor", "plastic",        "roughplastic", "phong",   "ward",
                                                   "principled",     "retroreflector", "diffuse"};
    static const std::array<const char*, 4> around{"blendbsdf", "mixturebsdf", "coating", "normalmap"};
    return depth < deepest && random.chance(0.15) ? random.one_of(around) : random.one_of(plain);
}

const char* choose_transmitting(int depth, RandomNumbers& random) {
    static const std::array<const char*, 6> plain{"dielectric", "thindielectric", "roughdielectric",
                                                  "null",       "principled",     "principledthin"};
    return depth < deepest && random.chance(0.3) ? "mask" : random.one_of(plain);
}

}  // namespace

void add_colour(Node parent, const std::string& name, double most, Making& making) {
    if (making.random.chance(0.2))
        add_texture(parent, name, most, true, making);
    else
        add_value(parent, "rgb", name, making.random.colour(0.0, most));
}

void add_share(Node parent, const std::string& name, Making& making) {
    if (making.random.chance(0.3))
        add_texture(parent, name, 1.0, false, making);
    else
        add_number(parent, name, making.random.between(0.0, 1.0));
}

void add_material(Node parent, Sides sides, Making& making, int depth) {
    RandomNumbers& random = making.random;
    const bool transmits = sides == Sides::any && random.chance(0.3);
    if (sides == Sides::any && !transmits && depth == 0 && random.chance(0.5)) {
        Node both = add_object(parent, "bsdf", "twosided");
        add_material(both, Sides::reflecting, making, depth + 1);
        if (random.chance(0.2)) add_material(both, Sides::reflecting, making, depth + 1);
        return;
    }
    const std::string type = transmits ? choose_transmitting(depth, random) : choose_reflecting(depth, random);
    Node bsdf = add_object(parent, "bsdf", type);
    if (type == "diffuse" || type == "retroreflector") {
        add_colour(bsdf, "reflectance", 0.9, making);
        if (type == "retroreflector" && random.chance(0.6)) add_number(bsdf, "alpha", random.between(0.1, 0.6));
    } else if (type == "conductor" || type == "roughconductor") {
        add_metal(bsdf, making);
        if (type == "roughconductor") add_roughness(bsdf, true, making);
    } else if (type == "plastic" || type == "roughplastic") {
        add_plastic(bsdf, making);
        if (type == "roughplastic") add_roughness(bsdf, false, making);
    } else if (type == "phong" || type == "ward") {
        add_colour(bsdf, "diffuse_reflectance", 0.5, making);
        add_colour(bsdf, "specular_reflectance", 0.4, making);
        if (type == "phong") add_number(bsdf, "exponent", random.between(1.0, 40.0));
        if (type == "ward") add_number(bsdf, "alpha_u", random.between(0.15, 0.5));
        if (type == "ward") add_number(bsdf, "alpha_v", random.between(0.15, 0.5));
    } else if (type == "principled" || type == "principledthin") {
        add_disney(bsdf, type == "principledthin", transmits && random.chance(0.8), making);
    } else if (type == "dielectric" || type == "thindielectric" || type == "roughdielectric") {
        add_glass(bsdf, making);
        if (type == "roughdielectric") add_roughness(bsdf, true, making);
    } else if (type == "mask") {
        add_share(bsdf, "opacity", making);
        add_material(bsdf, Sides::any, making, depth + 1);
    } else if (type == "blendbsdf") {
        add_share(bsdf, "weight", making);
        for (int i = 0; i < 2; ++i) add_material(bsdf, sides, making, depth + 1);
    } else if (type == "mixturebsdf") {
        add_value(bsdf, "string", "weights", fmt::format("{}, {}", random.between(0.1, 0.5), random.between(0.1, 0.5)));
        for (int i = 0; i < 2; ++i) add_material(bsdf, sides, making, depth + 1);
    } else if (type == "coating") {
        add_number(bsdf, "int_ior", random.between(1.1, 2.0));
        if (random.chance(0.5)) add_value(bsdf, "rgb", "sigma_a", random.colour(0.0, 1.0));
        add_material(bsdf, Sides::reflecting, making, depth + 1);
    } else if (type == "normalmap") {
        Node texture = add_object(bsdf, "texture", "rawconstant", "normalmap");
        add_value(texture, "vector", "value",
                  fmt::format("{}, {}, {}", random.between(0.3, 0.7), random.between(0.3, 0.7), random.between(0.8, 1.0)));
        add_material(bsdf, sides, making, depth + 1);
    }
}

}  // namespace neumann::search
