#include "core/reader/plugins/read_shapes.h"

#include "core/geometry/transformed.h"
#include "core/reader/xml/properties.h"

#include <algorithm>
#include <deque>
#include <limits>
#include <memory>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

namespace neumann::reader {

namespace {

// Groups of up to this many triangles in all are copied: copies are faster to trace and can be cut into patches.
constexpr double most_copied_triangles = 1e6;

struct Reading {
    const Element* element;
    bool in_group = false;
    ReadShape shape = {};
    Warnings warnings = {};
    std::vector<std::string> mesh_files = {};
    TextureStore textures = {};
    bool is_right = false;
};

// One top-level shape, group or instance of the file.
struct Item {
    const Element* element;
    Reading* shape = nullptr;        // for a shape
    const Element* group = nullptr;  // for a group or an instance
    Mat4 to_world{1.0};
    Location place_of_to_world = {};
};

const std::string& type_of(const Element& e) { return e.attribute("type").value; }

double triangle_count(const Shape& shape) {
    const TriangleMesh* mesh = mesh_of(shape);
    return mesh ? static_cast<double>(mesh->triangles.size()) : 1.0;
}

bool has_finite_vertices(const Shape& shape) {
    if (const auto* instance = std::get_if<MeshInstance>(&shape))
        return is_finite(instance->bounds().low) && is_finite(instance->bounds().high);
    const auto* mesh = std::get_if<TriangleMesh>(&shape);
    return !mesh || std::all_of(mesh->vertices.begin(), mesh->vertices.end(), [](const Vec3& v) { return is_finite(v); });
}

void release_spare(Shape& shape) {
    if (auto* mesh = std::get_if<TriangleMesh>(&shape)) {
        mesh->vertices.shrink_to_fit();
        mesh->triangles.shrink_to_fit();
        mesh->normals.shrink_to_fit();
        mesh->uv.shrink_to_fit();
    }
}

class ShapesReader {
public:
    ShapesReader(const Element& root, const Context& context) : context_(context) {
        for (const Element& e : root.children) {
            if (e.tag != "shape") continue;
            context.problems().attempt(e.place, [&] {
                for (const Element* shape : without_merge(e)) {
                    Item item{shape};
                    if (context.problems().attempt(shape->place, [&] { plan(item); })) items_.push_back(item);
                }
            });
        }
    }

    void read() {
        oneapi::tbb::parallel_for(std::size_t{0}, readings_.size(), [&](std::size_t i) {
            Reading& reading = readings_[i];
            reading.is_right = context_.problems().attempt(reading.element->place, [&] { read(reading); });
        });
    }

    void hand_out(const std::function<void(ReadShape)>& take) {
        share_meshes();
        for (Item& item : items_) {
            if (item.shape) {
                if (!item.shape->is_right) continue;
                finish(*item.shape);
                take(std::move(item.shape->shape));
                continue;
            }
            Group& group = groups_.at(item.group);
            std::erase_if(group.shapes, [](const Reading* reading) { return !reading->is_right; });
            if (!group.is_finished)
                for (Reading* reading : group.shapes) finish(*reading);
            group.is_finished = true;
            if (item.group != item.element) context_.problems().attempt(item.element->place, [&] { expand(item, group, take); });
        }
    }

private:
    struct Group {
        std::vector<Reading*> shapes;
        int instances = 0;
        bool is_finished = false;
    };

    // The shape itself, or the shapes inside it.
    std::vector<const Element*> without_merge(const Element& e) const {
        if (type_of(e) != "merge") return {&e};
        Properties p(e, context_.objects);
        std::vector<const Element*> shapes = p.nested("shape", std::numeric_limits<std::size_t>::max());
        p.refuse_rest();
        if (shapes.empty()) p.fail_empty("shape 'merge' has no <shape> inside, expected at least one");
        for (const Element* shape : shapes)
            if (type_of(*shape) == "merge") throw InputError(e.place, "shape 'merge' stands inside another one");
        return shapes;
    }

    void plan(Item& item) {
        const Element& e = *item.element;
        if (type_of(e) == "shapegroup") {
            item.group = &e;
            add_group(e);
        } else if (type_of(e) == "instance") {
            Properties p(e, context_.objects);
            item.to_world = p.transform("to_world");
            const Element* to_world = p.find("to_world", {"transform"});
            item.place_of_to_world = (to_world ? *to_world : e).place;
            const std::vector<const Element*> groups = p.nested("shape");
            p.refuse_rest();
            if (groups.empty()) p.fail_empty("shape 'instance' has no shapegroup inside, expected one");
            item.group = groups.front();
            if (type_of(*item.group) != "shapegroup")
                throw InputError(e.place, fmt::format("instance of a shape '{}', expected a shapegroup", type_of(*item.group)));
            add_group(*item.group);
        } else {
            readings_.push_back({&e});
            item.shape = &readings_.back();
        }
    }

    void add_group(const Element& e) {
        const auto [group, is_new] = groups_.try_emplace(&e);
        if (!is_new) return;
        Properties p(e, context_.objects);
        std::vector<const Element*> shapes;
        for (const Element* shape : p.nested("shape", std::numeric_limits<std::size_t>::max()))
            for (const Element* inner : without_merge(*shape)) shapes.push_back(inner);
        p.refuse_rest();
        if (shapes.empty()) p.fail_empty("shape 'shapegroup' has no <shape> inside, expected at least one");
        for (const Element* shape : shapes) {
            if (const std::string& type = type_of(*shape); type == "shapegroup" || type == "instance") {
                context_.problems().add(
                    InputError(shape->place, fmt::format("shape '{}' in a shapegroup: groups cannot be nested", type)),
                    shape->place);
                continue;
            }
            readings_.push_back({shape, true});
            group->second.shapes.push_back(&readings_.back());
        }
    }

    void read(Reading& reading) const {
        const Context own{context_.document, context_.objects, reading.warnings, reading.mesh_files, reading.textures};
        reading.shape = read_shape(*reading.element, own);
        if (reading.in_group && reading.shape.emitter)
            throw InputError(reading.shape.emitter->place, "emitter in a shapegroup: what emits cannot be instanced");
        if (reading.in_group && reading.shape.sensor)
            throw InputError(reading.shape.sensor->place, "sensor in a shapegroup: what measures cannot be instanced");
        release_spare(reading.shape.shape);
    }

    void finish(const Reading& reading) {
        for (const auto& [text, count] : reading.warnings.counts()) context_.warnings.add(text, count);
        for (const std::string& file : reading.mesh_files)
            if (known_files_.insert(file).second) context_.mesh_files.push_back(file);
        for (const auto& [name, range] : reading.textures.attributes) context_.textures.widen(name, range);
    }

    static bool is_instance(const Item& item) { return item.group && item.group != item.element; }

    // Shares the meshes of groups with several instances, unless there are few triangles to copy.
    void share_meshes() {
        double triangles = 0.0;
        for (const Item& item : items_) {
            if (!is_instance(item)) continue;
            Group& group = groups_.at(item.group);
            ++group.instances;
            for (const Reading* reading : group.shapes) triangles += triangle_count(reading->shape.shape);
        }
        if (triangles <= most_copied_triangles) return;
        for (auto& [element, group] : groups_)
            if (group.instances > 1)
                for (Reading* reading : group.shapes) share(reading->shape.shape);
    }

    static void share(Shape& shape) {
        if (auto* mesh = std::get_if<TriangleMesh>(&shape))
            shape = MeshInstance(std::make_shared<const SharedMesh>(std::move(*mesh)), Mat4(1.0));
    }

    void expand(const Item& item, const Group& group, const std::function<void(ReadShape)>& take) {
        for (const Reading* reading : group.shapes) {
            const ReadShape& shape = reading->shape;
            std::optional<Shape> placed = transformed(shape.shape, item.to_world);
            if (!placed)
                throw InputError(item.place_of_to_world,
                                 fmt::format("to_world of shape 'instance' makes the {} at {} another shape, which only meshes can "
                                             "become; expected a uniform scale, rotations and translations",
                                             type_of(*reading->element), to_string(reading->element->place)));
            if (!has_finite_vertices(*placed))
                throw InputError(item.place_of_to_world, "to_world of shape 'instance' moves a shape out of the range of numbers");
            take({std::move(*placed), shape.bsdf, nullptr, nullptr, shape.element});
        }
    }

    const Context& context_;
    std::vector<Item> items_;
    std::deque<Reading> readings_;  // in the order in which hand_out() comes to them
    std::map<const Element*, Group> groups_;
    std::set<std::string> known_files_;
};

}  // namespace

void read_shapes(const Element& root, const Context& context, const std::function<void(ReadShape)>& take) {
    ShapesReader reader(root, context);
    reader.read();
    reader.hand_out(take);
}

}  // namespace neumann::reader
