#include "core/reader/xml/document.h"

#include "core/base/printable.h"
#include "core/reader/xml/definitions.h"
#include "core/reader/xml/grammar.h"
#include "core/reader/xml/numbers.h"
#include "core/reader/xml/parse_xml.h"
#include "core/reader/xml/spectra.h"
#include "core/reader/xml/upgrade.h"

#include <algorithm>
#include <charconv>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace neumann::reader {

namespace fs = std::filesystem;

namespace {

constexpr int max_include_depth = 15;  // as in Mitsuba

class Loader {
public:
    Loader(Document& document, const std::map<std::string, std::string>& definitions, Warnings& warnings, Problems& problems)
        : document_(document), definitions_(definitions), warnings_(warnings), problems_(problems) {}

    void read_main(RawScene scene, bool optional) {
        const std::string path = scene.files.front();
        document_.folders.push_back(fs::path(path).parent_path().string());
        document_.files = std::move(scene.files);
        document_.in_memory = std::move(scene.in_memory);
        for (const std::string& name : scene.used) definitions_.use(name);
        refuse_other_programs(scene.root);
        document_.root = read_file(path, scene.root);
        if (document_.root.tag != "scene")
            throw InputError(document_.root.place,
                             fmt::format("the outermost element is <{}>, expected <scene>", document_.root.tag));
        if (!optional && !dropped_) problems_.attempt({path, 0, 0}, [&] { definitions_.check_used(path); });
    }

private:
    // Refuses scenes of other programs that are XML, too.
    static void refuse_other_programs(const Element& root) {
        const auto has = [&](const char* tag) {
            return std::ranges::any_of(root.children, [&](const Element& e) { return e.tag == tag; });
        };
        if (root.tag == "scene" && !root.find("version") && (has("camera") || has("mesh")))
            throw InputError(
                root.place,
                "this looks like a scene of Nori, expected one of Mitsuba: <scene version=\"3.0.0\">, with <sensor> in "
                "place of <camera>, <shape> of <mesh>, and <rgb> of <color>");
    }
    // Reads the elements of a file.
    Element read_file(const std::string& path, const Element& root);
    Element read_element(const Element& raw, const std::string& parent_tag, int depth);
    void read_children(const Element& raw, Element& parent, int depth);
    // Executes elements such as <include>; all others become children of `parent`.
    void place(Element e, Element& parent);
    void add_default(const Element& e);
    void add_folder(const Element& e);
    void include(const Element& e, Element& parent);
    // Reads an element, or returns nothing if a lenient reader leaves it out.
    std::optional<Element> read_child(const Element& raw, const Element& parent, int depth);
    // Notes that an element and its contents are not in the document.
    void lose(const Element& raw);
    // Puts a broken element in place of one that cannot be read, with its contents.
    void drop(const Element& raw, Element& parent);
    // Calls f; if it throws InputError, the problem is recorded and the element marked as broken.
    template <class F>
    void attempt(Element& e, F&& f) {
        if (!problems_.attempt(e.place, f)) e.broken = true;
    }
    // The first number of a version.
    static int version_of(const Attribute& version);

    Document& document_;
    Definitions definitions_;
    Warnings& warnings_;
    Problems& problems_;
    // The state of the file being read.
    struct Reading {
        std::vector<std::string> files;  // the chain of includes: each file is included by the one before
        int version = 3;
        bool is_old() const { return version < 2; }
        // The search path for the folder of a <path>, as in Mitsuba: the folders of the file's <path>s, the last first, then the
        // file's own folder, then the search path of the including file.
        std::vector<std::string> search;
    };
    Reading reading_;
    bool dropped_ = false;  // elements were dropped unread, and they may have used definitions
};

Element Loader::read_file(const std::string& path, const Element& root) {
    reading_.files.push_back(path);
    reading_.search.insert(reading_.search.begin(), fs::path(path).parent_path().string());
    return read_element(root, "", 0);
}

Element Loader::read_element(const Element& raw, const std::string& parent_tag, int depth) {
    Element e{raw.tag, raw.attributes, {}, raw.place};
    if (depth > max_element_depth)
        throw InputError(e.place, fmt::format("elements are nested more than {} deep", max_element_depth));
    if (reading_.is_old() && !parent_tag.empty()) upgrade_tag(e, warnings_);
    take_textures_apart(e);
    if (!parent_tag.empty()) check_place(e, parent_tag);
    if (parent_tag.empty() && e.tag != "scene" && !is_object(e.tag))
        throw InputError(e.place, fmt::format("the outermost element is <{}>, expected <scene>", e.tag));
    if (const Attribute* version = parent_tag.empty() ? e.find("version") : nullptr) {
        reading_.version = version_of(*version);
        // An included file may hold a single object, which then carries the version.
        if (e.tag != "scene") e.attributes.erase(e.attributes.begin() + (version - e.attributes.data()));
    }
    if (parent_tag.empty())
        check_attributes(e);
    else
        attempt(e, [&] { check_attributes(e); });
    for (Attribute& a : e.attributes) attempt(e, [&] { definitions_.substitute(a); });
    read_children(raw, e, depth);
    if (reading_.is_old()) attempt(e, [&] { upgrade_parameters(e, warnings_); });
    if (reading_.version < 3) upgrade_from_2(e);
    if (e.tag == "spectrum" && !e.broken) attempt(e, [&] { write_out_spectrum(e, parent_tag, document_, problems_); });
    return e;
}

void Loader::read_children(const Element& raw, Element& parent, int depth) {
    if (!raw.text.empty())
        problems_.add(InputError(parent.place, fmt::format("<{}> contains the text '{}', expected elements only", parent.tag,
                                                           glimpse_of(join(split(raw.text))))),
                      parent.place);
    for (const Element& child : raw.children) {
        const bool is_right = problems_.attempt(parent.place, [&] {
            if (std::optional<Element> e = read_child(child, parent, depth + 1)) place(std::move(*e), parent);
        });
        if (!is_right) drop(child, parent);
    }
}

std::optional<Element> Loader::read_child(const Element& raw, const Element& parent, int depth) {
    try {
        return read_element(raw, parent.tag, depth);
    } catch (const Unknown& unknown) {
        problems_.replace(unknown, parent.place);
        lose(raw);
        return std::nullopt;
    }
}

void Loader::place(Element e, Element& parent) {
    if (e.tag == "default") {
        attempt(e, [&] { add_default(e); });
        const Attribute* name = e.find("name");
        if (e.broken) definitions_.lose_default(name ? name->value : "");
    } else if (e.tag == "path") {
        attempt(e, [&] { add_folder(e); });
        document_.lost_folder = document_.lost_folder || e.broken;
    } else if (e.tag == "include") {
        const Reading outer = reading_;
        attempt(e, [&] { include(e, parent); });
        reading_ = outer;
        if (e.broken) {
            document_.lost.others = dropped_ = true;
            parent.children.push_back(std::move(e));
        }
    } else {
        // A parameter with a broken part is broken.
        if (e.broken && !is_object(parent.tag) && parent.tag != "scene") parent.broken = true;
        parent.children.push_back(std::move(e));
    }
}

void Loader::add_default(const Element& e) {
    if (e.broken) return;
    const Attribute& name = e.attribute("name");
    if (name.value.empty()) throw InputError(name.place, "the name of a <default> is empty");
    definitions_.add_default(name.value, e.attribute("value").value);
}

void Loader::add_folder(const Element& e) {
    if (e.broken) return;
    const Attribute& value = e.attribute("value");
    std::vector<std::string> tried;
    for (const std::string& folder : reading_.search) {
        const std::string path = (fs::path(folder) / value.value).string();
        std::error_code error;
        if (fs::is_directory(path, error)) {
            reading_.search.insert(reading_.search.begin(), path);
            document_.folders.insert(document_.folders.begin(), path);
            return;
        }
        if (std::find(tried.begin(), tried.end(), path) == tried.end()) tried.push_back(path);
    }
    throw InputError(value.place, fmt::format("there is no folder '{}'", fmt::join(tried, "' or '")));
}

void Loader::lose(const Element& raw) {
    if (const Attribute* id = raw.find("id")) document_.lost.ids.insert(id->value);
    for (const Element& child : raw.children) lose(child);
    dropped_ = true;
}

void Loader::drop(const Element& raw, Element& parent) {
    lose(raw);
    parent.broken = parent.broken || (!is_object(parent.tag) && parent.tag != "scene");
    Element e;  // without a tag
    e.place = parent.place;
    e.broken = true;
    parent.children.push_back(std::move(e));
}

void Loader::include(const Element& e, Element& parent) {
    if (e.broken) return;
    const Attribute& name = e.attribute("filename");
    const std::string path = document_.find_file(name);
    const std::vector<std::string>& open = reading_.files;
    for (std::size_t i = 0; i < open.size(); ++i) {
        std::error_code error;
        if (!fs::equivalent(open[i], path, error)) continue;
        std::string cycle;
        for (std::size_t j = i; j < open.size(); ++j) cycle += open[j] + " includes ";
        throw InputError(name.place, fmt::format("include cycle: {}{}", cycle, path));
    }
    if (open.size() > max_include_depth)
        throw InputError(name.place, fmt::format("includes are nested more than {} deep", max_include_depth));
    document_.files.push_back(path);
    const Element raw = parse_xml(path);
    Element root = read_file(path, raw);
    if (root.tag == "scene") {
        for (Element& child : root.children) {
            // A broken element may have an unknown tag; its problem is already reported.
            if (!child.broken) attempt(child, [&] { check_place(child, parent.tag); });
            parent.children.push_back(std::move(child));
        }
    } else {
        check_place(root, parent.tag);
        parent.children.push_back(std::move(root));
    }
}

int Loader::version_of(const Attribute& version) {
    const std::string& text = version.value;
    int numbers[3] = {0, 0, 0}, count = 0;
    const char *at = text.data(), *end = at + text.size();
    while (count < 3) {
        const auto [next, error] = std::from_chars(at, end, numbers[count]);
        if (error != std::errc() || numbers[count] < 0) break;
        at = next;
        if (++count == 3 || at == end || *at != '.') break;
        ++at;
    }
    if (count == 0 || at != end || text.ends_with('.'))
        throw InputError(version.place, fmt::format("'{}' is not a version, expected for example 3.0.0", text));
    if ((numbers[0] == 0 && numbers[1] < 4) || numbers[0] > 3)
        throw InputError(version.place, fmt::format("scene version {} is not known, expected 0.4 to 3.x", text));
    return numbers[0];
}

}  // namespace

std::string Document::find_file(const Attribute& name) const {
    std::vector<std::string> places = folders;
    places.push_back(fs::path(name.place.file).parent_path().string());
    for (const std::string& folder : places) {
        const fs::path path = fs::path(folder) / name.value;  // an absolute name stays as it is
        std::error_code error;
        if (!name.value.empty() && fs::exists(path, error) && !fs::is_directory(path, error)) return path.string();
    }
    std::vector<std::string> shown;
    for (const std::string& folder : places) {
        const std::string text = folder.empty() ? "." : folder;
        if (std::find(shown.begin(), shown.end(), text) == shown.end()) shown.push_back(text);
    }
    if (lost_folder) throw AlreadyReported();
    throw InputError(name.place, fmt::format("there is no file '{}'; looked in: {}", name.value, join(shown)));
}

Document read_document(RawScene scene, const std::map<std::string, std::string>& definitions, Warnings& warnings,
                       Problems& problems, bool optional) {
    Document document;
    Loader(document, definitions, warnings, problems).read_main(std::move(scene), optional);
    return document;
}

}  // namespace neumann::reader
