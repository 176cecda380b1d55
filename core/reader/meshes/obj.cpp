#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/reader/meshes/mesh_file.h"
#include "core/reader/meshes/mesh_text.h"
#include "core/reader/meshes/polygons.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace neumann {
namespace {

using Triple = std::array<std::uint32_t, 3>;

// Stands for the index of a missing normal or missing texture coordinates.
constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
constexpr Triple all_none{none, none, none};

struct Corner {
    std::uint32_t vertex, coordinates, normal;
    bool operator==(const Corner&) const = default;
};
struct HashOfCorner {
    std::size_t operator()(const Corner& c) const {
        std::uint64_t hash = c.vertex;
        for (const std::uint32_t i : {c.coordinates, c.normal}) hash = (hash ^ hash >> 29) * 0x9e3779b97f4a7c15u + i;
        return static_cast<std::size_t>(hash ^ hash >> 32);
    }
};

// Resolves the references of faces to one kind of element.
class References {
public:
    References(MeshText& text, const char* noun) : text_(text), noun_(noun) {}

    // Converts an index of the file to one counted from 0; `count` elements have been read so far.
    std::uint32_t resolve(std::int64_t index, std::size_t count, const MeshText::LineColumn& place) {
        const auto signed_count = static_cast<std::int64_t>(count);
        if (index > signed_count) {
            // Elements that follow may make the index valid. Only indices larger than all before are kept: one of them
            // is the first invalid one.
            if (ahead_.empty() || index > ahead_.back().index) ahead_.push_back({index, place});
            return static_cast<std::uint32_t>(index - 1);
        }
        if (index > 0) return static_cast<std::uint32_t>(index - 1);
        if (index == 0) text_.fail(place, fmt::format("{} index 0, expected 1 for the first or -1 for the last", noun_));
        if (index < -signed_count)
            text_.fail(place, fmt::format("{} index {} {} so far", noun_, index, out_of_range(count, noun_)));
        return static_cast<std::uint32_t>(signed_count + index);
    }

    void check(std::size_t count) const {
        if (count > max_mesh_count) {
            throw InputError(fmt::format("{}: has more than {}", text_.file(), counted(max_mesh_count, noun_)));
        }
        for (const auto& [index, place] : ahead_) {
            if (index <= static_cast<std::int64_t>(count)) continue;
            text_.fail(place, fmt::format("{} index {} {}", noun_, index, out_of_range(count, noun_)));
        }
    }

private:
    struct Ahead {
        std::int64_t index;
        MeshText::LineColumn place;
    };
    MeshText& text_;
    const char* noun_;
    std::vector<Ahead> ahead_;
};

class ObjReader {
public:
    ObjReader(const std::string& path, std::string_view bytes) : text_(path, bytes, MeshText::Syntax::obj) {}

    MeshFile read() {
        while (!text_.at_end()) statement();
        vertex_references_.check(vertices_.size());
        coordinate_references_.check(coordinates_.size());
        normal_references_.check(normals_.size());
        if (triangles_.empty()) throw InputError(text_.file() + ": has no faces");
        if (triangles_.size() > max_mesh_count) {
            throw InputError(fmt::format("{}: has more than {}", text_.file(), counted(max_mesh_count, "triangle")));
        }
        if (!triangle_coordinates_.empty()) triangle_coordinates_.resize(triangles_.size(), all_none);
        if (!triangle_normals_.empty()) triangle_normals_.resize(triangles_.size(), all_none);
        cut_fans(fans_, triangles_, [&](std::uint32_t vertex) { return vertices_[vertex]; },
                 {&triangle_coordinates_, &triangle_normals_});
        if (triangle_normals_.empty() && triangle_coordinates_.empty()) return {{std::move(vertices_), std::move(triangles_)}, {}};
        return split_vertices();
    }

private:
    void statement() {
        if (text_.at_line_end()) return text_.next_line();
        const std::string_view keyword = text_.token();
        if (keyword == "v") {
            vertex();
        } else if (keyword == "f") {
            face();
        } else if (keyword == "vn") {
            normal();
        } else if (keyword == "vt") {
            coordinates();
        } else if (is_ignored(keyword)) {
            text_.skip_line();
        } else {
            text_.fail(fmt::format("unsupported OBJ element '{}', expected v, vt, vn, f, l, p, g, o, s, mtllib or usemtl",
                                   glimpse_of(keyword)));
        }
        text_.expect_line_end();
        text_.next_line();
    }

    // Lines and points have no area; the others are names, groups and materials, and materials come from the scene file.
    static bool is_ignored(std::string_view keyword) {
        for (const std::string_view ignored : {"l", "p", "g", "o", "s", "mtllib", "usemtl"}) {
            if (keyword == ignored) return true;
        }
        return false;
    }

    Vec3 finite_triple(const char* noun) {
        Vec3 result;
        for (int i = 0; i < 3; ++i) {
            result[i] = text_.number();
            if (!std::isfinite(result[i])) text_.fail(fmt::format("{} coordinate is not finite", noun));
        }
        return result;
    }

    void vertex() {
        vertices_.push_back(finite_triple("vertex"));
        // These numbers are a weight, which matters for free-form geometry only, or a colour.
        for (int i = 0; i < 4 && !text_.at_line_end(); ++i) text_.number();
    }

    void normal() { normals_.push_back(finite_triple("normal")); }

    // Reads one, two or three numbers; the second is 0 if it is missing.
    void coordinates() {
        Vec2 uv(0.0);
        for (int i = 0; i < 3 && (i == 0 || !text_.at_line_end()); ++i) {
            const double value = text_.number();
            if (!std::isfinite(value)) text_.fail("texture coordinate is not finite");
            if (i < 2) uv[i] = value;
        }
        coordinates_.push_back(uv);
    }

    // Reads v, v/vt, v//vn or v/vt/vn.
    Corner corner() {
        constexpr auto expected = "a vertex as v, v/vt, v//vn or v/vt/vn";
        text_.begin_token();
        const auto place = text_.place();
        std::int64_t vertex = 0, coordinates = 0, normal = 0;
        if (!text_.integer_prefix(vertex)) text_.fail_expected(expected);
        auto coordinates_place = place, normal_place = place;
        bool has_coordinates = false, has_normal = false;
        if (text_.accept('/')) {
            coordinates_place = text_.place_here();
            has_coordinates = text_.integer_prefix(coordinates);
            has_normal = text_.accept('/');
            normal_place = text_.place_here();
            if ((!has_coordinates && !has_normal) || (has_normal && !text_.integer_prefix(normal))) text_.fail_expected(expected);
        }
        if (!text_.at_delimiter()) text_.fail_expected(expected);
        return {vertex_references_.resolve(vertex, vertices_.size(), place),
                has_coordinates ? coordinate_references_.resolve(coordinates, coordinates_.size(), coordinates_place) : none,
                has_normal ? normal_references_.resolve(normal, normals_.size(), normal_place) : none};
    }

    void face() {
        const auto place = text_.place();
        Corner first{}, previous{};
        std::size_t count = 0;
        const std::size_t first_triangle = triangles_.size();
        for (; !text_.at_line_end(); ++count) {
            const Corner next = corner();
            if (count == 0) first = next;
            if ((next.normal == none) != (first.normal == none)) {
                text_.fail("expected a normal at all vertices of a face or at none");
            }
            if ((next.coordinates == none) != (first.coordinates == none)) {
                text_.fail("expected texture coordinates at all vertices of a face or at none");
            }
            if (count >= 2) triangle(first, previous, next);
            previous = next;
        }
        if (count < 3) text_.fail(place, fmt::format("a face needs at least 3 vertices, found {}", count));
        if (count > 3) fans_.push_back({first_triangle, count});
    }

    void triangle(const Corner& a, const Corner& b, const Corner& c) {
        if (a.coordinates != none) {
            triangle_coordinates_.resize(triangles_.size(), all_none);
            triangle_coordinates_.push_back({a.coordinates, b.coordinates, c.coordinates});
        }
        if (a.normal != none) {
            triangle_normals_.resize(triangles_.size(), all_none);
            triangle_normals_.push_back({a.normal, b.normal, c.normal});
        }
        triangles_.push_back({a.vertex, b.vertex, c.vertex});
    }

    MeshFile split_vertices() {
        MeshFile result;
        auto& vertices = result.mesh.vertices;
        const bool has_coordinates = !triangle_coordinates_.empty(), has_normals = !triangle_normals_.empty();
        vertices.reserve(vertices_.size());
        if (has_coordinates) result.mesh.uv.reserve(vertices_.size());
        if (has_normals) result.normals.reserve(vertices_.size());

        const auto add = [&](const Corner& corner, const Vec3& normal) {
            if (vertices.size() == max_mesh_count) {
                throw InputError(fmt::format("{}: has more than {} vertices with different normals or texture coordinates",
                                             text_.file(), max_mesh_count));
            }
            vertices.push_back(vertices_[corner.vertex]);
            if (has_coordinates)
                result.mesh.uv.push_back(corner.coordinates == none ? Vec2(0.0) : coordinates_[corner.coordinates]);
            if (has_normals) result.normals.push_back(normal);
            return static_cast<std::uint32_t>(vertices.size() - 1);
        };

        // Most vertices have one normal and one pair of coordinates; only the others need the map.
        struct Use {
            std::uint32_t coordinates = none, normal = none, vertex = none;
        };
        std::vector<Use> first_use(vertices_.size());
        std::unordered_map<Corner, std::uint32_t, HashOfCorner> later_uses;
        const auto find = [&](const Corner& corner) {
            const Vec3 normal = has_normals ? normals_[corner.normal] : Vec3(0.0);
            Use& first = first_use[corner.vertex];
            if (first.vertex == none) first = {corner.coordinates, corner.normal, add(corner, normal)};
            if (first.coordinates == corner.coordinates && first.normal == corner.normal) return first.vertex;
            const auto [use, is_new] = later_uses.try_emplace(corner, 0);
            if (is_new) use->second = add(corner, normal);
            return use->second;
        };

        for (std::size_t i = 0; i < triangles_.size(); ++i) {
            Triple& t = triangles_[i];
            const Triple coordinates = has_coordinates ? triangle_coordinates_[i] : all_none;
            const Triple normals = has_normals ? triangle_normals_[i] : all_none;
            const bool flat = has_normals && normals == all_none;
            const Vec3 normal = flat ? geometric_normal(vertices_[t[0]], vertices_[t[1]], vertices_[t[2]]) : Vec3(0.0);
            for (std::size_t k = 0; k < 3; ++k) {
                const Corner corner{t[k], coordinates[k], normals[k]};
                t[k] = flat ? add(corner, normal) : find(corner);
            }
        }
        result.mesh.triangles = std::move(triangles_);
        return result;
    }

    static Vec3 geometric_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
        // Edges are scaled first, because products of very small or large ones underflow or overflow.
        const auto unit = [](const Vec3& v) {
            const double largest = max_component(glm::abs(v));
            return largest > 0.0 && std::isfinite(largest) ? glm::normalize(v / largest) : Vec3(0.0);
        };
        return unit(glm::cross(unit(b - a), unit(c - a)));
    }

    MeshText text_;
    References vertex_references_{text_, "vertex"}, coordinate_references_{text_, "texture coordinate"},
        normal_references_{text_, "normal"};
    std::vector<Vec3> vertices_, normals_;
    std::vector<Vec2> coordinates_;
    std::vector<Triple> triangles_;
    std::vector<Fan> fans_;
    // One entry per triangle so far; empty until a face has coordinates or normals.
    std::vector<Triple> triangle_coordinates_, triangle_normals_;
};

}  // namespace

MeshFile read_obj(const std::string& path) {
    const std::string bytes = read_input(path);
    std::string_view text = bytes;
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    return ObjReader(path, text).read();
}

}  // namespace neumann
