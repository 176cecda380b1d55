#include "core/reader/convert_scene.h"

#include "core/image/image_io.h"
#include "core/reader/meshes/write_ply.h"
#include "core/reader/read_raw_scene.h"
#include "core/reader/read_scene.h"
#include "core/reader/xml/document.h"
#include "core/reader/xml/grammar.h"
#include "core/reader/xml/write_xml.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

namespace neumann {

namespace reader {

namespace {

namespace fs = std::filesystem;

std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream bytes;
    bytes << file.rdbuf();
    if (!file || !bytes) throw InputError(path + ": cannot be read");
    return bytes.str();
}

// The picture as a file that a `bitmap` reads: PNG for bytes, OpenEXR for floats.
std::string encode(const Texels& texels) {
    const bool is_grey = texels.channels == 1;
    const auto value = [&](const auto& values, int x, int y, int c) {
        return values[texels.index(x, y) + static_cast<std::size_t>(is_grey ? 0 : c)];
    };
    if (texels.values.empty()) {
        DisplayImage image(texels.width, texels.height, 0);
        auto to = image.bytes.begin();
        for (int y = 0; y < texels.height; ++y)
            for (int x = 0; x < texels.width; ++x)
                for (int c = 0; c < 3; ++c) *to++ = value(texels.bytes, x, y, c);
        return encode_png(image);
    }
    PixelEstimate picture;
    picture.mean = Image(texels.width, texels.height);
    for (int y = 0; y < texels.height; ++y)
        for (int x = 0; x < texels.width; ++x)
            for (int c = 0; c < 3; ++c) picture.mean.at(x, y)[c] = double{value(texels.values, x, y, c)};
    return encode_exr(picture);
}

// Gives every file that a scene names a place beside the scene.
class FilesBeside {
public:
    FilesBeside(const Document& document, std::map<std::string, std::string>& files) : document_(document), files_(files) {}

    void collect(Element& e) {
        const bool names_file = e.tag == "string" && e.attribute("name").value == "filename";
        for (Attribute& a : e.attributes)
            if (names_file && a.name == "value") a.value = moved(a);
        for (Element& child : e.children) collect(child);
    }

private:
    std::string moved(const Attribute& filename) {
        const FilesInMemory& ready = document_.in_memory;
        if (const auto mesh = ready.meshes.find(filename.value); mesh != ready.meshes.end())
            return put(filename.value, "meshes", ".ply", [&] { return encode_ply(*mesh->second); });
        if (const auto picture = ready.pictures.find(filename.value); picture != ready.pictures.end())
            return put(filename.value, "textures", picture->second->values.empty() ? ".png" : ".exr",
                       [&] { return encode(*picture->second); });
        const std::string path = document_.find_file(filename), ending = fs::path(path).extension().string();
        const bool is_mesh = ending == ".obj" || ending == ".ply" || ending == ".serialized" || ending == ".txt";  // of curves
        return put(path, is_mesh ? "meshes" : "textures", ending, [&] { return bytes_of(path); });
    }
    std::string put(const std::string& source, const std::string& folder, const std::string& ending,
                    const std::function<std::string()>& bytes) {
        const auto [known, is_new] = names_.try_emplace(source);
        if (!is_new) return known->second;
        const std::string stem = fs::path(source).stem().string();
        std::string name = fmt::format("{}/{}{}", folder, stem, ending);
        for (int i = 2; files_.contains(name); ++i) name = fmt::format("{}/{}-{}{}", folder, stem, i, ending);
        files_[name] = bytes();
        return known->second = name;
    }

    const Document& document_;
    std::map<std::string, std::string>& files_;
    std::map<std::string, std::string> names_;  // the new names, by path or by name in memory
};

// Removes references to elements that a lenient reader left out.
void drop_references(Element& e, std::set<std::string>& lost) {
    std::erase_if(e.children, [&](const Element& child) {
        const Attribute* id = child.tag == "ref" || child.tag == "alias" ? child.find("id") : nullptr;
        if (!id || !lost.contains(id->value)) return false;
        if (const Attribute* as = child.find("as")) lost.insert(as->value);
        return true;
    });
    for (Element& child : e.children) drop_references(child, lost);
}

// Warns of what Mitsuba 3 does not have.
void warn_of_others(const Element& e, Warnings& warnings) {
    constexpr std::string_view others[] = {"bsdf coating", "bsdf mixturebsdf", "bsdf phong",          "bsdf retroreflector",
                                           "bsdf ward",    "texture scale",    "texture vertexcolors"};
    if (const Attribute* type = e.find("type"); type && std::ranges::find(others, e.tag + " " + type->value) != std::end(others))
        warnings.add(fmt::format("{} '{}' is none of Mitsuba 3's", e.tag, type->value));
    if (const Attribute* type = e.find("type"); type && type->value == "roughplastic")
        for (const Element& child : e.children)
            if (const Attribute* name = child.find("name"); name && name->value == "alpha" && !is_parameter(child.tag))
                warnings.add("a texture as alpha of bsdf 'roughplastic' is none of Mitsuba 3's");
    if (const Attribute* name = e.find("name"); name && name->value == "falloff")
        warnings.add("falloff of emitter 'spot' is none of Mitsuba 3's, where it is linear in the angle");
    for (const Element& child : e.children) warn_of_others(child, warnings);
}

}  // namespace

}  // namespace reader

ConvertedScene convert_scene(const std::string& path, const std::map<std::string, std::string>& definitions, bool lenient) {
    using namespace reader;
    ConvertedScene result;
    result.warnings = read_scene_parts(path, definitions, {.lenient = lenient}).warnings;
    Warnings reported;
    Problems problems(lenient);
    Document document = read_document(read_raw_scene(path, definitions, reported, problems), definitions, reported, problems);
    problems.check(document.files);
    drop_references(document.root, document.lost.ids);
    FilesBeside(document, result.files).collect(document.root);
    warn_of_others(document.root, result.warnings);
    result.xml = write_xml(document.root);
    return result;
}

}  // namespace neumann
