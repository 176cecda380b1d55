#include "core/reader/meshes/mesh_ply_header.h"

#include "core/base/error.h"

#include <array>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace neumann {
namespace {

constexpr std::array<std::string_view, 6> vertex_slots{"x", "y", "z", "nx", "ny", "nz"};

PlyType read_type(MeshText& text) {
    constexpr std::pair<std::string_view, PlyType> types[] = {
        {"char", PlyType::i8},   {"int8", PlyType::i8},     {"uchar", PlyType::u8},   {"uint8", PlyType::u8},
        {"short", PlyType::i16}, {"int16", PlyType::i16},   {"ushort", PlyType::u16}, {"uint16", PlyType::u16},
        {"int", PlyType::i32},   {"int32", PlyType::i32},   {"uint", PlyType::u32},   {"uint32", PlyType::u32},
        {"float", PlyType::f32}, {"float32", PlyType::f32}, {"double", PlyType::f64}, {"float64", PlyType::f64},
    };
    const std::string_view token = text.token();
    for (const auto& [name, type] : types) {
        if (token == name) return type;
    }
    text.fail_expected("a type (char, uchar, short, ushort, int, uint, float, double or int8 to float64)");
}

bool is_integer(PlyType type) { return type != PlyType::f32 && type != PlyType::f64; }

int find_slot(const PlyElement& element, std::string_view property) {
    if (element.name == "vertex") {
        for (std::size_t i = 0; i < vertex_slots.size(); ++i) {
            if (property == vertex_slots[i]) return static_cast<int>(i);
        }
    }
    if (element.name == "face" && (property == "vertex_indices" || property == "vertex_index")) return 0;
    return -1;
}

class HeaderReader {
public:
    HeaderReader(MeshText& text, const std::vector<std::string>& attributes) : text_(text), attributes_(attributes) {}

    PlyHeader read() {
        if (text_.token() != "ply") text_.fail_expected("'ply' at the beginning of a PLY file");
        text_.expect_line_end();
        // If lines end with CR, an LF after the header belongs to the body.
        const bool cr_ends_lines = text_.at_lone_cr();
        do {
            text_.expect_line_end();
            text_.next_line();
        } while (statement());
        if (!(cr_ends_lines && text_.accept('\r'))) text_.next_line();
        if (!has_format_) throw InputError(text_.file() + ": the header has no line 'format'");
        check_vertex();
        check_face();
        find_coordinates();
        for (PlyElement& e : header_.elements)
            for (const std::string& name : attributes_)
                if (name.starts_with(e.name + "_")) find_attribute(e, name);
        return std::move(header_);
    }

private:
    // Reads a statement. Returns false at the end of the header.
    bool statement() {
        if (text_.at_line_end()) {
            if (text_.at_end()) throw InputError(text_.file() + ": ends before 'end_header'");
            return true;
        }
        const std::string_view keyword = text_.token();
        if (keyword == "end_header") {
            text_.expect_line_end();
            return false;
        }
        if (keyword == "comment" || keyword == "obj_info") {
            text_.skip_line();
        } else if (keyword == "format") {
            format();
        } else if (keyword == "element") {
            begin_element();
        } else if (keyword == "property") {
            property();
        } else {
            text_.fail_expected("format, element, property, comment, obj_info or end_header");
        }
        return true;
    }

    void format() {
        if (has_format_) text_.fail("'format' is given twice");
        has_format_ = true;
        const std::string_view name = text_.token();
        if (name == "ascii") {
            header_.format = PlyFormat::ascii;
        } else if (name == "binary_little_endian") {
            header_.format = PlyFormat::little_endian;
        } else if (name == "binary_big_endian") {
            header_.format = PlyFormat::big_endian;
        } else {
            text_.fail_expected("ascii, binary_little_endian or binary_big_endian");
        }
        if (text_.token() != "1.0") text_.fail_expected("version 1.0");
    }

    void begin_element() {
        PlyElement element;
        element.name = text_.token();
        element.place = text_.place();
        if (element.name.empty()) text_.fail_expected("the name of an element");
        if (element.name == "tristrips") text_.fail("unsupported PLY element 'tristrips', expected an element 'face'");
        if ((element.name == "vertex" || element.name == "face") && find(element.name)) {
            text_.fail(fmt::format("element '{}' is given twice", element.name));
        }
        element.count = text_.integer<std::uint64_t>("the number of elements");
        if (element.name == "vertex") {
            if (element.count > max_mesh_count) text_.fail(fmt::format("more than {}", counted(max_mesh_count, "vertex")));
            header_.vertex_count = element.count;
        }
        header_.elements.push_back(std::move(element));
    }

    void property() {
        if (header_.elements.empty()) text_.fail("expected an element before its properties");
        PlyElement& element = header_.elements.back();
        PlyProperty property;
        auto type_place = text_.place();
        const auto type = [&] {
            const PlyType result = read_type(text_);
            type_place = text_.place();
            return result;
        };
        if (text_.accept_token("list")) {
            property.is_list = true;
            property.count_type = type();
            if (!is_integer(property.count_type)) text_.fail("expected an integer type for the length of a list");
        }
        property.type = type();
        property.name = text_.token();
        if (property.name.empty()) text_.fail_expected("the name of a property");
        property.slot = find_slot(element, property.name);
        if (property.slot >= 0) {
            const bool is_face = element.name == "face";
            if (const PlyProperty* other = element.find(property.slot)) {
                if (other->name == property.name) text_.fail(fmt::format("property '{}' is given twice", property.name));
                text_.fail(fmt::format("property '{}' is given besides '{}'", property.name, other->name));
            }
            if (property.is_list != is_face) {
                text_.fail(fmt::format("property '{}' is {}, expected {}", property.name, is_face ? "a number" : "a list",
                                       is_face ? "a list" : "a number"));
            }
            if (is_face && !is_integer(property.type)) text_.fail(type_place, "expected an integer type for vertex indices");
        }
        element.properties.push_back(std::move(property));
    }

    const PlyElement* find(std::string_view name) const {
        for (const auto& element : header_.elements) {
            if (element.name == name) return &element;
        }
        return nullptr;
    }

    const PlyElement& element(std::string_view name) const {
        if (const PlyElement* element = find(name)) return *element;
        throw InputError(fmt::format("{}: the header has no element '{}'", text_.file(), name));
    }

    void check_vertex() {
        const PlyElement& vertex = element("vertex");
        for (int slot = 3; slot < 6; ++slot) header_.has_normals |= vertex.find(slot) != nullptr;
        for (int slot = 0; slot < (header_.has_normals ? 6 : 3); ++slot) {
            if (vertex.find(slot)) continue;
            text_.fail(vertex.place, fmt::format("element 'vertex' has no property '{}'", vertex_slots[slot]));
        }
    }

    void check_face() const {
        const PlyElement& face = element("face");
        if (!face.find(0)) text_.fail(face.place, "element 'face' has no property 'vertex_indices'");
    }

    static PlyProperty* number(PlyElement& element, std::string_view name) {
        for (PlyProperty& p : element.properties)
            if (p.name == name && !p.is_list && p.slot < 0) return &p;
        return nullptr;
    }

    void find_coordinates() {
        for (PlyElement& e : header_.elements) {
            if (e.name != "vertex") continue;
            for (const auto& [name_u, name_v] : {std::pair("u", "v"), std::pair("texture_u", "texture_v"), std::pair("s", "t")}) {
                PlyProperty *u = number(e, name_u), *v = number(e, name_v);
                if (!u || !v || header_.has_coordinates) continue;
                u->slot = 6;
                v->slot = 7;
                header_.has_coordinates = true;
            }
        }
    }

    // The properties "p_0", "p_1", … for the characters of `ends`; nothing if the first is missing.
    std::vector<PlyProperty*> series(PlyElement& element, const std::string& prefix, std::string_view ends) const {
        std::vector<PlyProperty*> found;
        for (std::size_t i = 0; i < ends.size() && (i == 0 || !found.empty()); ++i) {
            PlyProperty* p = number(element, prefix + ends[i]);
            if (!p) continue;
            if (found.size() < i)
                text_.fail(element.place, fmt::format("element '{}' has the property '{}' without '{}'", element.name, p->name,
                                                      prefix + ends[found.size()]));
            found.push_back(p);
        }
        return found;
    }

    // The properties of an attribute; `name` is its name without "vertex_" or "face_".
    std::vector<PlyProperty*> channels(PlyElement& element, const std::string& name) const {
        constexpr std::string_view color = "color";
        if (name == color)
            for (const std::array names : {std::array{"r", "g", "b"}, std::array{"red", "green", "blue"}}) {
                const std::vector found = {number(element, names[0]), number(element, names[1]), number(element, names[2])};
                if (found[0] && found[1] && found[2]) return found;
            }
        if (name.ends_with("_color"))
            if (auto found = series(element, name.substr(0, name.size() - color.size()), "rgb"); !found.empty()) return found;
        for (const std::string_view ends : {"xyzw", "0123456789", "123456789"})
            if (auto found = series(element, name + "_", ends); !found.empty()) return found;
        return {};
    }

    void find_attribute(PlyElement& element, const std::string& name) const {
        const std::vector<PlyProperty*> found = channels(element, name.substr(element.name.size() + 1));
        if (found.empty()) return;
        if (found.size() != 1 && found.size() != 3)
            text_.fail(element.place, fmt::format("mesh attribute '{}' has {} channels, from '{}' to '{}', expected 1 or 3", name,
                                                  found.size(), found.front()->name, found.back()->name));
        for (std::size_t c = 0; c < found.size(); ++c)
            found[c]->slot = PlyProperty::first_attribute + 3 * static_cast<int>(element.attributes.size()) + static_cast<int>(c);
        element.attributes.push_back({name, found.size() == 1});
    }

    MeshText& text_;
    const std::vector<std::string>& attributes_;
    PlyHeader header_;
    bool has_format_ = false;
};

}  // namespace

std::size_t size_of(PlyType type) {
    constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[static_cast<int>(type)];
}

const PlyProperty* PlyElement::find(int slot) const {
    for (const auto& property : properties) {
        if (property.slot == slot) return &property;
    }
    return nullptr;
}

PlyHeader read_ply_header(MeshText& text, const std::vector<std::string>& attributes) {
    return HeaderReader(text, attributes).read();
}

}  // namespace neumann
