// One colour channel of a scene on patches: its vectors, T, R and K as products and as matrices, the camera, and its shape.
#include "apps/commands/export_command.h"
#include "apps/commands/solve_command.h"
#include "apps/python/module.h"
#include "core/base/error.h"
#include "core/base/interrupt.h"
#include "operators/fields/matrix/camera_vector.h"
#include "operators/fields/matrix/channel_choice.h"
#include "operators/fields/matrix/scene_patches.h"

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

namespace neumann {

namespace {

struct Patched {
    std::shared_ptr<const PatchScene> scene;
    PatchOptions options;
    int channel = 0;

    const TracedSystem& system() const { return scene->traced(); }
};
using Shared = std::shared_ptr<const Patched>;

std::unique_ptr<Job> start_patched(const std::shared_ptr<LoadedScene>& loaded, const Keywords& keywords) {
    SolveRequest request = request_of(solve_options(), *loaded, keywords);
    const std::optional<int> given = channel_number(request.channel);
    return std::make_unique<Job>(request.patches.threads, [loaded, request, given](Job& job) -> Job::Finish {
        job.tell("tracing T");
        auto patched = std::make_shared<Patched>();
        patched->options = request.patches;
        patched->scene = patch_scene(*loaded, request.patches);
        const TracedSystem& system = patched->system();
        patched->channel = system.channels() == 1 ? 0 : given ? *given : most_reflecting_channel(system);
        return [patched] { return py::cast(patched); };
    });
}

py::dict vectors(const Patched& patched) {
    const TracedSystem& system = patched.system();
    const TracedChannel K = system.channel(patched.channel);
    py::dict d;
    d["Le"] = system.emitted(patched.channel);
    d["b"] = system.direct(patched.channel);
    d["measure"] = Vector(K.measure());
    d["reflectance"] = K.reflectance().size() == K.size() ? py::cast(Vector(K.reflectance())) : py::none();
    d["patches"] = patches_table(system.space());
    d["channel"] = system.channel_name(patched.channel);
    d["title"] = patched.scene->title();
    return d;
}

py::dict matrices(const Patched& patched) {
    const TracedSystem& system = patched.system();
    check_matrix_memory(patched.options, system);
    py::dict d;
    d["T"] = transport_matrix(system.table());
    d["R"] = reflection_matrix(system.table(), system.reflection(patched.channel));
    d["ray_measure"] = ray_measures(system.table());
    return d;
}

// An operator that keeps the objects alive to which it refers.
std::shared_ptr<ChannelOperator> kept(const Shared& patched, std::unique_ptr<ChannelOperator> K) {
    const auto both = std::make_shared<std::pair<Shared, std::unique_ptr<ChannelOperator>>>(patched, std::move(K));
    return {both, both->second.get()};
}

Vector reflect(const Patched& patched, const Vector& g) {
    const TracedSystem& system = patched.system();
    if (g.size() != Eigen::Index{system.space().size()})
        throw InputError(fmt::format("x has {} values, expected {}", g.size(), system.space().size()));
    return to_vector(system.reflection(patched.channel)(IncidentVector<1>(g)));
}

std::unique_ptr<Job> start_radius(const std::shared_ptr<Patched>& patched) {
    return std::make_unique<Job>(0, [patched](Job& job) -> Job::Finish {
        job.tell("looking for the spectral radius");
        const ChosenChannel found = choose_channel(patched->system(), patched->channel, {.stop = interrupted});
        return [found] { return py::make_tuple(found.radius, found.no_radius); };
    });
}

std::unique_ptr<Job> start_camera(const std::shared_ptr<Patched>& patched, std::uint32_t samples, std::uint64_t seed) {
    return std::make_unique<Job>(0, [patched, samples, seed](Job& job) -> Job::Finish {
        job.tell("looking through the camera");
        const PatchScene& scene = *patched->scene;
        check_camera(scene.scene());
        const auto matrix = std::make_shared<const Eigen::SparseMatrix<double, Eigen::RowMajor>>(
            camera_matrix(scene.scene(), scene.system().space(), samples, seed));
        return [matrix] { return py::cast(*matrix); };
    });
}

// Corners (n, 4, 3), counter-clockwise as seen from the side, and the row of `patches` that each quadrilateral belongs to.
py::tuple quadrilaterals(const Patched& patched) {
    const PatchSpace& space = patched.system().space();
    std::vector<double> corners;
    std::vector<std::uint32_t> rows;
    for (std::uint32_t f = 0; f < space.facets().size(); ++f) {
        const Facet& facet = space.facets()[f];
        const Vec3 up = space.patches().point(facet.patch, Vec2(0.5)).normal * (facet.front ? 1.0 : -1.0);
        for (std::array<Vec3, 4> q : space.patches().quadrilaterals(facet.patch)) {
            if (glm::dot(glm::cross(q[2] - q[0], q[3] - q[1]), up) < 0.0) std::swap(q[1], q[3]);
            for (const Vec3& p : q) corners.insert(corners.end(), {p.x, p.y, p.z});
            rows.push_back(f);
        }
    }
    const auto n = static_cast<py::ssize_t>(rows.size());
    return py::make_tuple(py::array_t<double>({n, py::ssize_t{4}, py::ssize_t{3}}, corners.data()),
                          py::array_t<std::uint32_t>(n, rows.data()));
}

}  // namespace

void bind_patched(py::module_& m) {
    py::class_<Patched, std::shared_ptr<Patched>>(m, "Patched", "A channel of a scene on patches.")
        .def("vectors", &vectors)
        .def("matrices", &matrices)
        .def("K", [](const std::shared_ptr<Patched>& p) { return kept(p, p->system().reflected(p->channel)); })
        .def("T", [](const std::shared_ptr<Patched>& p) { return kept(p, p->system().transported()); })
        .def("reflect", &reflect, py::arg("x"), py::call_guard<py::gil_scoped_release>())
        .def("radius", &start_radius)
        .def_property_readonly("height", [](const Patched& p) { return p.scene->scene().film.crop_height; })
        .def_property_readonly("width", [](const Patched& p) { return p.scene->scene().film.crop_width; })
        .def("camera", &start_camera, py::arg("samples"), py::arg("seed"))
        .def("quadrilaterals", &quadrilaterals);
    m.def("patched", &start_patched, py::arg("scene"), py::arg("keywords"));
}

}  // namespace neumann
