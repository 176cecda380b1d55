#include "core/reader/formats/collada/meshes.h"

#include "core/reader/formats/collada/corners.h"
#include "core/reader/formats/collada/sources.h"
#include "core/reader/formats/collada/texts.h"
#include "core/reader/meshes/polygons.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include <fmt/format.h>

namespace neumann::reader::collada {

namespace {

constexpr std::size_t most_offset = 63;

struct Input {
    Source source;
    std::size_t offset;  // position among the indices of a corner
    const Element* element;
};

struct Inputs {
    std::optional<Input> position, normal, coordinates;
    std::size_t stride = 1;
};

// Reads the inputs of a primitive, with those of its <vertices> in place of VERTEX.
class InputReader {
public:
    InputReader(const Element& mesh, const Element& primitive, const Coordinates& wanted)
        : primitive_(primitive), wanted_(wanted), sources_(mesh) {}

    Inputs read() {
        for (const Element& e : primitive_.children) {
            if (e.tag != "input") continue;
            const std::size_t offset = read_offset(e);
            inputs_.stride = std::max(inputs_.stride, offset + 1);
            if (required_attribute(e, "semantic").value == "VERTEX") {
                for (const Element& inner : sources_.vertices(e).children)
                    if (inner.tag == "input") add(inner, offset);
            } else {
                add(e, offset);
            }
        }
        if (!inputs_.position)
            throw InputError(primitive_.place,
                             fmt::format("<{}> has no input VERTEX with a POSITION, expected one", primitive_.tag));
        if (wanted_.wanted && !inputs_.coordinates)
            throw InputError(primitive_.place,
                             wanted_.set
                                 ? fmt::format("<{}> has no texture coordinates of set {}, which its material needs",
                                               primitive_.tag, *wanted_.set)
                                 : fmt::format("<{}> has no texture coordinates, which its material needs", primitive_.tag));
        return std::move(inputs_);
    }

private:
    static std::size_t read_offset(const Element& e) {
        const Attribute& a = required_attribute(e, "offset");
        const std::size_t offset = read_count(a);
        if (offset > most_offset) throw InputError(a.place, fmt::format("offset is {}, expected at most {}", offset, most_offset));
        return offset;
    }

    void add(const Element& e, std::size_t offset) {
        const std::string& semantic = required_attribute(e, "semantic").value;
        if (semantic == "POSITION") {
            inputs_.position = {sources_.find(e, 3), offset, &e};
        } else if (semantic == "NORMAL") {
            inputs_.normal = {sources_.find(e, 3), offset, &e};
        } else if (semantic == "TEXCOORD" && wanted_.wanted) {
            const Attribute* given = e.find("set");
            const std::size_t set = given ? read_count(*given) : 0;
            if (wanted_.set ? set != static_cast<std::size_t>(*wanted_.set) : inputs_.coordinates && set >= lowest_) return;
            lowest_ = set;
            inputs_.coordinates = {sources_.find(e, 2), offset, &e};
        }
    }

    const Element& primitive_;
    const Coordinates& wanted_;
    Sources sources_;
    Inputs inputs_;
    std::size_t lowest_ = 0;
};

// Numbers the different triples of indices in the order in which they come; a hash table with open addressing.
class Vertices {
public:
    using Key = std::array<std::uint32_t, 3>;
    explicit Vertices(std::size_t corners) : slots_(std::bit_ceil(2 * corners + 2), none) {}

    std::uint32_t number(const Key& key) {
        std::uint64_t hash = 0;
        for (const std::uint32_t part : key) {
            hash = (hash ^ part) * 0x9e3779b97f4a7c15;
            hash ^= hash >> 29;
        }
        for (std::size_t i = hash;; ++i) {
            std::uint32_t& slot = slots_[i & (slots_.size() - 1)];
            if (slot == none) {
                slot = static_cast<std::uint32_t>(keys.size());
                keys.push_back(key);
                return slot;
            }
            if (keys[slot] == key) return slot;
        }
    }

    std::vector<Key> keys;

private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> slots_;
};

std::uint32_t index_of(const std::optional<Input>& input, const std::uint32_t* corner, const Element& primitive) {
    if (!input) return 0;
    const std::uint32_t index = corner[input->offset];
    if (index >= input->source.count())
        throw InputError(primitive.place,
                         fmt::format("<{}> has the index {} for {}, but there are only {}, counted from 0", primitive.tag, index,
                                     required_attribute(*input->element, "semantic").value, input->source.count()));
    return index;
}

Vec3 vector_at(const Source& s, std::size_t i) { return {s.at(i, 0), s.at(i, 1), s.at(i, 2)}; }

const std::array<std::string, 6> parts_of_primitive = {"extra", "input", "p", "param", "ph", "vcount"};

}  // namespace

std::shared_ptr<const MeshFile> read_mesh(const Element& mesh, const Element& primitive, const Coordinates& coordinates,
                                          Problems& problems) {
    check_children(primitive, parts_of_primitive, problems);
    const Inputs inputs = InputReader(mesh, primitive, coordinates).read();
    Corners corners = read_corners(primitive, inputs.stride);
    if (corners.triangles.empty()) return nullptr;
    cut_fans(corners.fans, corners.triangles, [&](std::uint32_t corner) {
        return vector_at(inputs.position->source,
                         index_of(inputs.position, corners.indices.data() + corner * corners.stride, primitive));
    });

    auto result = std::make_shared<MeshFile>();
    TriangleMesh& made = result->mesh;
    made.triangles = corners.triangles;
    Vertices vertices(corners.indices.size() / corners.stride);
    for (auto& triangle : made.triangles)
        for (std::uint32_t& corner : triangle) {
            const std::uint32_t* indices = corners.indices.data() + corner * corners.stride;
            corner = vertices.number({index_of(inputs.position, indices, primitive), index_of(inputs.normal, indices, primitive),
                                      index_of(inputs.coordinates, indices, primitive)});
        }

    made.vertices.reserve(vertices.keys.size());
    for (const auto& key : vertices.keys) {
        made.vertices.push_back(vector_at(inputs.position->source, key[0]));
        if (inputs.normal) result->normals.push_back(vector_at(inputs.normal->source, key[1]));
        if (inputs.coordinates)
            made.uv.emplace_back(inputs.coordinates->source.at(key[2], 0), inputs.coordinates->source.at(key[2], 1));
    }
    return result;
}

bool has_vertex_colors(const Element& mesh, const Element& primitive) {
    const auto has_color = [](const Element& e) {
        return std::any_of(e.children.begin(), e.children.end(), [](const Element& c) {
            const Attribute* semantic = c.tag == "input" ? c.find("semantic") : nullptr;
            return semantic && semantic->value == "COLOR";
        });
    };
    const Element* vertices = child(mesh, "vertices");
    return has_color(primitive) || (vertices && has_color(*vertices));
}

}  // namespace neumann::reader::collada
