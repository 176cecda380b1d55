// The commands of the program, all but help: what they are called, what they take, and what runs them.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace neumann {

struct CompareRequest;
struct ConformRequest;
struct ExportRequest;
struct PlanRequest;
struct RenderRequest;
struct ReplayRequest;
struct SolveRequest;
struct SpectrumRequest;
struct StressRequest;
struct StudyRequest;

struct Command {
    const CLI::App* app;
    std::function<int()> run;  // with what was parsed; returns the exit code
};

// Adds them all to `app`. `line` is the command as typed, for run.json.
std::vector<Command> add_commands(CLI::App& app, const std::string& line);

// Reads arguments as the command line does, by what `add` adds. Throws InputError with what it says.
void read_arguments(const std::function<void(CLI::App&)>& add, std::vector<std::string> arguments);

// One of them, with its options, that are read into the request.
CLI::App* add_compare(CLI::App& app, CompareRequest& request);
CLI::App* add_conform(CLI::App& app, ConformRequest& request);
CLI::App* add_export(CLI::App& app, ExportRequest& request);
CLI::App* add_plan(CLI::App& app, PlanRequest& request);
CLI::App* add_render(CLI::App& app, RenderRequest& request);
CLI::App* add_replay(CLI::App& app, ReplayRequest& request);
CLI::App* add_solve(CLI::App& app, SolveRequest& request);
CLI::App* add_spectrum(CLI::App& app, SpectrumRequest& request);
CLI::App* add_stress(CLI::App& app, StressRequest& request);
CLI::App* add_study(CLI::App& app, StudyRequest& request);

}  // namespace neumann
