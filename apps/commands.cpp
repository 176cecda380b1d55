#include "apps/commands.h"

#include "apps/compare.h"
#include "apps/conform.h"
#include "apps/export.h"
#include "apps/plan.h"
#include "apps/render.h"
#include "apps/replay.h"
#include "apps/solve.h"
#include "apps/spectrum.h"
#include "apps/stress.h"
#include "apps/study.h"

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

}  // namespace

std::vector<Command> add_commands(CLI::App& app, const std::string& line) {
    return {command(app, line, add_render, render_command),     command(app, line, add_compare, compare_command),
            command(app, line, add_spectrum, spectrum_command), command(app, line, add_solve, solve_command),
            command(app, line, add_export, export_command),     command(app, line, add_conform, conform_command),
            command(app, line, add_study, study_command),       command(app, line, add_replay, replay_command),
            command(app, line, add_stress, stress_command),     command(app, line, add_plan, plan_command)};
}

}  // namespace neumann
