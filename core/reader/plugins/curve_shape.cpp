#include "core/reader/plugins/curve_shape.h"

#include "core/base/memory.h"
#include "core/reader/meshes/curves.h"

#include <fmt/format.h>

namespace neumann::reader {

TriangleMesh read_curve_shape(Properties& p, const Context& context) {
    constexpr double bytes_of_triangle = 300.0, part_of_memory = 0.5;  // as for instances
    const bool is_spline = p.element().attribute("type").value == "bsplinecurve";
    const Mat4 to_world = p.transform("to_world");
    const Attribute& filename = p.require("filename", {"string"}).attribute("value");
    const bool flip_normals = p.boolean("flip_normals").value_or(false);
    p.refuse_rest();
    const std::string path = context.document.find_file(filename);
    context.mesh_files.push_back(path);
    TriangleMesh mesh;
    for (Curve& curve : read_curves(path, is_spline ? 4 : 2)) {
        for (ControlPoint& point : curve.points) {
            point.position = Vec3(to_world * glm::dvec4(point.position, 1.0));
            if (!is_finite(point.position)) p.fail("to_world", "moves a point out of the range of numbers");
        }
        if (is_spline)
            add_bspline_tube(mesh, curve, path);
        else
            add_linear_tube(mesh, curve);
        if (static_cast<double>(mesh.triangles.size()) * bytes_of_triangle > part_of_memory * physical_memory())
            throw InputError(
                Location{path, static_cast<int>(curve.line), 1},
                fmt::format("with this curve there are {} triangles of tubes; they need more than half of the machine's "
                            "{:.1f} GiB",
                            mesh.triangles.size(), physical_memory() / 0x1p30));
    }
    if (flip_normals) {
        for (std::array<std::uint32_t, 3>& t : mesh.triangles) std::swap(t[1], t[2]);
        for (Vec3& n : mesh.normals) n = -n;
    }
    return mesh;
}

}  // namespace neumann::reader
