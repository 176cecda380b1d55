#include "core/reader/formats/collada/nodes.h"

#include "core/reader/formats/collada/texts.h"
#include "core/reader/xml/parse_xml.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace neumann::reader::collada {

namespace {

constexpr std::size_t most_instances = std::size_t{1} << 18;

const std::array<std::string, 14> parts_of_node = {"asset",
                                                   "extra",
                                                   "instance_camera",
                                                   "instance_controller",
                                                   "instance_geometry",
                                                   "instance_light",
                                                   "instance_node",
                                                   "lookat",
                                                   "matrix",
                                                   "node",
                                                   "rotate",
                                                   "scale",
                                                   "skew",
                                                   "translate"};

// Counts the depth of nesting.
class Deeper {
public:
    explicit Deeper(int& depth) : depth_(++depth) {}
    ~Deeper() { --depth_; }
    Deeper(const Deeper&) = delete;
    Deeper& operator=(const Deeper&) = delete;

private:
    int& depth_;
};

class NodeReader {
public:
    NodeReader(const File& file, Warnings& warnings, Problems& problems) : file_(file), warnings_(warnings), problems_(problems) {}

    void read(const Element& node, Instance around) {
        const Deeper deeper(depth_);
        if (depth_ > max_element_depth)
            throw InputError(node.place, fmt::format("nodes and instances of nodes are nested more than {} deep, or stand inside "
                                                     "themselves",
                                                     max_element_depth));
        if (++visited_ > most_instances)
            throw InputError(node.place, fmt::format("there are more than {} nodes and instances of nodes", most_instances));
        if (checked_.insert(&node).second) check_children(node, parts_of_node, problems_);
        try {
            around.to_world = around.to_world * read_transforms(node);
        } catch (const InputError& problem) {
            around.is_placed = false;
            // In a file of a course the camera's view may be found without its place (course_direction()).
            if (!holds_only_a_camera(node) || !file_.is_of_course()) problems_.add(problem, node.place);
        }
        around.node = &node;
        for (const Element& e : node.children) {
            if (e.tag == "node") read(e, around);
            if (e.tag == "instance_node") problems_.attempt(e.place, [&] { read_instance_node(e, around); });
            if (e.tag == "instance_controller") problems_.attempt(e.place, [&] { take_unbent(e, around); });
            if (e.tag == "instance_geometry") add(nodes.geometries, e, "geometry", around);
            if (e.tag == "instance_light") add(nodes.lights, e, "light", around);
            if (e.tag == "instance_camera") add(nodes.cameras, e, "camera", around);
        }
    }

    SceneNodes nodes;

private:
    static bool holds_only_a_camera(const Element& node) {
        return child(node, "instance_camera") && !child(node, "node") && !child(node, "instance_node") &&
               !child(node, "instance_geometry") && !child(node, "instance_light");
    }

    void add(std::vector<Instance>& list, const Element& use, const std::string& tag, Instance around) {
        problems_.attempt(use.place, [&] {
            around.use = &use;
            const Attribute& url = required_attribute(use, "url");
            // The course's program leaves out a light that the file does not have.
            if (tag == "light" && file_.is_of_course() && url.value.starts_with('#') && !file_.known(url.value.substr(1), tag)) {
                warnings_.add(fmt::format("the light '{}', which the file does not have, is left out, as in the course's program",
                                          url.value.substr(1)));
                return;
            }
            around.element = &file_.find(url, tag);
            list.push_back(around);
        });
    }

    // A lenient reader takes the mesh of a skin as it was bound to its joints, and leaves out a morph.
    void take_unbent(const Element& use, Instance around) {
        const auto fail = [&](const std::string& instead) {
            return Unknown(use.place, "<instance_controller> is not supported",
                           ": a skin or morph of a mesh; expected the posed mesh, exported as <instance_geometry>", instead);
        };
        if (!problems_.lenient()) throw fail("");
        const auto known = [&](const Attribute& url, const char* tag) {
            return file_.known(url.value.substr(url.value.starts_with('#') ? 1 : 0), tag);
        };
        const Element* controller = known(required_attribute(use, "url"), "controller");
        const Element* skin = controller ? child(*controller, "skin") : nullptr;
        const Attribute* source = skin ? skin->find("source") : nullptr;
        if (!source || !known(*source, "geometry")) throw fail("left out");
        problems_.replace(fail("its mesh is taken unbent"), use.place);
        if (const Element* bound = child(*skin, "bind_shape_matrix")) around.to_world = around.to_world * read_matrix(*bound);
        around.use = &use;
        around.element = &file_.find(*source, "geometry");
        nodes.geometries.push_back(around);
    }

    void read_instance_node(const Element& e, const Instance& around) {
        read(file_.find(required_attribute(e, "url"), "node"), around);
    }

    const File& file_;
    Warnings& warnings_;
    Problems& problems_;
    std::set<const Element*> checked_;
    int depth_ = 0;
    std::size_t visited_ = 0;
};

}  // namespace

SceneNodes read_nodes(const File& file, Warnings& warnings, Problems& problems) {
    const Element& use = required_child(required_child(file.root(), "scene"), "instance_visual_scene");
    const Element& scene = file.find(required_attribute(use, "url"), "visual_scene");
    static const std::array<std::string, 4> known = {"asset", "evaluate_scene", "extra", "node"};
    check_children(scene, known, problems);
    NodeReader reader(file, warnings, problems);
    for (const Element& node : scene.children)
        if (node.tag == "node") reader.read(node, {nullptr, nullptr, Mat4(1.0), &node});
    return std::move(reader.nodes);
}

}  // namespace neumann::reader::collada
