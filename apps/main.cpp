// The command line.
#include "apps/compare.h"
#include "apps/conform.h"
#include "apps/export.h"
#include "apps/method_options.h"
#include "apps/options.h"
#include "apps/plan.h"
#include "apps/render.h"
#include "apps/replay.h"
#include "apps/solve.h"
#include "apps/spectrum.h"
#include "apps/stress.h"
#include "apps/study.h"
#include "core/base/error.h"

#include <fmt/format.h>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <new>

namespace {

constexpr int failed_while_running = 1, wrong_input = 2;

// Not fmt::print, which throws where stderr cannot be written.
void complain(const std::string& what) { std::fputs((what + "\n").c_str(), stderr); }

// What was printed must have arrived.
int finish(int code) {
    if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return code;
    throw neumann::RunError(std::string("standard output cannot be written: ") + std::strerror(errno));
}

std::string join(int argc, char** argv) {
    std::string line = "neumann";
    for (int i = 1; i < argc; ++i) line += fmt::format(" {}", argv[i]);
    return line;
}

// "render, compare, …, help"
std::string commands(const CLI::App& app) {
    std::string names;
    for (const CLI::App* command : app.get_subcommands({})) names += (names.empty() ? "" : ", ") + command->get_name();
    return names;
}

void add_render(CLI::App& app, neumann::RenderRequest& request, std::vector<std::string>& definitions) {
    auto* render = app.add_subcommand("render", "Render the bounces K^i Le of a scene, their sums, and what is left out");
    render->add_option("SCENE", request.scene, "Mitsuba 3 scene file")->required();
    render->add_option("-o", request.output, "Folder for the pictures and tables; out/NAME without it")->type_name("DIR");
    auto* bounces = render->add_option("-n", request.bounces, "The last bounce with a picture of its own")
                        ->type_name("BOUNCES")
                        ->check(neumann::whole_from(0, 100000));
    render->add_option("--tail", request.tail, "As many bounces as it takes until the rest is below this part of the sum")
        ->type_name("EPS")
        ->check(neumann::above_zero())
        ->excludes(bounces);
    render->add_option("--spp", request.samples, "Samples a pixel")
        ->type_name("N")
        ->check(neumann::whole_from(1, std::uint64_t{1} << 40));
    render->add_option("--time", request.seconds, "Sample for so many seconds")->type_name("S")->check(neumann::above_zero());
    render
        ->add_option("--error", request.relative_error,
                     "Sample until the relative standard error of every bounce is at most this, looked at when the samples are a "
                     "power of two")
        ->type_name("REL")
        ->check(neumann::above_zero());
    neumann::add_method_options(*render, request);
    render
        ->add_option("--ways", request.ways,
                     "Of bidirectional: pictures of every way (s, t) to make this bounce, s vertices from the light and t from the "
                     "camera, weighted and by itself")
        ->type_name("BOUNCE")
        ->check(neumann::whole_from(1, 1000));
    render->add_flag(
        "--importance", request.importance,
        "Of patches: pictures of K*^i We in place of K^i Le: by how much the mean of the picture of bounce i grows with "
        "the radiance given off at each point, per area and projected solid angle (m⁻²·sr⁻¹), mean over directions");
    render
        ->add_option("--reference", request.reference, "Folder of an earlier render: convergence.csv then has the true errors too")
        ->type_name("DIR");
    render->add_option("--seed", request.seed, "Seed of the random numbers")
        ->type_name("N")
        ->check(neumann::whole_from(0, ~std::uint64_t{0}))
        ->capture_default_str();
    render->add_option("-t", request.threads, "Threads; all without it")->type_name("THREADS")->check(neumann::whole_from(1, 4096));
    neumann::add_definitions(*render, definitions);
    render->add_flag("--quiet", request.quiet, "Print nothing but errors");
    render->add_flag("--json", request.json, "Print run.json");
}

}  // namespace

int main(int argc, char** argv) try {
    std::signal(SIGXFSZ, SIG_IGN);  // a file too large is an error of write() like a full disk
    CLI::App app(
        "neumann makes the bounces of light visible: the terms of L = Le + K Le + K² Le + …, their sums, and their errors.");
    app.name("neumann");
    app.require_subcommand(1);
    app.set_version_flag("--version", "neumann " NEUMANN_VERSION);

    neumann::RenderRequest request;
    std::vector<std::string> definitions;
    add_render(app, request, definitions);
    neumann::CompareRequest compare_request;
    auto* compare = app.add_subcommand(
        "compare", "Print error metrics between two pictures or two output folders; the second is the reference");
    compare->add_option("A", compare_request.a, "Picture or folder")->required();
    compare->add_option("B", compare_request.b, "Reference picture or folder")->required();
    compare->add_option("-o", compare_request.output, "Of two folders: write a page there that shows both, bounce by bounce")
        ->type_name("DIR");
    compare->add_flag("--json", compare_request.json, "Print JSON");
    neumann::SpectrumRequest spectrum_request;
    auto* spectrum = neumann::add_spectrum(app, spectrum_request);
    neumann::SolveRequest solve_request;
    auto* solve = neumann::add_solve(app, solve_request);
    neumann::ExportRequest export_request;
    auto* export_matrices = neumann::add_export(app, export_request);
    neumann::ConformRequest conform_request;
    auto* conform = neumann::add_conform(app, conform_request);
    neumann::StudyRequest study_request;
    auto* study = neumann::add_study(app, study_request);
    neumann::ReplayRequest replay_request;
    auto* replay = neumann::add_replay(app, replay_request);
    neumann::StressRequest stress_request;
    auto* stress = neumann::add_stress(app, stress_request);
    neumann::PlanRequest plan_request;
    auto* plan = neumann::add_plan(app, plan_request);
    auto* help = app.add_subcommand("help", "Show the help of a command");
    std::string topic;
    help->add_option("COMMAND", topic, "Command");

    if (argc > 1 && argv[1][0] != '-' && app.get_subcommands([&](const CLI::App* c) { return c->get_name() == argv[1]; }).empty())
        throw neumann::InputError(fmt::format("no command is called '{}'; there are {}", argv[1], commands(app)));
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        const int code = app.exit(e);
        return code == 0 ? finish(0) : wrong_input;
    }
    if (*help) {
        for (const CLI::App* about : app.get_subcommands([&](const CLI::App* command) { return command->get_name() == topic; })) {
            fmt::print("{}", about->help("neumann"));
            return finish(0);
        }
        if (!topic.empty()) throw neumann::InputError(fmt::format("no command is called '{}'; there are {}", topic, commands(app)));
        app.clear();
        fmt::print("{}", app.help());
        return finish(0);
    }
    if (*compare) return finish(neumann::compare_command(compare_request));
    if (*replay) return finish(neumann::replay_command(replay_request));
    if (*stress) return finish(neumann::stress_command(stress_request));
    if (*plan) return finish(neumann::plan_command(plan_request));
    if (*conform) return finish(neumann::conform_command(conform_request));

    const std::string command_line = join(argc, argv);
    if (*study) {
        study_request.command_line = command_line;
        return finish(neumann::study_command(study_request));
    }
    if (*spectrum) {
        spectrum_request.patches.command_line = command_line;
        return finish(neumann::spectrum_command(spectrum_request));
    }
    if (*solve) {
        solve_request.patches.command_line = command_line;
        return finish(neumann::solve_command(solve_request));
    }
    if (*export_matrices) {
        export_request.patches.command_line = command_line;
        return finish(neumann::export_command(export_request));
    }

    request.definitions = neumann::parse_definitions(definitions);
    request.command_line = command_line;
    if (request.output.empty())
        request.output = (std::filesystem::path("out") / std::filesystem::path(request.scene).stem()).string();
    return finish(neumann::render_command(request));
} catch (const neumann::InputError& e) {
    complain(e.what());
    return wrong_input;
} catch (const std::bad_alloc&) {
    complain("neumann: not enough memory");
    return failed_while_running;
} catch (const std::exception& e) {
    complain(std::string("neumann: ") + e.what());
    return failed_while_running;
}
