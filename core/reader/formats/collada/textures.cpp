#include "core/reader/formats/collada/textures.h"

#include "core/base/did_you_mean.h"
#include "core/reader/formats/collada/texts.h"
#include "core/reader/formats/collada/uri.h"
#include "core/reader/formats/make_elements.h"

#include <array>
#include <filesystem>

#include <fmt/format.h>

namespace neumann::reader::collada {

namespace {

namespace fs = std::filesystem;

// The element with the name or address of the file of an <image>.
const Element& address_of(const Element& image) {
    if (const Element* data = child(image, "data"))
        throw InputError(data->place, "a picture in the file, <data>, is not supported; expected the name of a file, <init_from>");
    const Element& init = required_child(image, "init_from");
    const Element* ref = child(init, "ref");  // COLLADA 1.5
    return ref ? *ref : init;
}

// A picture that is not where its name says, such as one on another machine, may be beside the scene.
std::string find_picture(const Element& address, const Import& import) {
    const std::string given = trimmed_text(address), path = path_of_uri(given);
    const fs::path folder = fs::path(address.place.file).parent_path();
    const auto exists = [&](const std::string& name) {
        std::error_code error;
        return !name.empty() && fs::is_regular_file(folder / name, error);
    };
    if (exists(path)) return path;
    if (exists(given)) return given;
    const std::string name = path.substr(path.find_last_of('/') + 1);
    if (!exists(name)) return path;
    import.warnings.add(fmt::format("the picture '{}' is taken from beside the scene, since it is not where the file says", name));
    return name;
}

const Element& sampler_image(const Element& sampler, const Parameters& parameters, const File& file) {
    if (const Element* instance = child(sampler, "instance_image"))  // COLLADA 1.5
        return file.find(required_attribute(*instance, "url"), "image");
    const Element& source = required_child(sampler, "source");
    const Element& surface = required_child(parameters.find(trimmed_text(source), source.place), "surface");
    const Element& init = required_child(surface, "init_from");
    return file.find({"init_from", trimmed_text(init), init.place}, "image");
}

std::string wrap_mode(const Element& sampler, const Import& import) {
    const auto mode = [&](const char* tag) -> std::string {
        const Element* e = child(sampler, tag);
        const std::string text = e ? trimmed_text(*e) : "WRAP";
        if (text == "WRAP") return "repeat";
        if (text == "MIRROR") return "mirror";
        if (text == "CLAMP") return "clamp";
        if (text == "BORDER" || text == "NONE") {
            import.warnings.add("a picture with a border around it continues its edge instead");
            return "clamp";
        }
        throw InputError(e->place, fmt::format("<{}> is '{}', expected WRAP, MIRROR, CLAMP, BORDER or NONE", tag, text));
    };
    const std::string across = mode("wrap_s"), up = mode("wrap_t");
    if (across != up) import.warnings.add("a picture that continues differently across and up: it is taken as across");
    return across;
}

// Warns of numbers with which Maya and others place a picture, unless they are the usual ones.
void warn_of_placement(const Element& texture, const Import& import) {
    static const std::array<std::pair<std::string, std::string>, 9> usual = {{{"repeatU", "1"},
                                                                              {"repeatV", "1"},
                                                                              {"offsetU", "0"},
                                                                              {"offsetV", "0"},
                                                                              {"rotateUV", "0"},
                                                                              {"coverageU", "1"},
                                                                              {"coverageV", "1"},
                                                                              {"translateFrameU", "0"},
                                                                              {"rotateFrame", "0"}}};
    const Element* extra = child(texture, "extra");
    const Element* technique = extra ? child(*extra, "technique") : nullptr;
    if (!technique) return;
    for (const auto& [tag, number] : usual) {
        const Element* e = child(*technique, tag);
        if (e && read_number(*e) != (number == "1" ? 1.0 : 0.0))
            import.warnings.add(fmt::format("<{}> of a <texture> is left out: a program's own placement of pictures", tag));
    }
}

}  // namespace

Parameters::Parameters(const Element& effect) {
    add(effect);
    if (const Element* profile = child(effect, "profile_COMMON")) {
        add(*profile);
        if (const Element* technique = child(*profile, "technique")) add(*technique);
    }
}

void Parameters::add(const Element& e) {
    for (const Element& c : e.children)
        if (const Attribute* sid = c.tag == "newparam" ? c.find("sid") : nullptr) parameters_[sid->value] = &c;
}

const Element* Parameters::known(const std::string& sid) const {
    const auto found = parameters_.find(sid);
    return found != parameters_.end() ? found->second : nullptr;
}

const Element& Parameters::find(const std::string& sid, const Location& place) const {
    if (const Element* found = known(sid)) return *found;
    std::vector<std::string> names;
    for (const auto& [name, e] : parameters_) names.push_back(name);
    throw InputError(place, fmt::format("there is no <newparam> '{}' in this effect{}", sid, did_you_mean(sid, names)));
}

Element make_bitmap(const Element& texture, const std::string& name, const Parameters& parameters, const Import& import) {
    const Attribute& sampler_name = required_attribute(texture, "texture");
    const Element* parameter = parameters.known(sampler_name.value);
    // Some programs refer to the picture itself.
    if (!parameter && !import.file.known(sampler_name.value, "image")) parameters.find(sampler_name.value, sampler_name.place);
    const Element* sampler = parameter ? &required_child(*parameter, "sampler2D") : nullptr;
    const Element& image = sampler ? sampler_image(*sampler, parameters, import.file) : import.file.find(sampler_name, "image");
    const Element& address = address_of(image);

    Element bitmap = make_object("texture", "bitmap", texture.place);
    bitmap.attributes.push_back({"name", name, texture.place});
    add_string(bitmap, "filename", find_picture(address, import), address.place);
    if (sampler) {
        if (const std::string mode = wrap_mode(*sampler, import); mode != "repeat")
            add_string(bitmap, "wrap_mode", mode, sampler->place);
        const Element* filter = child(*sampler, "magfilter");
        if (filter && trimmed_text(*filter) == "NEAREST") add_string(bitmap, "filter_type", "nearest", filter->place);
    }
    warn_of_placement(texture, import);
    return bitmap;
}

}  // namespace neumann::reader::collada
