// The command line.
#include "apps/compare.h"
#include "apps/conform.h"
#include "apps/export.h"
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

}  // namespace

int main(int argc, char** argv) try {
    std::signal(SIGXFSZ, SIG_IGN);  // a file too large is an error of write() like a full disk
    CLI::App app(
        "neumann makes the bounces of light visible: the terms of L = Le + K Le + K² Le + …, their sums, and their errors.");
    app.name("neumann");
    app.require_subcommand(1);
    app.set_version_flag("--version", "neumann " NEUMANN_VERSION);

    neumann::RenderRequest request;
    neumann::add_render(app, request);
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

    request.definitions = neumann::parse_definitions(request.definition_texts);
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
