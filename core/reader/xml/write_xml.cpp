#include "core/reader/xml/write_xml.h"

#include <sstream>

#include <pugixml.hpp>

namespace neumann::reader {

namespace {

void append(pugi::xml_node parent, const Element& e) {
    pugi::xml_node node = parent.append_child(e.tag.c_str());
    for (const Attribute& a : e.attributes) {
        std::string value;
        for (const char c : a.value) value += c == '$' ? "\\$" : std::string(1, c);
        node.append_attribute(a.name.c_str()) = value.c_str();
    }
    for (const Element& child : e.children) append(node, child);
}

}  // namespace

std::string write_xml(const Element& root) {
    pugi::xml_document document;
    pugi::xml_node declaration = document.append_child(pugi::node_declaration);
    declaration.append_attribute("version") = "1.0";
    declaration.append_attribute("encoding") = "utf-8";
    append(document, root);
    std::ostringstream text;
    document.save(text, "    ", pugi::format_default, pugi::encoding_utf8);
    return text.str();
}

}  // namespace neumann::reader
