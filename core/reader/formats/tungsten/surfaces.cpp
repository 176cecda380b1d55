// Makes the primitives that are surfaces.
#include "core/base/frame.h"
#include "core/geometry/affine.h"
#include "core/reader/formats/make_elements.h"
#include "core/reader/formats/tungsten/cube.h"
#include "core/reader/formats/tungsten/emission.h"
#include "core/reader/formats/tungsten/primitives.h"
#include "core/reader/formats/tungsten/transforms.h"

#include <algorithm>
#include <numbers>

#include <fmt/format.h>

namespace neumann::reader::tungsten {

namespace {

constexpr double pi = std::numbers::pi;

// Throws InputError if a length is 0.
void expect_extent(std::initializer_list<double> lengths, const JsonObject& primitive) {
    if (std::min(lengths) > 0.0) return;
    throw InputError(primitive.place_of("transform"), "the scale of transform is 0, expected another");
}

Element make_shape(const std::string& type, const JsonObject& primitive, const Mat4& to_world) {
    Element shape = make_object("shape", type, primitive.place());
    add_matrix(shape, "to_world", to_world, primitive.place_of("transform"));
    return shape;
}

// The map of a unit circle around z to a circle with this normal, of length 1, center and radius.
Mat4 facing(const Vec3& normal, const Vec3& center, double radius) {
    const Frame frame(normal);
    return {glm::dvec4(frame.s * radius, 0.0), glm::dvec4(frame.t * radius, 0.0), glm::dvec4(frame.n, 0.0),
            glm::dvec4(center, 1.0)};
}

}  // namespace

// A quad extends from −0.5 to 0.5 in x and z. Its front is where z × x points, also in a mirror.
Element Primitives::make_quad(JsonObject& primitive, const Mat4& m) {
    const Vec3 x(m[0]), z(m[2]);
    expect_extent({length_of(x), length_of(z)}, primitive);
    const Vec3 across = glm::cross(z / length_of(z), x / length_of(x));
    const Mat4 to_world(glm::dvec4(0.5 * x, 0.0), glm::dvec4(0.5 * z, 0.0), glm::dvec4(across / length_of(across), 0.0), m[3]);
    Element shape = make_shape("rectangle", primitive, to_world);
    bsdfs_.add_of(shape, primitive);
    add_emission(shape, primitive, length_of(x) * length_of(z));
    return shape;
}

Element Primitives::make_cube(JsonObject& primitive, const Mat4& m) {
    const Vec3 s = scale_of(m);
    expect_extent({s.x, s.y, s.z}, primitive);
    if (!cube_) cube_ = meshes_.keep(tungsten::make_cube(), "cube");
    Element shape = make_shape("ply", primitive, m);
    add_string(shape, "filename", cube_->filename, primitive.place());
    add_boolean(shape, "face_normals", true, primitive.place());
    if (is_mirroring(m)) add_boolean(shape, "flip_normals", true, primitive.place());
    bsdfs_.add_of(shape, primitive);
    add_emission(shape, primitive, 2.0 * (s.x * s.y + s.y * s.z + s.z * s.x));
    return shape;
}

// The texture coordinates of a sphere begin at −x.
Element Primitives::make_sphere(JsonObject& primitive, const Mat4& m) {
    const double radius = max_component(scale_of(m));
    expect_extent({radius}, primitive);
    const Mat4 r = rotation_of(m);
    for (int i = 0; i < 3; ++i) expect_extent({length_of(Vec3(r[i]))}, primitive);
    Element shape = make_shape("sphere", primitive, Mat4(-r[0] * radius, -r[1] * radius, r[2] * radius, m[3]));
    bsdfs_.add_of(shape, primitive);
    add_emission(shape, primitive, 4.0 * pi * radius * radius);
    return shape;
}

void Primitives::finish_round(Element& shape, JsonObject& primitive, double area) {
    if (bsdfs_.add_of(shape, primitive))
        importing_.refuse(primitive.place_of("bsdf"), "textures on disks and cylinders are not supported", ", expected constants",
                          "they lie there otherwise");
    const std::size_t before = shape.children.size();
    add_emission(shape, primitive, area);
    if (shape.children.size() > before)
        for (const Element& child : shape.children.back().children)
            if (child.tag == "texture")
                importing_.refuse(child.place, "textures on disks and cylinders are not supported", ", expected constants",
                                  "they lie there otherwise");
}

// A disk lies in x and z, with its front at +y.
Element Primitives::make_disk(JsonObject& primitive, const Mat4& m) {
    const Vec3 scale = scale_of(m);
    const double radius = std::max(scale.x, scale.z);
    expect_extent({radius, scale.y}, primitive);
    Element shape = make_shape("disk", primitive, facing(Vec3(m[1]) / scale.y, Vec3(m[3]), radius));
    finish_round(shape, primitive, pi * radius * radius);
    constexpr double whole = 90.0;
    const bool emits = shape.children.back().tag == "emitter";
    if (primitive.number("cone_angle", whole) < whole && emits)
        importing_.refuse(primitive.place_of("cone_angle"), "cone_angle is not supported", ", expected 90", "taken as 90");
    return shape;
}

// A cylinder stands around y, from −0.5 to 0.5, with diameter 1.
Primitives::Shapes Primitives::make_cylinder(JsonObject& primitive, const Mat4& m) {
    const Vec3 scale = scale_of(m);
    const double radius = 0.5 * std::max(scale.x, scale.z), height = scale.y;
    expect_extent({radius, height}, primitive);
    const Vec3 axis = Vec3(m[1]) / height, center(m[3]);
    const double area = 2.0 * pi * radius * (radius + height);  // with its ends, which Tungsten counts in any case
    Shapes shapes;
    Element& side = shapes.emplace_back(make_object("shape", "cylinder", primitive.place()));
    reader::add_point(side, "p0", center - axis * (0.5 * height), primitive.place_of("transform"));
    reader::add_point(side, "p1", center + axis * (0.5 * height), primitive.place_of("transform"));
    add_float(side, "radius", radius, primitive.place_of("transform"));
    finish_round(side, primitive, area);
    if (!primitive.boolean("capped", true)) return shapes;
    for (const double end : {-1.0, 1.0}) {
        const Mat4 to_world = facing(axis * end, center + axis * (0.5 * end * height), radius);
        Element& cap = shapes.emplace_back(make_shape("disk", primitive, to_world));
        finish_round(cap, primitive, area);
    }
    return shapes;
}

Primitives::Shapes Primitives::make_mesh(JsonObject& primitive, const Mat4& m) {
    const Vec3 scale = scale_of(m);
    expect_extent({scale.x, scale.y, scale.z}, primitive);
    MeshLook look;
    look.is_smooth = primitive.boolean("smooth", false);
    look.recomputes = primitive.boolean("recompute_normals", false);
    look.emits = primitive.has("emission") || primitive.has("power");
    primitive.ignore({"backface_culling"});  // Tungsten reads it without any effect
    const nlohmann::json* bsdf = primitive.value("bsdf");
    const bool has_several = bsdf && bsdf->is_array();
    if (has_several) look.materials = bsdf->size();
    if (look.materials == 0) throw InputError(primitive.place_of("bsdf"), "bsdf is empty, expected at least one");
    const std::optional<std::string> path = find_named_file(primitive, "file", importing_);
    if (!path && primitive.has("file")) throw AlreadyReported();
    if (!path) primitive.fail_missing("file", "the name of a mesh");
    const std::vector<MeshPart>& parts = meshes_.read(*path, primitive.place_of("file"), look);
    double area = 0.0;
    if (primitive.has("power"))
        for (const MeshPart& part : parts) area += area_of(part.file->mesh, m);
    Shapes shapes;
    for (const MeshPart& part : parts) {
        Element shape = make_shape("ply", primitive, m);
        add_string(shape, "filename", part.filename, primitive.place_of("file"));
        if (!look.is_smooth) add_boolean(shape, "face_normals", true, primitive.place());
        if (has_several)
            bsdfs_.add_of(shape, (*bsdf)[part.material], below(primitive.place_of("bsdf"), part.material));
        else
            bsdfs_.add_of(shape, primitive);
        add_emission(shape, primitive, area);
        shapes.push_back(std::move(shape));
    }
    return shapes;
}

}  // namespace neumann::reader::tungsten
