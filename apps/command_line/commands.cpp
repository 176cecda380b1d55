#include "apps/command_line/commands.h"

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
#include "apps/commands/study_command.h"
#include "apps/commands/unbounce_command.h"
#include "core/base/error.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>

namespace neumann {

namespace {

template <class Request>
Command command(CLI::App& app, const std::string& line, CLI::App* (&add)(CLI::App&, Request&), int (&run)(const Request&)) {
    auto request = std::make_shared<Request>();
    if constexpr (requires { request->command_line; }) request->command_line = line;
    if constexpr (requires { request->patches.command_line; }) request->patches.command_line = line;
    return {add(app, *request), [request, &run] { return run(*request); }};
}

Command render_as_given(CLI::App& app, const std::string& line) {
    auto request = std::make_shared<RenderRequest>();
    request->command_line = line;
    const CLI::App* render = add_render(app, *request);
    return {render, [request, render] {
                request->options = given_options(*render);
                if (!request->resume.empty()) return render_command(resumed(*request));
                request->options = lasting(std::move(request->options));
                return render_command(*request);
            }};
}

}  // namespace

std::vector<Command> add_commands(CLI::App& app, const std::string& line) {
    return {render_as_given(app, line),
            command(app, line, add_compare, compare_command),
            command(app, line, add_spectrum, spectrum_command),
            command(app, line, add_solve, solve_command),
            command(app, line, add_export, export_command),
            command(app, line, add_conform, conform_command),
            command(app, line, add_study, study_command),
            command(app, line, add_replay, replay_command),
            command(app, line, add_page, page_command),
            command(app, line, add_stress, stress_command),
            command(app, line, add_plan, plan_command),
            command(app, line, add_convert, convert_command),
            command(app, line, add_merge, merge_command),
            command(app, line, add_blame, blame_command),
            command(app, line, add_unbounce, unbounce_command)};
}

void read_arguments(const std::function<void(CLI::App&)>& add, std::vector<std::string> arguments) {
    CLI::App app;
    app.set_help_flag();
    add(app);
    std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
    try {
        app.parse(arguments);
    } catch (const CLI::ParseError& e) {
        throw InputError(e.what());
    }
}

}  // namespace neumann
