#include "apps/commands/export_command.h"

#include "apps/commands/print_warnings.h"
#include "apps/output/files/json_text.h"
#include "apps/output/files/matrix_market.h"
#include "apps/output/files/output_folder.h"
#include "core/base/error.h"
#include "core/base/interrupt.h"
#include "core/base/limits.h"

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>
#include <limits>

namespace neumann {

namespace {

namespace fs = std::filesystem;

// Approximate memory of a ray's entry while a matrix is assembled and converted to text.
constexpr double bytes_of_entry = 90.0;

// Throws InputError if the folder holds a render, because a run replaces the files of earlier runs.
void check_folder(const std::string& output) {
    std::error_code error;
    if (fs::exists(fs::path(output) / "bounce_000.exr", error))
        throw InputError(output +
                         ": holds the pictures of a render, which the matrices would replace; name another folder with -o");
}

// The files of an export, with their names in Python.
class Export {
public:
    Export(const std::string& output, bool quiet) : folder_(output, "export"), quiet_(quiet) {}

    template <class Matrix>
    void write(const std::string& name, const Matrix& matrix, const std::string& what) {
        add(name, matrix_market(matrix, what), fmt::format("{} × {}", matrix.rows(), matrix.cols()), what);
    }
    void add(const std::string& name, const std::string& bytes, const std::string& size, const std::string& what) {
        if (interrupted()) throw RunError("interrupted; nothing was written");
        folder_.write(name, bytes);
        files_.push_back({{"name", name}, {"size", size}, {"holds", what}});
        if (!quiet_) lines_ += fmt::format("  {:<17}{:<18}{}\n", name, size, what);
    }
    // `json` becomes run.json.
    void commit(nlohmann::ordered_json& json) {
        json["files"] = files_;
        folder_.write("run.json", json_text(json, 2) + "\n");
        if (interrupted()) throw RunError("interrupted; nothing was written");
        folder_.commit();
    }
    const std::string& lines() const { return lines_; }

private:
    OutputFolder folder_;
    bool quiet_;
    nlohmann::ordered_json files_ = nlohmann::ordered_json::array();
    std::string lines_;
};

Eigen::MatrixXd columns(int channels, const auto& column) {
    Eigen::MatrixXd matrix;
    for (int c = 0; c < channels; ++c) {
        const Vector values = column(c);
        matrix.conservativeResize(values.size(), channels);
        matrix.col(c) = values;
    }
    return matrix;
}

void print_how_to_read(const PatchScene& scene, const ExportRequest& request, const std::string& output, const std::string& lines) {
    const std::string suffix = scene.system().channels() == 1 ? "" : "_r";
    fmt::print("{}\n\n{}\nIn Python, in the folder {}:\n\n", scene.title(), lines, output);
    fmt::print("    import scipy.io\n");
    fmt::print("    T = scipy.io.mmread(\"T.mtx\").tocsr()\n");
    fmt::print("    R = scipy.io.mmread(\"R{}.mtx\").tocsr()\n", suffix);
    if (request.with_K) fmt::print("    K = scipy.io.mmread(\"K{}.mtx\").tocsr()  # R @ T\n", suffix);
    fmt::print("    Le = scipy.io.mmread(\"Le.mtx\"){}\n", suffix.empty() ? "" : "  # a column for each channel");
}

}  // namespace

void check_matrix_memory(const PatchOptions& options, const TracedSystem& system) {
    // R of a rough side has an entry for each ray and direction.
    const auto rays = static_cast<double>(std::max(system.rays(), reflection_entries(system.table(), system.reflection(0))));
    const double fitting = std::min(memory_limit(options.memory) / bytes_of_entry, double{std::numeric_limits<int>::max()});
    if (rays > fitting)
        throw InputError(fmt::format(
            "{}: the matrices of {} patches of {} rays are too large to export; at most {:.0f} patches of as many rays fit",
            options.scene.path, system.space().patches().size(), options.rays,
            fitting / rays * static_cast<double>(system.space().patches().size())));
}

std::string patches_table(const PatchSpace& space) {
    std::string csv = "unknown,directions,patch,side,shape,x,y,z,nx,ny,nz,area\n";
    for (const Facet& facet : space.facets()) {
        const SurfacePoint p = space.patches().point(facet.patch, Vec2(0.5));
        const Vec3 n = facet.front ? p.normal : -p.normal;
        csv += fmt::format("{},{},{},{},{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", facet.first,
                           facet.cells.size(), facet.patch, facet.front ? "front" : "back", p.shape, p.position.x, p.position.y,
                           p.position.z, n.x, n.y, n.z, space.patches().area(facet.patch));
    }
    return csv;
}

int export_command(const ExportRequest& request) {
    catch_interrupts();
    const std::string output =
        request.output.empty() ? (fs::path("out") / (fs::path(request.patches.scene.path).stem().string() + "-matrices")).string()
                               : request.output;
    const PatchScene scene(request.patches);
    const TracedSystem& system = scene.traced();
    check_matrix_memory(request.patches, system);
    check_folder(output);
    Export files(output, request.patches.quiet);

    const auto T = transport_matrix(system.table());
    files.write("T.mtx", T, "exitant radiance of the unknowns to what each ray brings");
    for (int c = 0; c < system.channels(); ++c) {
        const std::string letter = scene.channel_letter(c), suffix = (letter.empty() ? "" : "_" + letter) + ".mtx",
                          channel = letter.empty() ? "" : std::string(", ") + system.channel_name(c);
        const auto R = reflection_matrix(system.table(), system.reflection(c));
        files.write("R" + suffix, R, "what the rays bring to what the unknowns send" + channel);
        if (!request.with_K) continue;
        const Eigen::SparseMatrix<double, Eigen::RowMajor> K = R * T;
        files.write("K" + suffix, K, "K = R T" + channel);
    }
    const char* how = system.samples_lights() ? "K Le, sampled on the lights" : "K Le";
    const int channels = system.channels();
    files.write("Le.mtx", columns(channels, [&](int c) { return system.emitted(c); }), "emitted radiance, W/(m^2 sr)");
    files.write("b.mtx", columns(channels, [&](int c) { return system.direct(c); }), how);
    files.write("measure.mtx", columns(1, [&](int) { return system.transport().measure(); }),
                "n^2 times area times projected solid angle of an unknown");
    files.write("ray_measure.mtx", columns(1, [&](int) { return ray_measures(system.table()); }), "the same of a ray");
    files.add("patches.csv", patches_table(system.space()), fmt::format("{} rows", system.space().facets().size()),
              "first unknown of a side, how many directions, patch, shape, …");

    const std::vector<std::string> warnings = scene.warnings();
    nlohmann::ordered_json json = scene.json();
    json["channels"] = nlohmann::ordered_json::array();
    for (int c = 0; c < channels; ++c) json["channels"].push_back(system.channel_name(c));
    json["b"] = how;
    json["warnings"] = warnings;
    files.commit(json);

    print_warnings(warnings, request.patches.quiet);
    if (request.patches.json)
        fmt::print("{}\n", json_text(json, 2));
    else if (!request.patches.quiet)
        print_how_to_read(scene, request, output, files.lines());
    return 0;
}

}  // namespace neumann
