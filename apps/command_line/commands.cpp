#include "apps/command_line/commands.h"

#include "apps/command_line/add_options.h"
#include "apps/command_line/resume.h"
#include "apps/commands/blame_command.h"
#include "apps/commands/compare_command.h"
#include "apps/commands/conform_command.h"
#include "apps/commands/convert_command.h"
#include "apps/commands/export_command.h"
#include "apps/commands/merge_command.h"
#include "apps/commands/page_command.h"
#include "apps/commands/plan_command.h"
#include "apps/commands/render_command.h"
#include "apps/commands/replay_command.h"
#include "apps/commands/solve_command.h"
#include "apps/commands/spectrum_command.h"
#include "apps/commands/stress_command.h"
#include "apps/commands/strip_command.h"
#include "apps/commands/study_command.h"
#include "apps/commands/unbounce_command.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace neumann {

namespace {

template <class Request>
Request request_of(const Options<Request>& options, const Given& given, const std::string& line) {
    Request request;
    if constexpr (requires { request.command_line; }) request.command_line = line;
    if constexpr (requires { request.patches.command_line; }) request.patches.command_line = line;
    if constexpr (requires { request.render.command_line; }) request.render.command_line = line;
    take(options, given, request, &OptionWords::spelled);
    return request;
}

template <class Request>
Command command(CLI::App& app, const std::string& line, const Options<Request>& options, int (&run)(const Request&)) {
    const auto given = std::make_shared<Given>();
    const CLI::App& added = add_command(app, options, *given);
    return {&added, [given, line, &options, &run] { return run(request_of(options, *given, line)); }};
}

int render(const Given& given, const std::string& line) {
    const RenderRequest request = request_of(render_options(), given, line);
    return render_command(request.resume.empty() ? request : resumed(request, given));
}

Command render_as_given(CLI::App& app, const std::string& line) {
    const auto given = std::make_shared<Given>();
    CLI::App& added = add_command(app, render_options(), *given);
    CLI::Option* const scene = added.get_option("SCENE");
    added.get_option("--resume")->each([scene](const std::string&) { scene->required(false); });
    return {&added, [given, line] { return render(*given, line); }};
}

}  // namespace

std::vector<Command> add_commands(CLI::App& app, const std::string& line) {
    return {render_as_given(app, line),
            command(app, line, compare_options(), compare_command),
            command(app, line, spectrum_options(), spectrum_command),
            command(app, line, solve_options(), solve_command),
            command(app, line, export_options(), export_command),
            command(app, line, conform_options(), conform_command),
            command(app, line, study_options(), study_command),
            command(app, line, replay_options(), replay_command),
            command(app, line, page_options(), page_command),
            command(app, line, strip_options(), strip_command),
            command(app, line, stress_options(), stress_command),
            command(app, line, plan_options(), plan_command),
            command(app, line, convert_options(), convert_command),
            command(app, line, merge_options(), merge_command),
            command(app, line, blame_options(), blame_command),
            command(app, line, unbounce_options(), unbounce_command)};
}

}  // namespace neumann
