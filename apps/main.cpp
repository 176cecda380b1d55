// The command line.
#include "apps/compare.h"
#include "apps/render.h"
#include "core/base/error.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <new>

namespace {

constexpr int failed_while_running = 1, wrong_input = 2;

std::map<std::string, std::string> parse_definitions(const std::vector<std::string>& texts) {
    std::map<std::string, std::string> definitions;
    for (const std::string& text : texts) {
        const auto equals = text.find('=');
        if (equals == std::string::npos || equals == 0) throw neumann::InputError("-D " + text + ": expected name=value");
        if (!definitions.emplace(text.substr(0, equals), text.substr(equals + 1)).second)
            throw neumann::InputError("-D " + text + ": '" + text.substr(0, equals) + "' is given twice");
    }
    return definitions;
}

std::string join(int argc, char** argv) {
    std::string line = "neumann";
    for (int i = 1; i < argc; ++i) line += fmt::format(" {}", argv[i]);
    return line;
}

void add_render(CLI::App& app, neumann::RenderRequest& request, std::vector<std::string>& definitions) {
    auto* render = app.add_subcommand("render", "Render the bounces K^i Le of a scene, their sums, and what is left out");
    render->add_option("SCENE", request.scene, "Mitsuba 3 scene file")->required();
    render->add_option("-o", request.output, "Folder for the pictures and tables; out/NAME without it")->type_name("DIR");
    auto* bounces = render->add_option("-n", request.bounces, "The last bounce with a picture of its own")
                        ->type_name("BOUNCES")
                        ->check(CLI::Range(0, 100000));
    render->add_option("--tail", request.tail, "As many bounces as it takes until the rest is below this part of the sum")
        ->type_name("EPS")
        ->check(CLI::PositiveNumber)
        ->excludes(bounces);
    render->add_option("--spp", request.samples, "Samples a pixel")->type_name("N")->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 40));
    render->add_option("--time", request.seconds, "Sample for so many seconds")->type_name("S")->check(CLI::PositiveNumber);
    render->add_option("--error", request.relative_error, "Sample until the relative standard error of every bounce is at most this")
        ->type_name("REL")
        ->check(CLI::PositiveNumber);
    render->add_option("--method", request.method, "walk: one walk for all bounces; pointwise: each bounce by itself, slow and plain")
        ->type_name("NAME")
        ->check(CLI::IsMember({"walk", "pointwise"}))
        ->capture_default_str();
    const std::map<std::string, neumann::DirectLight> direct{
        {"light", neumann::DirectLight::light}, {"bsdf", neumann::DirectLight::bsdf}, {"mis", neumann::DirectLight::mis}};
    render->add_option("--direct", request.direct, "How a walk finds lights: by points on them (light), by the material's directions (bsdf), or both (mis)")
        ->transform(CLI::CheckedTransformer(direct).description("{light,bsdf,mis}"))
        ->type_name("")
        ->default_str("mis");
    render->add_option("--reference", request.reference, "Folder of an earlier render: convergence.csv then has the true errors too")->type_name("DIR");
    render->add_option("--seed", request.seed, "Seed of the random numbers")->capture_default_str();
    render->add_option("-t", request.threads, "Threads; all without it")->type_name("THREADS")->check(CLI::Range(1, 4096));
    render->add_option("-D", definitions, "Define $name in the scene file")->type_name("name=value")->take_all();
    render->add_flag("--quiet", request.quiet, "Print nothing but errors");
    render->add_flag("--json", request.json, "Print run.json");
}

}  // namespace

int main(int argc, char** argv) try {
    CLI::App app("neumann makes the bounces of light visible: the terms of L = Le + K Le + K² Le + …, their sums, and their errors.");
    app.name("neumann");
    app.require_subcommand(1);
    app.set_version_flag("--version", "neumann " NEUMANN_VERSION);

    neumann::RenderRequest request;
    std::vector<std::string> definitions;
    add_render(app, request, definitions);
    std::string a, b;
    bool json = false;
    auto* compare = app.add_subcommand("compare", "Print error metrics between two pictures or two output folders; the second is the reference");
    compare->add_option("A", a, "Picture or folder")->required();
    compare->add_option("B", b, "Reference picture or folder")->required();
    compare->add_flag("--json", json, "Print JSON");
    auto* help = app.add_subcommand("help", "Show the help of a command");
    std::string topic;
    help->add_option("COMMAND", topic, "Command");

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        const int code = app.exit(e);
        return code == 0 ? 0 : wrong_input;
    }
    if (*help) {
        for (const CLI::App* about : app.get_subcommands([&](const CLI::App* command) { return command->get_name() == topic; })) {
            fmt::print("{}", about->help());
            return 0;
        }
        if (!topic.empty()) throw neumann::InputError("no command is called '" + topic + "'; there are render, compare, help");
        fmt::print("{}", app.help());
        return 0;
    }
    if (*compare) return neumann::compare_command(a, b, json);

    request.definitions = parse_definitions(definitions);
    request.command_line = join(argc, argv);
    if (request.output.empty()) request.output = (std::filesystem::path("out") / std::filesystem::path(request.scene).stem()).string();
    return neumann::render_command(request);
} catch (const neumann::InputError& e) {
    fmt::print(stderr, "{}\n", e.what());
    return wrong_input;
} catch (const std::bad_alloc&) {
    fmt::print(stderr, "neumann: not enough memory\n");
    return failed_while_running;
} catch (const std::exception& e) {
    fmt::print(stderr, "neumann: {}\n", e.what());
    return failed_while_running;
}
