#include "core/reader/formats/collada/cameras.h"

#include "core/reader/formats/collada/spot.h"
#include "core/reader/formats/collada/texts.h"
#include "core/reader/formats/collada/view.h"
#include "core/reader/formats/film.h"
#include "core/reader/formats/make_elements.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

namespace neumann::reader::collada {

namespace {

const std::array<std::string, 2> projections = {"orthographic", "perspective"};
const std::array<std::string, 5> parts_of_perspective = {"aspect_ratio", "xfov", "yfov", "zfar", "znear"};
const std::array<std::string, 5> parts_of_orthographic = {"aspect_ratio", "xmag", "ymag", "zfar", "znear"};

// The sizes along x and y, which are fields of view or magnifications, and the aspect, as far as they are given.
struct Extent {
    std::optional<double> x, y, aspect;
};

std::optional<double> positive(const Element& e, const char* tag) {
    const Element* number = child(e, tag);
    if (!number) return std::nullopt;
    const double value = read_number(*number);
    if (!(value > 0.0)) throw InputError(number->place, fmt::format("<{}> is {}, expected more than 0", tag, value));
    return value;
}

std::optional<double> angle(const Element& e, const char* tag) {
    const std::optional<double> degrees = positive(e, tag);
    if (degrees && *degrees >= 180.0)
        throw InputError(child(e, tag)->place, fmt::format("<{}> is {}, expected less than 180 degrees", tag, *degrees));
    return degrees;
}

// The place of the camera without the node's scale, which would distort the picture.
Mat4 rigid(const Instance& camera, const Import& import) {
    const Mat4& m = camera.to_world;
    Vec3 lengths(length_of(Vec3(m[0])), length_of(Vec3(m[1])), length_of(Vec3(m[2])));
    constexpr double tolerance = 1e-3;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        if (!(lengths[i] > 0.0) || std::abs(glm::dot(Vec3(m[i]) / lengths[i], Vec3(m[j]) / lengths[j])) > tolerance)
            throw InputError(camera.node->place,
                             "the node of the camera shears or has no inverse, expected rotations and translations");
    }
    if (max_component(lengths) > (1.0 + tolerance) * -max_component(-lengths))
        import.warnings.add("the node of the camera scales its axes differently, which is left out");
    return facing_back(m);
}

class CameraAdder {
public:
    CameraAdder(int up, const Import& import) : up_(up), import_(import) {}

    void add(const Instance& camera, const Bounds& scene) {
        sensor_ = make_object("sensor", "perspective", camera.use->place);
        const Element& optics = required_child(required_child(*camera.element, "optics"), "technique_common");
        check_children(optics, projections, import_.problems);
        const Element* perspective = child(optics, "perspective");
        Mat4 to_world = place(camera, scene);
        if (perspective) {
            read_perspective(*perspective);
        } else {
            const double half_width = read_orthographic(required_child(optics, "orthographic"));
            to_world = glm::scale(to_world, Vec3(half_width, half_width, 1.0));
        }
        if (as_in_file_) add_clipping(perspective ? *perspective : required_child(optics, "orthographic"));
        warn_of_shift(*camera.element);
        finish(to_world, camera.node->place);
    }

    void add_default(const Bounds& scene, const Location& place) {
        import_.warnings.add("the file has no camera; the whole scene is seen from the front");
        sensor_ = make_object("sensor", "perspective", place);
        add_float(sensor_, "fov", 50.0, place);
        add_string(sensor_, "fov_axis", "x", place);
        finish(view_of(scene, front(up_), up_), place);
    }

private:
    // In a file of a course the view is that of the course's program, unless -D camera=file asks for the file's.
    Mat4 place(const Instance& camera, const Bounds& scene) {
        const bool of_course = import_.file.is_of_course() && !scene.is_empty() && !asks_for_file();
        if (const std::optional<Vec3> direction = of_course ? course_direction(camera) : std::nullopt) {
            import_.warnings.add(
                camera.is_placed ? "the camera's direction is the file's, and it stands where it sees the whole scene, as in the "
                                   "course's program; -D camera=file takes its place, too"
                                 : "the camera's matrix is broken; the whole scene is seen, as in the course's program");
            return view_of(scene, *direction, up_);
        }
        if (!camera.is_placed) {
            read_transforms(*camera.node);  // throws what is wrong
            throw InputError(camera.node->place, "the camera cannot be placed");
        }
        as_in_file_ = true;
        return rigid(camera, import_);
    }

    bool asks_for_file() const {
        const auto given = import_.definitions.find("camera");
        return given != import_.definitions.end() && given->second == "file";
    }

    void read_perspective(const Element& e) {
        check_children(e, parts_of_perspective, import_.problems);
        const Extent fov{angle(e, "xfov"), angle(e, "yfov"), positive(e, "aspect_ratio")};
        if (!fov.x && !fov.y) throw InputError(e.place, "<perspective> has neither <xfov> nor <yfov>, expected one or both");
        add_float(sensor_, "fov", fov.x ? *fov.x : *fov.y, child(e, fov.x ? "xfov" : "yfov")->place);
        add_string(sensor_, "fov_axis", fov.x ? "x" : "y", e.place);
        const auto extent = [](double degrees) { return std::tan(0.5 * glm::radians(degrees)); };
        if (fov.x && fov.y) aspect_ = extent(*fov.x) / extent(*fov.y);
        use_aspect(e, fov);
    }

    // Returns half the width of what is seen.
    double read_orthographic(const Element& e) {
        check_children(e, parts_of_orthographic, import_.problems);
        sensor_.attributes.front().value = "orthographic";
        const Extent size{positive(e, "xmag"), positive(e, "ymag"), positive(e, "aspect_ratio")};
        if (!size.x && !size.y) throw InputError(e.place, "<orthographic> has neither <xmag> nor <ymag>, expected one or both");
        if (size.x && size.y) aspect_ = *size.x / *size.y;
        use_aspect(e, size);
        return size.x ? *size.x : *size.y * aspect_;
    }

    void use_aspect(const Element& e, const Extent& given) {
        if (!given.aspect) return;
        if (given.x && given.y && std::abs(*given.aspect / aspect_ - 1.0) > 0.01)
            throw InputError(child(e, "aspect_ratio")->place,
                             fmt::format("<aspect_ratio> is {}, but the sizes along x and y make {:.4g}", *given.aspect, aspect_));
        aspect_ = *given.aspect;
    }

    void add_clipping(const Element& e) {
        for (const auto& [tag, name] : {std::pair{"znear", "near_clip"}, std::pair{"zfar", "far_clip"}})
            if (const Element* number = child(e, tag); number && (tag[1] == 'f' || read_number(*number) != 0.0))
                add_float(sensor_, name, read_number(*number), number->place);
    }

    void warn_of_shift(const Element& camera) const {
        const Element* extra = child(camera, "extra");
        const Element* technique = extra ? child(*extra, "technique") : nullptr;
        for (const char* tag : {"shiftx", "shifty"})
            if (const Element* shift = technique ? child(*technique, tag) : nullptr; shift && read_number(*shift) != 0.0)
                import_.warnings.add("the shift of the camera's lens is left out");
    }

    void finish(const Mat4& to_world, const Location& place) {
        Element& root = import_.scene.root;
        add_film(root, sensor_, aspect_, place, import_.definitions);
        Element sampler = make_object("sampler", "multijitter", place);
        add_defined(root, sampler, "integer", "sample_count", "spp", "64", place);
        if (asks_for_file()) {
            import_.scene.used.insert("camera");
            add_matrix(sensor_, "to_world", to_world, place);
        } else {
            add_defined_matrix(root, sensor_, "to_world", "camera", to_world, place);
        }
        reader::add(sensor_, std::move(sampler));
        reader::add(root, std::move(sensor_));
    }

    const int up_;
    const Import& import_;
    Element sensor_;
    double aspect_ = usual_aspect;  // width / height
    bool as_in_file_ = false;       // the camera stands where the file has it, so its clipping distances apply
};

}  // namespace

void add_camera(const std::vector<Instance>& cameras, const Bounds& scene, int up, const Import& import) {
    CameraAdder adder(up, import);
    if (cameras.empty()) {
        const Location& place = import.file.root().place;
        if (scene.is_empty()) throw InputError(place, "the file has no camera, and nothing to be seen");
        adder.add_default(scene, place);
        return;
    }
    if (cameras.size() > 1) import.warnings.add(fmt::format("the first of {} cameras is used", cameras.size()));
    adder.add(cameras.front(), scene);
}

}  // namespace neumann::reader::collada
