// The commands of the program except help: their names, their options, and the functions that run them.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace neumann {

struct BlameRequest;
struct CompareRequest;
struct ConformRequest;
struct ConvertRequest;
struct ExportRequest;
struct MergeRequest;
struct PageRequest;
struct PlanRequest;
struct RenderRequest;
struct ReplayRequest;
struct SolveRequest;
struct SpectrumRequest;
struct StressRequest;
struct StudyRequest;
struct UnbounceRequest;

struct Command {
    const CLI::App* app;
    std::function<int()> run;  // runs with the parsed options; returns the exit code
};

// Adds all commands to `app`. `line`: the command line as typed, for run.json.
std::vector<Command> add_commands(CLI::App& app, const std::string& line);

// Parses arguments like the command line, for the command that `add` adds. Throws InputError with the parser's message.
void read_arguments(const std::function<void(CLI::App&)>& add, std::vector<std::string> arguments);

// Each adds one command with its options, which are parsed into the request.
CLI::App* add_blame(CLI::App& app, BlameRequest& request);
CLI::App* add_compare(CLI::App& app, CompareRequest& request);
CLI::App* add_conform(CLI::App& app, ConformRequest& request);
CLI::App* add_convert(CLI::App& app, ConvertRequest& request);
CLI::App* add_export(CLI::App& app, ExportRequest& request);
CLI::App* add_merge(CLI::App& app, MergeRequest& request);
CLI::App* add_page(CLI::App& app, PageRequest& request);
CLI::App* add_plan(CLI::App& app, PlanRequest& request);
CLI::App* add_render(CLI::App& app, RenderRequest& request);
CLI::App* add_replay(CLI::App& app, ReplayRequest& request);
CLI::App* add_solve(CLI::App& app, SolveRequest& request);
CLI::App* add_spectrum(CLI::App& app, SpectrumRequest& request);
CLI::App* add_stress(CLI::App& app, StressRequest& request);
CLI::App* add_study(CLI::App& app, StudyRequest& request);
CLI::App* add_unbounce(CLI::App& app, UnbounceRequest& request);

}  // namespace neumann
