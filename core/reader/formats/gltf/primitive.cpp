#include "core/reader/formats/gltf/primitive.h"

#include "core/reader/formats/gltf/extensions.h"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

namespace neumann::reader::gltf {

namespace {

using Corners = std::array<std::uint32_t, 3>;
using SharedNumbers = std::shared_ptr<const Numbers>;

enum Mode { triangles = 4, strip = 5, fan = 6 };

// The corners are counter-clockwise, as the specification orders them.
std::vector<Corners> triangles_of(const std::vector<std::uint32_t>& v, std::int64_t mode) {
    std::vector<Corners> result;
    if (mode == triangles) {
        for (std::size_t i = 0; i + 2 < v.size(); i += 3) result.push_back({v[i], v[i + 1], v[i + 2]});
        return result;
    }
    for (std::size_t i = 0; i + 2 < v.size(); ++i)
        if (mode == fan)
            result.push_back({v[i + 1], v[i + 2], v[0]});
        else
            result.push_back({v[i], v[i + 1 + i % 2], v[i + 2 - i % 2]});
    return result;
}

// The attributes of the vertices; null if missing.
struct Vertices {
    SharedNumbers positions, normals = {}, coordinates = {}, colors = {};
};

Vec3 vector_at(const Numbers& n, std::size_t i) { return {n[i][0], n[i][1], n[i][2]}; }

// The mesh of these triangles, with the vertices that they use, in their order.
MeshFile mesh_of(const std::vector<Corners>& corners, const Vertices& vertices, const Rgb& factor) {
    MeshFile file;
    std::uint32_t least = std::numeric_limits<std::uint32_t>::max(), most = 0;
    for (const Corners& t : corners)
        for (const std::uint32_t v : t) least = std::min(least, v), most = std::max(most, v);
    constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> place(most - least + std::size_t{1}, unused);
    for (const Corners& t : corners)
        for (const std::uint32_t v : t) place[v - least] = 0;
    std::uint32_t count = 0;
    for (std::uint32_t& p : place)
        if (p != unused) p = count++;

    const auto for_each_used = [&](const SharedNumbers& numbers, const auto& take) {
        if (!numbers) return;
        for (std::size_t i = 0; i < place.size(); ++i)
            if (place[i] != unused) take(i + least);
    };
    TriangleMesh& mesh = file.mesh;
    mesh.vertices.reserve(count);
    for_each_used(vertices.positions, [&](std::size_t i) { mesh.vertices.push_back(vector_at(*vertices.positions, i)); });
    for_each_used(vertices.normals, [&](std::size_t i) { file.normals.push_back(vector_at(*vertices.normals, i)); });
    for_each_used(vertices.coordinates,
                  [&](std::size_t i) { mesh.uv.emplace_back((*vertices.coordinates)[i][0], (*vertices.coordinates)[i][1]); });
    if (vertices.colors) mesh.attributes.push_back({"vertex_color"});
    for_each_used(vertices.colors, [&](std::size_t i) {
        const Rgb c = vector_at(*vertices.colors, i) * factor;
        mesh.attributes.front().values.push_back({static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)});
    });
    mesh.triangles.reserve(corners.size());
    for (const Corners& t : corners) mesh.triangles.push_back({place[t[0] - least], place[t[1] - least], place[t[2] - least]});
    return file;
}

// Whether a picture on the triangle is seen mirrored; v grows downwards.
bool is_mirrored(const Corners& t, const Numbers& uv) {
    const auto at = [&](std::uint32_t i) { return Vec2(uv[i][0], uv[i][1]); };
    const Vec2 a = at(t[1]) - at(t[0]), b = at(t[2]) - at(t[0]);
    return a.x * b.y - a.y * b.x > 0.0;
}

class PrimitiveReader {
public:
    PrimitiveReader(JsonObject primitive, Accessors& accessors, const Material& material)
        : primitive_(primitive), accessors_(accessors), material_(material) {}

    std::vector<PrimitiveMesh> read() {
        const std::int64_t mode = primitive_.integer("mode", 0, 6).value_or(triangles);
        primitive_.ignore({"material", "targets"});
        auto attributes = primitive_.object("attributes");
        if (!attributes) primitive_.fail_missing("attributes", "an object");
        const auto position = attributes->index("POSITION", accessors_.list(), "accessor");
        if (mode < triangles || !attributes->has("POSITION")) {
            warn(mode < triangles ? "points and lines left out: they have no surface" : "a primitive without POSITION left out");
            return {};
        }
        if (!position) attributes->fail_missing("POSITION", "the index of an accessor");
        if (const std::string draco = "KHR_draco_mesh_compression";
            primitive_.extension(draco) && !accessors_.has_numbers(*position))
            fail_compressed(draco, primitive_.place(), primitive_.notes());
        const Vertices vertices = read_vertices(*attributes, *position);
        const std::vector<Corners> corners = triangles_of(read_corners(mode, vertices.positions->count()), mode);
        primitive_.finish();
        return split(corners, vertices);
    }

private:
    void warn(const std::string& what) { primitive_.notes().warnings.add(what); }

    std::vector<std::uint32_t> read_corners(std::int64_t mode, std::size_t count) {
        const auto index = primitive_.index("indices", accessors_.list(), "accessor");
        if (!index && primitive_.has("indices")) throw AlreadyReported();
        std::vector<std::uint32_t> corners;
        if (index) {
            corners = accessors_.indices(*index);
            for (std::size_t i = 0; i < corners.size(); ++i)
                if (corners[i] >= count)
                    throw InputError(accessors_.list().place_of(*index),
                                     fmt::format("index {} is {}, expected less than the {} vertices", i, corners[i], count));
        } else {
            corners.resize(count);
            for (std::size_t i = 0; i < count; ++i) corners[i] = static_cast<std::uint32_t>(i);
        }
        if (corners.size() < 3 || (mode == triangles && corners.size() % 3 != 0))
            throw InputError(primitive_.place(), fmt::format("{} corners of triangles, expected {}", corners.size(),
                                                             mode == triangles ? "a multiple of 3" : "at least 3"));
        return corners;
    }

    SharedNumbers find(JsonObject& attributes, const std::string& name, const std::vector<std::string>& types, std::size_t count) {
        const auto index = attributes.index(name, accessors_.list(), "accessor");
        if (!index) return nullptr;
        const auto found = primitive_.notes().problems.attempt(attributes.place_of(name), [&] {
            SharedNumbers numbers = accessors_.numbers(*index, types);
            if (numbers->count() != count)
                throw InputError(attributes.place_of(name), fmt::format("{} is given for {} vertices, expected the {} of POSITION",
                                                                        name, numbers->count(), count));
            return numbers;
        });
        return found.value_or(nullptr);
    }

    Vertices read_vertices(JsonObject& attributes, std::size_t position) {
        Vertices v{accessors_.numbers(position, {"VEC3"})};
        const std::size_t count = v.positions->count();
        v.normals = find(attributes, "NORMAL", {"VEC3"}, count);
        if (const std::optional<int> set = coordinate_set()) {
            const std::string name = fmt::format("TEXCOORD_{}", *set);
            v.coordinates = find(attributes, name, {"VEC2"}, count);
            if (!v.coordinates && !attributes.has(name)) {
                warn(fmt::format("a mesh without the {} that its material asks for: its textures show their corner alone", name));
                v.coordinates = std::make_shared<Numbers>(Numbers{2, std::vector<float>(2 * count)});
            }
        }
        v.colors = read_colors(attributes, count);
        for (const std::string& name : attributes.names())
            for (const char* beginning : {"_", "TEXCOORD_", "COLOR_", "JOINTS_", "WEIGHTS_"})
                if (name.starts_with(beginning)) attributes.ignore({name});
        attributes.ignore({"TANGENT"});  // tangents follow from the texture coordinates
        attributes.finish();
        return v;
    }

    // Reads vertex colours, if they have an effect and the material can show them.
    SharedNumbers read_colors(JsonObject& attributes, std::size_t count) {
        SharedNumbers colors = find(attributes, "COLOR_0", {"VEC3", "VEC4"}, count);
        if (!colors) return nullptr;
        bool are_white = true, are_opaque = true;
        for (std::size_t i = 0; i < count; ++i) {
            const float* c = (*colors)[i];
            are_white = are_white && c[0] == 1.0f && c[1] == 1.0f && c[2] == 1.0f;
            are_opaque = are_opaque && (colors->width < 4 || c[3] == 1.0f);
            if (std::min({c[0], c[1], c[2]}) < 0.0f)
                throw InputError(attributes.place_of("COLOR_0"), fmt::format("the colour of vertex {} is negative", i));
        }
        if (!are_opaque && material_.alpha_mode != Material::Alpha::opaque) warn("the alpha of vertex colours left out");
        if (are_white) return nullptr;
        if (!material_.base_texture) return colors;
        warn("vertex colours beside a baseColorTexture left out");
        return nullptr;
    }

    // The set of texture coordinates that the material uses.
    std::optional<int> coordinate_set() {
        std::optional<int> set;
        for (const Texture* t : material_.textures()) {
            if (!set) set = t->coordinates;
            if (*set != t->coordinates)
                primitive_.notes().problems.replace(
                    Unknown(t->place,
                            fmt::format("the texture is at TEXCOORD_{} and another of the material at TEXCOORD_{}", t->coordinates,
                                        *set),
                            ", expected one set of texture coordinates", fmt::format("taken at TEXCOORD_{}", *set)),
                    t->place);
        }
        return set;
    }

    std::vector<PrimitiveMesh> split(const std::vector<Corners>& corners, const Vertices& vertices) const {
        const bool has_colors = vertices.colors != nullptr;
        std::vector<Corners> groups[2];
        if (material_.normals && vertices.coordinates)
            for (const Corners& t : corners) groups[is_mirrored(t, *vertices.coordinates)].push_back(t);
        else
            groups[0] = corners;
        std::vector<PrimitiveMesh> result;
        for (const bool mirrored : {false, true})
            if (!groups[mirrored].empty())
                result.push_back({mesh_of(groups[mirrored], vertices, material_.base), {has_colors, mirrored}});
        return result;
    }

    JsonObject primitive_;
    Accessors& accessors_;
    const Material& material_;
};

}  // namespace

std::vector<PrimitiveMesh> read_primitive(JsonObject primitive, Accessors& accessors, const Material& material) {
    return PrimitiveReader(primitive, accessors, material).read();
}

}  // namespace neumann::reader::gltf
