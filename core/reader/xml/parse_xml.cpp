#include "core/reader/xml/parse_xml.h"

#include "core/reader/xml/source_text.h"

#include <fmt/format.h>
#include <pugixml.hpp>

namespace neumann::reader {

namespace {

Element element_of(const SourceText& source, pugi::xml_node node, int depth) {
    const auto offset = static_cast<std::size_t>(node.offset_debug());
    Element e;
    e.tag = node.name();
    e.place = source.place(offset - 1);
    int index = 0;
    for (const pugi::xml_attribute a : node.attributes())
        e.attributes.push_back({a.name(), a.value(), source.attribute_place(offset, index++)});
    for (const pugi::xml_node child : node.children()) {
        if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata) {
            if (!e.text.empty()) e.text += '\n';
            e.text += child.value();
        } else if (child.type() == pugi::node_element && depth <= max_element_depth) {
            e.children.push_back(element_of(source, child, depth + 1));
        }
    }
    return e;
}

}  // namespace

Element parse_xml(const std::string& path) {
    const SourceText source(path);
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
    return element_of(source, root, 0);
}

}  // namespace neumann::reader
