#include "core/reader/formats/gltf/nodes.h"

#include "core/reader/xml/transform.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace neumann::reader::gltf {

namespace {

Mat4 matrix_of(const std::vector<double>& m) {
    Mat4 result;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) result[column][row] = m[static_cast<std::size_t>(4 * column + row)];
    return result;
}

bool is_finite(const Mat4& m) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(m[column][row])) return false;
    return true;
}

double largest_of(const glm::dmat3& m) {
    return max_component({max_component(glm::abs(m[0])), max_component(glm::abs(m[1])), max_component(glm::abs(m[2]))});
}

// The quaternion at length 1, or nothing if its length is far from that.
std::optional<glm::dquat> unit_quaternion(const glm::dquat& q) {
    const double length = glm::length(q);
    return std::abs(length - 1.0) < 0.1 ? std::optional(q / length) : std::nullopt;
}

Vec3 vector_of(const float* v) { return {v[0], v[1], v[2]}; }

Mat4 local_transform(JsonObject& node) {
    constexpr double zero = 0.0, one = 1.0;
    if (node.has("matrix")) {
        for (const char* name : {"translation", "rotation", "scale"})
            if (node.has(name)) node.complain(name, fmt::format("both matrix and {} are given, expected one of them", name));
        const Mat4 m = matrix_of(node.numbers("matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}));
        if (m[0][3] == zero && m[1][3] == zero && m[2][3] == zero && m[3][3] == one) return m;
        node.complain("matrix", "the last row of matrix, every fourth of its numbers, is not 0 0 0 1");
        return Mat4(1.0);
    }
    const auto t = node.numbers("translation", {0, 0, 0}), r = node.numbers("rotation", {0, 0, 0, 1}),
               s = node.numbers("scale", {1, 1, 1});
    const glm::dquat q(r[3], r[0], r[1], r[2]);
    const std::optional<glm::dquat> unit = unit_quaternion(q);
    if (!unit) node.complain("rotation", fmt::format("rotation is of length {}, expected 1", glm::length(q)));
    return glm::scale(glm::translate(Mat4(1.0), {t[0], t[1], t[2]}) * glm::mat4_cast(unit.value_or(glm::dquat(1.0, 0.0, 0.0, 0.0))),
                      Vec3(s[0], s[1], s[2]));
}

// Reads EXT_mesh_gpu_instancing: maps in the space of the node.
std::vector<Mat4> read_instances(JsonObject& instancing, Accessors& accessors) {
    auto attributes = instancing.object("attributes");
    instancing.finish();
    if (!attributes) instancing.fail_missing("attributes", "an object with TRANSLATION, ROTATION or SCALE");
    const auto read = [&](const char* name, const char* type) -> std::shared_ptr<const Numbers> {
        const auto accessor = attributes->index(name, accessors.list(), "accessor");
        return accessor ? accessors.numbers(*accessor, {type}) : nullptr;
    };
    const auto translations = read("TRANSLATION", "VEC3"), rotations = read("ROTATION", "VEC4"), scales = read("SCALE", "VEC3");
    for (const std::string& name : attributes->names())
        if (name.starts_with('_')) attributes->value(name);  // an application's own attribute
    attributes->finish();
    std::optional<std::size_t> count;
    for (const auto& numbers : {translations, rotations, scales}) {
        if (!numbers) continue;
        if (count && *count != numbers->count())
            throw InputError(attributes->place(), fmt::format("one attribute of the instances has {} elements and another {}",
                                                              *count, numbers->count()));
        count = numbers->count();
    }
    if (!count) throw InputError(attributes->place(), "instances without TRANSLATION, ROTATION and SCALE, expected one of them");
    std::vector<Mat4> result;
    for (std::size_t i = 0; i < *count; ++i) {
        Mat4 m(1.0);
        if (translations) m = glm::translate(m, vector_of((*translations)[i]));
        if (rotations) {
            const float* r = (*rotations)[i];
            const std::optional<glm::dquat> q = unit_quaternion({r[3], r[0], r[1], r[2]});
            if (!q) throw InputError(attributes->place_of("ROTATION"), fmt::format("element {} is not of length 1", i));
            m = m * glm::mat4_cast(*q);
        }
        if (scales) m = glm::scale(m, vector_of((*scales)[i]));
        result.push_back(m);
    }
    return result;
}

class NodeReader {
public:
    NodeReader(JsonObject& root, const JsonList& lights, Accessors& accessors)
        : root_(root),
          notes_(root.notes()),
          nodes_(root.list("nodes")),
          meshes_(root.list("meshes")),
          cameras_(root.list("cameras")),
          skins_(root.list("skins")),
          lights_(lights),
          accessors_(accessors) {}

    Nodes read() {
        std::vector<Pending> pending = roots();
        while (!pending.empty()) {
            const Pending next = pending.back();
            pending.pop_back();
            notes_.problems.attempt(nodes_.place_of(next.node), [&] { visit(next, pending); });
        }
        for (const auto& s : skinned_) notes_.problems.attempt(s.first.place, [&] { place_skinned(s.first, s.second); });
        return std::move(result_);
    }

private:
    struct Pending {
        std::size_t node;
        Mat4 above;
    };

    // The roots of the scene, in reverse, because the last one is visited first.
    std::vector<Pending> roots() {
        const JsonList scenes = root_.list("scenes");
        std::size_t number = 0;
        if (const auto chosen = root_.index("scene", scenes, "scene"))
            number = *chosen;
        else if (root_.has("scene"))
            throw AlreadyReported();
        if (scenes.size() == 0) {
            if (scenes.broken()) throw AlreadyReported();
            throw InputError(root_.place(), "the file has no scenes, expected one");
        }
        JsonObject scene = scenes.object(number);
        const std::vector<std::size_t> indices = scene.indices("nodes", nodes_, "node");
        scene.ignore({"name"});
        scene.finish();
        std::vector<Pending> result;
        for (auto i = indices.rbegin(); i != indices.rend(); ++i) result.push_back({*i, Mat4(1.0)});
        return result;
    }

    void visit(const Pending& pending, std::vector<Pending>& others) {
        JsonObject node = nodes_.object(pending.node);
        if (!world_.try_emplace(pending.node, Mat4(1.0)).second)
            throw InputError(node.place(), "the node stands in the tree twice, or inside itself");
        const Mat4 world = world_[pending.node] = pending.above * local_transform(node);
        if (!is_finite(world)) throw InputError(node.place(), "the node is beyond the range of numbers");
        const std::vector<std::size_t> children = node.indices("children", nodes_, "node");
        for (auto i = children.rbegin(); i != children.rend(); ++i) others.push_back({*i, world});
        take(node, world);
        node.finish();
    }

    void take(JsonObject& node, const Mat4& world) {
        const Placed placed{0, node.place(), node.text("name").value_or(""), world};
        const auto put = [&](std::vector<Placed>& list, std::size_t what) { list.emplace_back(placed).what = what; };
        const auto mesh = node.index("mesh", meshes_, "mesh"), skin = node.index("skin", skins_, "skin"),
                   camera = node.index("camera", cameras_, "camera");
        if (node.has("weights")) refuse_morphs(node.list("weights"), notes_.problems);
        auto instancing = node.extension("EXT_mesh_gpu_instancing");
        if (mesh && skin)
            skinned_.push_back({{*mesh, node.place(), placed.name, Mat4(1.0)}, *skin});
        else if (mesh && instancing)
            for (const Mat4& own : read_instances(*instancing, accessors_))
                put_mesh({*mesh, instancing->place(), placed.name, world * own});
        else if (mesh)
            put_mesh({*mesh, node.place(), placed.name, world});
        if (camera) put(result_.cameras, *camera);
        if (auto extension = node.extension("KHR_lights_punctual")) {
            if (const auto light = extension->index("light", lights_, "light")) put(result_.lights, *light);
            extension->finish();
        }
    }

    void put_mesh(const Placed& placed) {
        if (!is_finite(placed.to_world)) throw InputError(placed.place, "an instance is beyond the range of numbers");
        result_.meshes.push_back(placed);
    }

    // Places a mesh that is bound to joints. All joints must have moved it alike, as in the pose in which it was bound.
    void place_skinned(Placed placed, std::size_t skin_index) {
        JsonObject skin = skins_.object(skin_index);
        const std::vector<std::size_t> joints = skin.indices("joints", nodes_, "node");
        const auto bound = skin.index("inverseBindMatrices", accessors_.list(), "accessor");
        std::shared_ptr<const Numbers> inverse;
        if (bound) inverse = accessors_.numbers(*bound, {"MAT4"});
        if (inverse && inverse->count() < joints.size())
            throw InputError(skin.place_of("inverseBindMatrices"),
                             fmt::format("{} matrices, expected one for each of the {} joints", inverse->count(), joints.size()));
        bool is_bent = false;
        for (std::size_t i = 0; i < joints.size(); ++i) {
            const auto world = world_.find(joints[i]);
            if (world == world_.end()) throw InputError(skin.place(), fmt::format("joint {} is not in the scene", joints[i]));
            const Mat4 moved = inverse ? world->second * matrix_of({(*inverse)[i], (*inverse)[i] + 16}) : world->second;
            if (!is_finite(moved) || moved[0][3] != 0.0 || moved[1][3] != 0.0 || moved[2][3] != 0.0 || moved[3][3] != 1.0)
                throw InputError(skin.place_of("inverseBindMatrices"),
                                 fmt::format("the last row of matrix {} is not 0 0 0 1, or its numbers are too large", i));
            if (i == 0) placed.to_world = moved;
            for (int column = 0; column < 4; ++column)
                if (!(glm::length(moved[column] - placed.to_world[column]) <= 1e-4 * (1.0 + glm::length(moved[column]))))
                    is_bent = true;
        }
        if (is_bent)
            notes_.problems.replace(Unknown(placed.place, "the mesh is bent by its skin, which is not supported",
                                            "; apply the armature before the export", "taken unbent, as its first joint moves it"),
                                    placed.place);
        put_mesh(placed);
    }

    JsonObject& root_;
    Notes& notes_;
    JsonList nodes_, meshes_, cameras_, skins_;
    const JsonList& lights_;
    Accessors& accessors_;
    std::map<std::size_t, Mat4> world_;  // of the nodes visited so far
    std::vector<std::pair<Placed, std::size_t>> skinned_;
    Nodes result_;
};

}  // namespace

Nodes read_nodes(JsonObject& root, const JsonList& lights, Accessors& accessors) {
    return NodeReader(root, lights, accessors).read();
}

void refuse_morphs(const JsonList& weights, Problems& problems) {
    for (std::size_t i = 0; i < weights.size(); ++i)
        if (!(weights[i].is_number() && weights[i] == 0.0))
            return problems.replace(Unknown(weights.place_of(i), "morph targets are not supported",
                                            ", expected all weights to be 0; apply them before the export", "left out"),
                                    weights.place_of(i));
}

Mat4 without_scale(const Placed& placed) {
    Mat4 m = placed.to_world;
    if (!is_invertible(m)) throw InputError(placed.place, "the node has no direction: its scale is 0");
    // Cameras and lights look along the third axis, which keeps its direction.
    const Vec3 z = glm::normalize(Vec3(m[2]) / largest_of(glm::dmat3(m)));
    const Vec3 x = glm::normalize(glm::cross(Vec3(m[1]) / largest_of(glm::dmat3(m)), z));
    m[0] = glm::dvec4(x, 0.0);
    m[1] = glm::dvec4(glm::cross(z, x), 0.0);
    m[2] = glm::dvec4(z, 0.0);
    return m;
}

}  // namespace neumann::reader::gltf
