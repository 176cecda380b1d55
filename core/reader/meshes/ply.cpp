#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/image/colour/spectrum_to_rgb.h"
#include "core/image/colour/srgb_bytes.h"
#include "core/reader/meshes/mesh_file.h"
#include "core/reader/meshes/mesh_ply_header.h"
#include "core/reader/meshes/mesh_text.h"
#include "core/reader/meshes/polygons.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace neumann {
namespace {

static_assert(std::endian::native == std::endian::little || std::endian::native == std::endian::big);

// Thrown if the body ends within a row; the caller adds which one.
struct Ended {};

// Reads the rows of an ASCII body, one element a line.
class AsciiRows {
public:
    explicit AsciiRows(MeshText& text) : text_(text) {}

    static std::size_t min_size(PlyType) { return 2; }  // a digit and a blank
    std::size_t remaining() const { return text_.remaining(); }

    void begin(const PlyElement&, std::uint64_t) {
        while (text_.at_line_end()) {
            if (text_.at_end()) throw Ended();
            text_.next_line();
        }
    }
    void end() { text_.expect_line_end(); }

    double number(PlyType) {
        check_end();
        return text_.number();
    }
    std::int64_t integer(PlyType) {
        check_end();
        return text_.integer<std::int64_t>("an integer");
    }
    void skip(PlyType type, std::int64_t count) {
        for (; count > 0; --count) number(type);
    }

    [[noreturn]] void fail(const std::string& what) const { text_.fail(what); }
    void check_rest() {
        for (; !text_.at_end(); text_.next_line()) {
            if (!text_.at_line_end()) text_.fail_expected("the end of the file after the last element");
        }
    }

private:
    void check_end() {
        if (text_.at_line_end() && text_.at_end()) throw Ended();
    }
    MeshText& text_;
};

// Reads the rows of a binary body in either byte order.
template <std::endian order>
class BinaryRows {
public:
    explicit BinaryRows(const MeshText& text) : file_(text.file()), at_(text.position()), end_(at_ + text.remaining()) {}

    static std::size_t min_size(PlyType type) { return size_of(type); }
    std::size_t remaining() const { return static_cast<std::size_t>(end_ - at_); }

    void begin(const PlyElement& element, std::uint64_t row) {
        element_ = &element;
        row_ = row;
    }
    void end() {}

    double number(PlyType type) { return load<double>(type); }
    std::int64_t integer(PlyType type) { return load<std::int64_t>(type); }
    void skip(PlyType type, std::int64_t count) {
        if (static_cast<std::uint64_t>(count) > remaining() / size_of(type)) throw Ended();
        at_ += static_cast<std::size_t>(count) * size_of(type);
    }

    [[noreturn]] void fail(const std::string& what) const {
        throw InputError(fmt::format("{}: {} {}: {}", file_, printable(element_->name), row_ + 1, what));
    }
    // Zeros and blanks after the body are accepted as padding.
    void check_rest() const {
        for (const char c : std::string_view(at_, remaining())) {
            if (c != '\0' && c != '\n' && c != '\r' && c != ' ') {
                throw InputError(fmt::format("{}: {} after the last element", file_, counted(remaining(), "byte")));
            }
        }
    }

private:
    template <class Result>
    Result load(PlyType type) {
        switch (type) {
            case PlyType::i8:
                return static_cast<Result>(take<std::int8_t>());
            case PlyType::u8:
                return static_cast<Result>(take<std::uint8_t>());
            case PlyType::i16:
                return static_cast<Result>(take<std::int16_t>());
            case PlyType::u16:
                return static_cast<Result>(take<std::uint16_t>());
            case PlyType::i32:
                return static_cast<Result>(take<std::int32_t>());
            case PlyType::u32:
                return static_cast<Result>(take<std::uint32_t>());
            case PlyType::f32:
                return static_cast<Result>(take<float>());
            case PlyType::f64:
                break;
        }
        return static_cast<Result>(take<double>());
    }

    template <class T>
    T take() {
        if (remaining() < sizeof(T)) throw Ended();
        char bytes[sizeof(T)];
        std::memcpy(bytes, at_, sizeof(T));
        if constexpr (order != std::endian::native) std::reverse(bytes, bytes + sizeof(T));
        at_ += sizeof(T);
        T value;
        std::memcpy(&value, bytes, sizeof(T));
        return value;
    }

    std::string file_;
    const char* at_;
    const char* end_;
    const PlyElement* element_ = nullptr;
    std::uint64_t row_ = 0;
};

template <class Rows>
class BodyReader {
public:
    BodyReader(Rows rows, const PlyHeader& header, const std::string& file)
        : rows_(std::move(rows)), header_(header), file_(file) {}

    MeshFile read() {
        for (const auto& element : header_.elements) {
            if (element.name == "vertex") {
                reserve(result_.mesh.vertices, element);
                if (header_.has_normals) reserve(result_.normals, element);
                if (header_.has_coordinates) reserve(result_.mesh.uv, element);
                begin_attributes(element);
                rows(element, [&] { vertex(element); });
            } else if (element.name == "face") {
                reserve(result_.mesh.triangles, element);
                begin_attributes(element);
                rows(element, [&] { face(element); });
            } else {
                rows(element, [&] { other(element); });
            }
        }
        rows_.check_rest();
        if (result_.mesh.triangles.empty()) throw InputError(file_ + ": has no faces");
        if (result_.mesh.triangles.size() > max_mesh_count) {
            throw InputError(fmt::format("{}: has more than {}", file_, counted(max_mesh_count, "triangle")));
        }
        cut_fans(fans_, result_.mesh.triangles, [&](std::uint32_t vertex) { return result_.mesh.vertices[vertex]; });
        return std::move(result_);
    }

private:
    // Reserves no more than the rest of the file can contain.
    template <class T>
    void reserve(std::vector<T>& items, const PlyElement& element) const {
        std::size_t row_size = 0;
        for (const auto& property : element.properties) {
            row_size += Rows::min_size(property.is_list ? property.count_type : property.type);
        }
        items.reserve(std::min<std::uint64_t>(element.count, rows_.remaining() / std::max<std::size_t>(row_size, 1) + 1));
    }

    template <class Row>
    void rows(const PlyElement& element, Row&& read_row) {
        // An element without properties takes no space in the body.
        if (element.properties.empty()) return;
        for (std::uint64_t i = 0; i < element.count; ++i) {
            try {
                rows_.begin(element, i);
                read_row();
                rows_.end();
            } catch (const Ended&) {
                const auto name = printable(element.name);
                if (i == 0) throw InputError(fmt::format("{}: ends before {} 1 of {}", file_, name, element.count));
                throw InputError(fmt::format("{}: ends after {} {} of {}", file_, name, i, element.count));
            }
        }
    }

    void begin_attributes(const PlyElement& element) {
        first_attribute_ = result_.mesh.attributes.size();
        row_.assign(element.attributes.size(), {});
        for (const auto& a : element.attributes) {
            result_.mesh.attributes.push_back({a.name, element.name == "face"});
            reserve(result_.mesh.attributes.back().values, element);
        }
    }
    void read_channel(const PlyElement& element, const PlyProperty& property) {
        const int i = property.slot - PlyProperty::first_attribute;
        const auto attribute = static_cast<std::size_t>(i / 3);
        double value = rows_.number(property.type);
        const double most = largest(property.type);
        if (most > 0.0) {
            if (value < 0.0 || value > most)
                rows_.fail(fmt::format("{} is {}, expected a whole number from 0 to {}", property.name, value, most));
            const bool is_byte = property.type == PlyType::u8 && value == std::floor(value);
            value = is_byte ? decoded_srgb_bytes()[static_cast<std::size_t>(value)] : srgb_decode(value / most);
        }
        if (!std::isfinite(static_cast<float>(value))) rows_.fail(property.name + " is not finite");
        auto& channels = row_[attribute];
        if (element.attributes[attribute].is_grey)
            channels.fill(static_cast<float>(value));
        else
            channels[static_cast<std::size_t>(i % 3)] = static_cast<float>(value);
    }
    // Adds the row's attributes for one more vertex or triangle.
    void add_attributes() {
        for (std::size_t i = 0; i < row_.size(); ++i) result_.mesh.attributes[first_attribute_ + i].values.push_back(row_[i]);
    }
    // The largest number of an integer type; 0 for floating-point types.
    static double largest(PlyType type) {
        switch (type) {
            case PlyType::i8:
                return std::numeric_limits<std::int8_t>::max();
            case PlyType::u8:
                return std::numeric_limits<std::uint8_t>::max();
            case PlyType::i16:
                return std::numeric_limits<std::int16_t>::max();
            case PlyType::u16:
                return std::numeric_limits<std::uint16_t>::max();
            case PlyType::i32:
                return std::numeric_limits<std::int32_t>::max();
            case PlyType::u32:
                return std::numeric_limits<std::uint32_t>::max();
            case PlyType::f32:
            case PlyType::f64:
                break;
        }
        return 0.0;
    }

    void vertex(const PlyElement& element) {
        constexpr const char* nouns[] = {"vertex", "normal", "texture"};
        double values[8] = {};
        for (const auto& property : element.properties) {
            if (property.slot < 0) {
                skip(property);
            } else if (property.slot >= PlyProperty::first_attribute) {
                read_channel(element, property);
            } else {
                values[property.slot] = rows_.number(property.type);
                if (!std::isfinite(values[property.slot]))
                    rows_.fail(fmt::format("{} coordinate is not finite", nouns[property.slot / 3]));
            }
        }
        result_.mesh.vertices.emplace_back(values[0], values[1], values[2]);
        if (header_.has_normals) result_.normals.emplace_back(values[3], values[4], values[5]);
        if (header_.has_coordinates) result_.mesh.uv.emplace_back(values[6], values[7]);
        add_attributes();
    }

    void face(const PlyElement& element) {
        const std::size_t before = result_.mesh.triangles.size();
        for (const auto& property : element.properties) {
            if (property.slot < 0) {
                skip(property);
                continue;
            }
            if (property.slot >= PlyProperty::first_attribute) {
                read_channel(element, property);
                continue;
            }
            const std::int64_t count = rows_.integer(property.count_type);
            if (count < 3) rows_.fail(fmt::format("a face needs at least 3 vertices, found {}", count));
            const std::uint32_t first = index(property.type);
            std::uint32_t previous = index(property.type);
            if (count > 3) fans_.push_back({before, static_cast<std::size_t>(count)});
            for (std::int64_t i = 2; i < count; ++i) {
                const std::uint32_t next = index(property.type);
                result_.mesh.triangles.push_back({first, previous, next});
                previous = next;
            }
        }
        for (std::size_t i = before; i < result_.mesh.triangles.size(); ++i) add_attributes();
    }

    std::uint32_t index(PlyType type) {
        const std::int64_t index = rows_.integer(type);
        if (index < 0 || static_cast<std::uint64_t>(index) >= header_.vertex_count) {
            rows_.fail(fmt::format("vertex index {} {}", index, out_of_range(header_.vertex_count, "vertex")));
        }
        return static_cast<std::uint32_t>(index);
    }

    void other(const PlyElement& element) {
        for (const auto& property : element.properties) skip(property);
    }

    void skip(const PlyProperty& property) {
        std::int64_t count = 1;
        if (property.is_list) {
            count = rows_.integer(property.count_type);
            if (count < 0) rows_.fail(fmt::format("a list of length {}", count));
        }
        rows_.skip(property.type, count);
    }

    Rows rows_;
    const PlyHeader& header_;
    const std::string& file_;
    MeshFile result_;
    std::vector<Fan> fans_;
    // The index in the mesh of the first attribute of the element being read, and the attributes' values in the current row.
    std::size_t first_attribute_ = 0;
    std::vector<std::array<float, 3>> row_;
};

}  // namespace

MeshFile read_ply(const std::string& path, const std::vector<std::string>& attributes) {
    return parse_ply(path, read_input(path), attributes);
}

MeshFile parse_ply(const std::string& path, const std::string& bytes, const std::vector<std::string>& attributes) {
    MeshText text(path, bytes, MeshText::Syntax::plain);
    const PlyHeader header = read_ply_header(text, attributes);
    switch (header.format) {
        case PlyFormat::little_endian:
            return BodyReader(BinaryRows<std::endian::little>(text), header, path).read();
        case PlyFormat::big_endian:
            return BodyReader(BinaryRows<std::endian::big>(text), header, path).read();
        case PlyFormat::ascii:
            break;
    }
    return BodyReader(AsciiRows(text), header, path).read();
}

}  // namespace neumann
