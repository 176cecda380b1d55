#include "tests/search/scene_elements.h"

#include <algorithm>

namespace neumann::search {

namespace {

void add_rotation(Node transform, RandomNumbers& random) {
    Node rotate = add(transform, "rotate");
    rotate.append_attribute("value") = random.triple(-1.0, 1.0).c_str();
    rotate.append_attribute("angle") = random.between(0.0, 360.0);
}

// `round`: what stays a sphere or a cylinder.
void add_place(Node shape, bool round, double largest, double farthest, RandomNumbers& random) {
    Node transform = add_transform(shape);
    if (!round && random.chance(0.3))
        add_operation(transform, "scale", random.triple(0.2 * largest, largest));
    else
        add_operation(transform, "scale", fmt::format("{}", random.between(0.2 * largest, largest)));
    if (!round && random.chance(0.1)) add_operation(transform, "scale", "-1, 1, 1");
    if (random.chance(0.7)) add_rotation(transform, random);
    if (random.chance(0.8)) add_operation(transform, "translate", random.triple(-farthest, farthest));
}

// A grid of 3×3 vertices whose heights are random; with smooth normals unless the shape has face_normals.
std::string wavy_sheet(RandomNumbers& random) {
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 9\nproperty float x\nproperty float y\nproperty float z\nproperty float u\nproperty "
        "float "
        "v\nelement face 8\nproperty list uchar int vertex_indices\nend_header\n";
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
            text += fmt::format("{} {} {} {} {}\n", x, y, random.between(-0.5, 0.5), 0.5 + 0.5 * x, 0.5 + 0.5 * y);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 2; ++x) {
            const int corner = 3 * y + x;
            text += fmt::format("3 {} {} {}\n3 {} {} {}\n", corner, corner + 1, corner + 4, corner, corner + 4, corner + 3);
        }
    return text;
}

std::string octahedron(RandomNumbers& random) {
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\nelement face 8\nproperty "
        "list "
        "uchar int vertex_indices\nend_header\n";
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {1.0, -1.0}) {
            double at[3] = {0.0, 0.0, 0.0};
            at[axis] = sign * random.between(0.4, 1.0);
            text += fmt::format("{} {} {}\n", at[0], at[1], at[2]);
        }
    return text + "3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n";
}

void add_mesh(Node shape, Making& making) {
    const std::string name = fmt::format("mesh{}.ply", making.files.size());
    making.files[name] = making.random.chance(0.5) ? wavy_sheet(making.random) : octahedron(making.random);
    add_value(shape, "string", "filename", name);
    if (making.random.chance(0.5)) add_value(shape, "boolean", "face_normals", "true");
}

Node add_shape(Node parent, double largest, double farthest, Making& making) {
    static const std::array<const char*, 10> types{"rectangle", "rectangle", "rectangle", "disk", "sphere",
                                                   "sphere",    "cylinder",  "cube",      "cube", "ply"};
    RandomNumbers& random = making.random;
    const std::string type = random.one_of(types);
    Node shape = add_object(parent, "shape", type);
    const bool round = type == "sphere" || type == "cylinder" || type == "disk";
    add_place(shape, round, largest, farthest, random);
    if (type == "ply") add_mesh(shape, making);
    if (random.chance(0.15)) add_value(shape, "boolean", "flip_normals", "true");
    add_material(shape, Sides::any, making);
    return shape;
}

void maybe_shine(Node shape, double probability, Making& making) {
    RandomNumbers& random = making.random;
    if (!random.chance(probability)) return;
    const std::string type = shape.attribute("type").value();
    const bool flat = type == "rectangle" || type == "disk";
    if (flat && random.chance(0.1)) {
        add_value(add_object(shape, "emitter", "directionalarea"), "rgb", "radiance", random.colour(0.3, 2.0));
        return;
    }
    add_colour(add_object(shape, "emitter", "area"), "radiance", 2.0, making);
}

void add_instances(Node scene, Making& making) {
    RandomNumbers& random = making.random;
    Node group = add_object(scene, "shape", "shapegroup");
    group.append_attribute("id") = "group";
    for (std::uint64_t i = random.below(2) + 1; i > 0; --i) add_shape(group, 0.5, 0.3, making);
    for (std::uint64_t i = random.below(3) + 1; i > 0; --i) {
        Node instance = add_object(scene, "shape", "instance");
        add_place(instance, true, 1.2, 0.8, random);
        add(instance, "ref").append_attribute("id") = "group";
    }
}

}  // namespace

std::vector<Node> add_shapes(Node scene, bool room, Making& making) {
    RandomNumbers& random = making.random;
    std::vector<Node> meters;
    if (room) {
        Node walls = add_object(scene, "shape", random.chance(0.7) ? "cube" : "sphere");
        Node transform = add_transform(walls);
        add_operation(transform, "scale", fmt::format("{}", random.between(2.5, 4.0)));
        if (random.chance(0.3)) add_rotation(transform, random);
        add_value(walls, "boolean", "flip_normals", "true");
        add_material(walls, random.chance(0.9) ? Sides::reflecting : Sides::any, making);
        maybe_shine(walls, 0.15, making);
    }
    for (std::uint64_t i = random.below(random.chance(0.7) ? 4 : 8) + 1; i > 0; --i) {
        Node shape = add_shape(scene, random.chance(0.2) ? 3.0 : 1.0, room ? 1.5 : 1.0, making);
        maybe_shine(shape, 0.3, making);
        meters.push_back(shape);
    }
    if (random.chance(0.15)) add_instances(scene, making);
    return meters;
}

}  // namespace neumann::search
