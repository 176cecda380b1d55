#include "tests/search/shrink.h"

#include <fmt/format.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace neumann::search {

namespace {

using Node = pugi::xml_node;

// All elements below the outermost one, those that hold others first.
std::vector<Node> elements(const pugi::xml_document& scene) {
    std::vector<Node> found;
    for (const pugi::xpath_node& node : scene.select_nodes("/scene//*")) found.push_back(node.node());
    return found;
}

// Numbers, one or several with commas between.
std::vector<double> numbers(const std::string& text) {
    std::vector<double> found;
    std::istringstream in(text);
    for (std::string part; std::getline(in, part, ',');) {
        std::size_t end = 0;
        try {
            found.push_back(std::stod(part, &end));
        } catch (const std::exception&) {
            return {};
        }
        if (part.find_first_not_of(' ', end) != part.npos) return {};
    }
    return found;
}

std::string with_each(const std::vector<double>& values, const std::function<double(double)>& f) {
    std::string text;
    for (const double value : values) text += fmt::format("{}{}", text.empty() ? "" : ", ", f(value) + 0.0);
    return text;
}

std::vector<std::string> rounder(const std::string& text) {
    const std::vector<double> values = numbers(text);
    if (values.empty()) return {};
    const auto digits = [&](double scale) { return with_each(values, [&](double x) { return std::round(x * scale) / scale; }); };
    std::vector<std::string> all{fmt::format("{}", values.front() == 0.0 ? 0 : 1),
                                 with_each(values, [](double x) { return x == 0.0 ? 0.0 : 1.0; }), digits(1.0), digits(2.0),
                                 digits(10.0)};
    // Only what is shorter, so that there is an end.
    std::erase_if(all, [&](const std::string& t) { return t.size() >= text.size(); });
    return all;
}

using Change = std::function<bool(Node)>;  // false if there is nothing to change

bool put_inner_in_place(Node node) {
    for (Node inner : node.children())
        if (std::string(inner.name()) == node.name()) {
            Node copy = node.parent().insert_copy_after(inner, node);
            if (const auto name = node.attribute("name")) {
                if (!copy.attribute("name")) copy.append_attribute("name");
                copy.attribute("name") = name.value();
            }
            return node.parent().remove_child(node);
        }
    return false;
}

bool make_plain(Node node) {
    const std::string tag = node.name(), type = node.attribute("type").value();
    const char* plain = tag == "bsdf"      ? "diffuse"
                        : tag == "shape"   ? "rectangle"
                        : tag == "sensor"  ? "perspective"
                        : tag == "rfilter" ? "box"
                                           : nullptr;
    if (!plain || type == plain) return false;
    node.attribute("type") = plain;
    if (tag == "bsdf") node.remove_children();
    for (const char* own : {"filename", "face_normals", "aperture_radius", "focus_distance"})
        if (Node child = node.find_child_by_attribute("name", own)) node.remove_child(child);
    return true;
}

std::vector<Change> changes() {
    std::vector<Change> all{[](Node node) { return node.parent().remove_child(node); }, put_inner_in_place, make_plain};
    // The attributes of numbers, each by its way to be rounder.
    for (const char* name : {"value", "angle", "origin", "target", "up", "x", "y", "z"})
        for (std::size_t i = 0; i < 5; ++i)
            all.emplace_back([=](Node node) {
                pugi::xml_attribute attribute = node.attribute(name);
                const std::vector<std::string> to = rounder(attribute.value());
                if (i >= to.size()) return false;
                attribute = to[i].c_str();
                return true;
            });
    return all;
}

}  // namespace

void shrink(pugi::xml_document& scene, const std::function<bool(const pugi::xml_document&)>& fails,
            const std::function<bool()>& stop) {
    const std::vector<Change> all = changes();
    for (bool changed = true; changed;) {
        changed = false;
        for (const Change& change : all)
            for (std::size_t i = 0; i < elements(scene).size() && !stop();) {
                pugi::xml_document smaller;
                smaller.reset(scene);
                if (change(elements(smaller)[i]) && fails(smaller)) {
                    scene.reset(smaller);
                    changed = true;
                } else {
                    ++i;
                }
            }
    }
}

}  // namespace neumann::search
