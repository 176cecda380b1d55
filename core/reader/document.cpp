#include "core/reader/document.h"

#include "core/reader/definitions.h"
#include "core/reader/grammar.h"
#include "core/reader/numbers.h"
#include "core/reader/source_text.h"

#include <algorithm>
#include <charconv>
#include <filesystem>

#include <fmt/format.h>
#include <pugixml.hpp>

namespace neumann::reader {

namespace fs = std::filesystem;

namespace {

constexpr int max_include_depth = 15;  // as Mitsuba
constexpr int max_element_depth = 100;

class Loader {
public:
    Loader(Document& document, const std::map<std::string, std::string>& definitions)
        : document_(document), definitions_(definitions) {}

    void read_main(const std::string& path, bool optional) {
        document_.folders.push_back(fs::path(path).parent_path().string());
        document_.root = read_file(path);
        if (document_.root.tag != "scene")
            throw InputError(document_.root.place,
                             fmt::format("the outermost element is <{}>, expected <scene>", document_.root.tag));
        if (!optional) definitions_.check_used(path);
    }

private:
    Element read_file(const std::string& path);
    Element read_element(const SourceText& source, pugi::xml_node node, const std::string& parent_tag, int depth);
    void read_children(const SourceText& source, pugi::xml_node node, Element& parent, int depth);
    void include(const Element& e, Element& parent);
    void check_version(const Attribute& version);

    Document& document_;
    Definitions definitions_;
    std::vector<std::string> open_files_;  // each included by the one before
};

Element Loader::read_file(const std::string& path) {
    const SourceText source(path);
    document_.files.push_back(path);
    open_files_.push_back(path);
    pugi::xml_document xml;
    const pugi::xml_parse_result result =
        xml.load_buffer(source.text().data(), source.text().size(), pugi::parse_default, pugi::encoding_utf8);
    if (!result)
        throw InputError(source.place(static_cast<std::size_t>(result.offset)),
                         fmt::format("broken XML: {}", result.description()));
    pugi::xml_node root;
    for (const pugi::xml_node node : xml.children()) {
        if (node.type() != pugi::node_element) continue;
        if (root)
            throw InputError(source.place(static_cast<std::size_t>(node.offset_debug()) - 1),
                             fmt::format("a second outermost element <{}>, expected the end of the file", node.name()));
        root = node;
    }
    Element element = read_element(source, root, "", 0);
    open_files_.pop_back();
    return element;
}

Element Loader::read_element(const SourceText& source, pugi::xml_node node, const std::string& parent_tag, int depth) {
    const auto offset = static_cast<std::size_t>(node.offset_debug());
    Element e;
    e.tag = node.name();
    e.place = source.place(offset - 1);
    if (depth > max_element_depth)
        throw InputError(e.place, fmt::format("elements are nested more than {} deep", max_element_depth));
    int index = 0;
    for (const pugi::xml_attribute a : node.attributes())
        e.attributes.push_back({a.name(), a.value(), source.attribute_place(offset, index++)});

    if (!parent_tag.empty()) check_place(e, parent_tag);
    if (parent_tag.empty() && e.tag != "scene" && !is_object(e.tag))
        throw InputError(e.place, fmt::format("the outermost element is <{}>, expected <scene>", e.tag));
    if (const Attribute* version = parent_tag.empty() ? e.find("version") : nullptr) {
        check_version(*version);
        // An included file may hold a single object, which then carries the version.
        if (e.tag != "scene") e.attributes.erase(e.attributes.begin() + (version - e.attributes.data()));
    }
    check_attributes(e);
    for (Attribute& a : e.attributes) definitions_.substitute(a);
    read_children(source, node, e, depth);
    return e;
}

void Loader::read_children(const SourceText& source, pugi::xml_node node, Element& parent, int depth) {
    for (const pugi::xml_node child : node.children()) {
        if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata)
            throw InputError(parent.place, fmt::format("<{}> contains the text '{}', expected elements only", parent.tag,
                                                       join(split(child.value()))));
        if (child.type() != pugi::node_element) continue;
        Element e = read_element(source, child, parent.tag, depth + 1);
        if (e.tag == "default") {
            const Attribute& name = e.attribute("name");
            if (name.value.empty()) throw InputError(name.place, "the name of a <default> is empty");
            definitions_.add_default(name.value, e.attribute("value").value);
        } else if (e.tag == "path") {
            const Attribute& value = e.attribute("value");
            const fs::path folder = fs::path(value.place.file).parent_path() / value.value;
            std::error_code error;
            if (!fs::is_directory(folder, error))
                throw InputError(value.place, fmt::format("there is no folder '{}'", folder.string()));
            document_.folders.push_back(folder.string());
        } else if (e.tag == "include") {
            include(e, parent);
        } else {
            parent.children.push_back(std::move(e));
        }
    }
}

void Loader::include(const Element& e, Element& parent) {
    const Attribute& name = e.attribute("filename");
    const std::string path = document_.find_file(name);
    for (std::size_t i = 0; i < open_files_.size(); ++i) {
        std::error_code error;
        if (!fs::equivalent(open_files_[i], path, error)) continue;
        std::string cycle;
        for (std::size_t j = i; j < open_files_.size(); ++j) cycle += open_files_[j] + " includes ";
        throw InputError(name.place, fmt::format("include cycle: {}{}", cycle, path));
    }
    if (open_files_.size() > max_include_depth)
        throw InputError(name.place, fmt::format("includes are nested more than {} deep", max_include_depth));
    Element root = read_file(path);
    if (root.tag == "scene") {
        for (Element& child : root.children) {
            check_place(child, parent.tag);
            parent.children.push_back(std::move(child));
        }
    } else {
        check_place(root, parent.tag);
        parent.children.push_back(std::move(root));
    }
}

void Loader::check_version(const Attribute& version) {
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
    if (numbers[0] < 2)
        throw InputError(version.place,
                         fmt::format("scene version {} is not read yet, expected 2.0.0 or above; a later version of neumann will "
                                     "upgrade such files",
                                     text));
    if (numbers[0] > 3) throw InputError(version.place, fmt::format("scene version {} is not known, expected 2.x or 3.x", text));
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
    throw InputError(name.place, fmt::format("there is no file '{}'; looked in: {}", name.value, join(shown)));
}

Document read_document(const std::string& path, const std::map<std::string, std::string>& definitions, bool optional) {
    Document document;
    Loader(document, definitions).read_main(path, optional);
    return document;
}

}  // namespace neumann::reader
