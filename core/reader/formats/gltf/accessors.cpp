#include "core/reader/formats/gltf/accessors.h"

#include "core/reader/formats/gltf/extensions.h"
#include "core/reader/formats/gltf/uri.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace neumann::reader::gltf {

namespace {

enum Component { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

// Calls f with a zero of the component's type.
template <class F>
void with_type(int component, const F& f) {
    switch (component) {
        case i8:
            return f(std::int8_t{0});
        case u8:
            return f(std::uint8_t{0});
        case i16:
            return f(std::int16_t{0});
        case u16:
            return f(std::uint16_t{0});
        case u32:
            return f(std::uint32_t{0});
        default:
            return f(0.0f);
    }
}

std::size_t bytes_of(int component) {
    return component == i8 || component == u8 ? 1 : component == i16 || component == u16 ? 2 : 4;
}

constexpr std::int64_t largest = std::int64_t{1} << 53;  // JSON is sure to have whole numbers up to this

std::size_t required(JsonObject& object, const std::string& name, std::int64_t least) {
    const auto value = object.integer(name, least, largest);
    if (!value) object.fail_missing(name, "a whole number");
    return static_cast<std::size_t>(*value);
}

std::size_t offset(JsonObject& object) { return static_cast<std::size_t>(object.integer("byteOffset", 0, largest).value_or(0)); }

int component_type(JsonObject& object) {
    const std::size_t type = required(object, "componentType", 0);
    for (const int known : {i8, u8, i16, u16, u32, f32})
        if (type == static_cast<std::size_t>(known)) return known;
    throw InputError(object.place_of("componentType"),
                     fmt::format("componentType is {}, expected 5120, 5121, 5122, 5123, 5125 or 5126", type));
}

std::size_t view_of(JsonObject& object, const JsonList& views) {
    const auto view = object.index("bufferView", views, "bufferView");
    if (!view) object.fail_missing("bufferView", "the index of one");
    return *view;
}

// The bytes of `count` elements in a view, from an offset on.
std::string_view elements_in(std::string_view view, std::size_t offset, std::size_t count, std::size_t stride, std::size_t size,
                             const Location& place) {
    if (offset <= view.size() && view.size() - offset >= size && (count - 1) <= (view.size() - offset - size) / stride)
        return view.substr(offset);
    throw InputError(place, fmt::format("{} elements of {} bytes, one every {} bytes, from byte {} on do not fit into the {} bytes "
                                        "of the bufferView",
                                        count, size, stride, offset, view.size()));
}

template <class T>
double normalised(T value) {
    if constexpr (std::is_floating_point_v<T>)
        return static_cast<double>(value);
    else
        return std::max(static_cast<double>(value) / static_cast<double>(std::numeric_limits<T>::max()), -1.0);
}

}  // namespace

struct Accessors::Stored {
    Location place;
    std::size_t count = 0, width = 1, stride = 0;
    int component = f32;
    bool is_normalized = false;
    std::string_view bytes = {};  // empty: all numbers are 0
    std::optional<JsonObject> sparse = {};

    // Calls put(index of the element, index of the component in it, value).
    template <class Put, class PlaceOf>
    void decode(std::string_view from, std::size_t number, std::size_t step, const PlaceOf& place_of, const Put& put) const {
        with_type(component, [&]<class T>(T value) {
            for (std::size_t i = 0; i < number; ++i) {
                const char* at = from.data() + i * step;
                for (std::size_t k = 0; k < width; ++k, at += sizeof value) {
                    std::memcpy(&value, at, sizeof value);
                    put(place_of(i), k, is_normalized ? normalised(value) : static_cast<double>(value));
                }
            }
        });
    }
};

Accessors::Accessors(const GltfFile& file, const std::string& path, JsonObject& root, std::vector<std::string>& files)
    : file_(file),
      path_(path),
      files_(files),
      buffers_(root.list("buffers")),
      views_(root.list("bufferViews")),
      accessors_(root.list("accessors")) {}

std::string_view Accessors::bytes_of_buffer(std::size_t buffer) {
    JsonObject object = buffers_.object(buffer);
    const std::size_t length = required(object, "byteLength", 1);
    object.ignore({"name"});
    const std::optional<std::string> uri = object.text("uri");
    object.finish();
    std::string_view bytes;
    if (uri) {
        const auto [content, is_new] = contents_.try_emplace(buffer);
        if (is_new) content->second = read_uri(*uri, path_, object.place_of("uri"), files_);
        if (!content->second) throw AlreadyReported();
        bytes = *content->second;
    } else if (buffer == 0 && file_.binary()) {
        bytes = *file_.binary();
    } else {
        object.fail_missing("uri", "the path of a file or data in base64");
    }
    if (bytes.size() < length)
        throw InputError(object.place_of("byteLength"), fmt::format("the buffer has {} bytes, expected {}", bytes.size(), length));
    return bytes.substr(0, length);
}

std::string_view Accessors::bytes_of_view(std::size_t view) {
    JsonObject object = views_.object(view);
    const auto buffer = object.index("buffer", buffers_, "buffer");
    if (!buffer) object.fail_missing("buffer", "the index of one");
    const std::size_t begin = offset(object), length = required(object, "byteLength", 1);
    object.ignore({"name", "target", "byteStride"});
    // The file may have the same data uncompressed.
    const bool is_there = buffers_.object(*buffer).has("uri") || (*buffer == 0 && file_.binary());
    for (const char* compression : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
        if (object.extension(compression) && !is_there) fail_compressed(compression, object.place(), object.notes());
    object.finish();
    const std::string_view all = bytes_of_buffer(*buffer);
    if (begin > all.size() || length > all.size() - begin)
        throw InputError(object.place(), fmt::format("{} bytes from byte {} on do not fit into the {} bytes of the buffer", length,
                                                     begin, all.size()));
    return all.substr(begin, length);
}

Accessors::Stored Accessors::stored(std::size_t accessor, const std::vector<std::string>& types) {
    static const std::map<std::string, std::size_t> widths = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    JsonObject object = accessors_.object(accessor);
    Stored s{object.place()};
    s.count = required(object, "count", 1);
    s.component = component_type(object);
    s.is_normalized = object.boolean("normalized", false);
    const std::optional<std::string> type = object.text("type");
    if (!type) object.fail_missing("type", fmt::format("{}", fmt::join(types, " or ")));
    if (std::find(types.begin(), types.end(), *type) == types.end())
        throw InputError(object.place_of("type"), fmt::format("type is {}, expected {}", *type, fmt::join(types, " or ")));
    s.width = widths.at(*type);
    s.sparse = object.object("sparse");
    const std::size_t begin = offset(object), size = s.width * bytes_of(s.component);
    s.stride = size;
    if (object.has("bufferView")) {
        const std::size_t view = view_of(object, views_);
        if (const auto stride = views_.object(view).integer("byteStride", 4, 252)) s.stride = static_cast<std::size_t>(*stride);
        s.bytes = elements_in(bytes_of_view(view), begin, s.count, s.stride, size, s.place);
    }
    object.ignore({"name", "min", "max"});
    object.finish();
    constexpr std::size_t most = 1 << 22;
    if (s.bytes.empty() && s.count > most)
        throw InputError(s.place, fmt::format("{} elements without a bufferView, expected at most {}", s.count, most));
    return s;
}

template <class Put>
void Accessors::read(std::size_t accessor, const std::vector<std::string>& types, const Put& put) {
    const Stored s = stored(accessor, types);
    put.resize(s);
    if (!s.bytes.empty())
        s.decode(
            s.bytes, s.count, s.stride, [](std::size_t i) { return i; }, put);
    if (!s.sparse) return;
    JsonObject sparse = *s.sparse;
    const std::vector<std::size_t> places = read_sparse_places(sparse, s.count);
    auto values = sparse.object("values");
    if (!values) sparse.fail_missing("values", "an object");
    const std::size_t size = s.width * bytes_of(s.component);
    const std::string_view bytes =
        elements_in(bytes_of_view(view_of(*values, views_)), offset(*values), places.size(), size, size, values->place());
    s.decode(
        bytes, places.size(), size, [&](std::size_t i) { return places[i]; }, put);
}

bool Accessors::has_numbers(std::size_t accessor) const {
    const JsonObject object = accessors_.object(accessor);
    return object.has("bufferView") || object.has("sparse");
}

std::vector<std::size_t> Accessors::read_sparse_places(JsonObject& sparse, std::size_t count) {
    const std::size_t number = required(sparse, "count", 1);
    auto indices = sparse.object("indices");
    if (!indices) sparse.fail_missing("indices", "an object");
    Stored s{indices->place(), number};
    s.component = component_type(*indices);
    const std::size_t size = bytes_of(s.component);
    s.bytes = elements_in(bytes_of_view(view_of(*indices, views_)), offset(*indices), number, size, size, s.place);
    std::vector<std::size_t> places;
    s.decode(
        s.bytes, number, size, [](std::size_t i) { return i; },
        [&](std::size_t, std::size_t, double value) {
            if (!(value >= 0.0 && value < static_cast<double>(count) && value == std::floor(value)))
                throw InputError(s.place, fmt::format("index {} is {}, expected less than the {} elements of the accessor",
                                                      places.size(), value, count));
            places.push_back(static_cast<std::size_t>(value));
        });
    return places;
}

std::shared_ptr<const Numbers> Accessors::numbers(std::size_t accessor, const std::vector<std::string>& types) {
    const auto known = numbers_.find(accessor);
    if (known != numbers_.end()) {
        stored(accessor, types);
        return known->second;
    }
    struct Put {
        Numbers& result;
        void resize(const Stored& s) const { result = {s.width, std::vector<float>(s.count * s.width)}; }
        void operator()(std::size_t i, std::size_t k, double value) const {
            result.values[i * result.width + k] = static_cast<float>(value);
        }
    };
    const auto result = std::make_shared<Numbers>();
    read(accessor, types, Put{*result});
    const auto bad = std::find_if(result->values.begin(), result->values.end(), [](float v) { return !std::isfinite(v); });
    if (bad != result->values.end())
        throw InputError(
            accessors_.place_of(accessor),
            fmt::format("element {} is not finite", static_cast<std::size_t>(bad - result->values.begin()) / result->width));
    return numbers_[accessor] = result;
}

std::vector<std::uint32_t> Accessors::indices(std::size_t accessor) {
    struct Put {
        std::vector<std::uint32_t>& result;
        void resize(const Stored& s) const {
            if (s.component != u8 && s.component != u16 && s.component != u32)
                throw InputError(below(s.place, "componentType"),
                                 fmt::format("componentType is {}, expected 5121, 5123 or 5125 for indices", s.component));
            if (s.is_normalized) throw InputError(below(s.place, "normalized"), "normalized is true, expected false for indices");
            result.resize(s.count);
        }
        void operator()(std::size_t i, std::size_t, double value) const { result[i] = static_cast<std::uint32_t>(value); }
    };
    std::vector<std::uint32_t> result;
    read(accessor, {"SCALAR"}, Put{result});
    return result;
}

std::size_t Accessors::count(std::size_t accessor) const {
    JsonObject object = accessors_.object(accessor);
    return required(object, "count", 1);
}

}  // namespace neumann::reader::gltf
