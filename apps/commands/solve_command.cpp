#include "apps/commands/solve_command.h"

#include "apps/commands/print_warnings.h"
#include "apps/commands/run_by_all.h"
#include "apps/output/files/json_number.h"
#include "apps/output/files/json_text.h"
#include "core/base/error.h"
#include "core/base/interrupt.h"
#include "operators/fields/matrix/traced_system.h"
#include "operators/fields/shared/shared_solvers.h"
#include "operators/solvers/petsc/petsc_solver.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <string_view>

namespace neumann {

namespace {

bool is_reference(const SolverRow& row) { return row.name == "lu"; }

std::string short_number(double x) { return std::isfinite(x) ? fmt::format("{:.1e}", x) : ""; }

std::string applications_text(double n) { return n == std::floor(n) ? fmt::format("{:.0f}", n) : fmt::format("{:.1f}", n); }

// `text` in lines of at most 100 columns, all but the first indented.
std::string wrapped(const std::string& text, std::size_t indent) {
    constexpr std::size_t width = 100;
    std::string result;
    std::size_t column = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find(' ', begin), text.size());
        const std::string word = text.substr(begin, end - begin);
        const auto columns =
            static_cast<std::size_t>(std::count_if(word.begin(), word.end(), [](char c) { return (c & 0xC0) != 0x80; }));
        if (column > 0 && column + 1 + columns > width) {
            result += "\n" + std::string(indent, ' ');
            column = indent;
        } else if (column > 0) {
            result += " ";
            ++column;
        }
        result += word;
        column += columns;
        begin = end + 1;
    }
    return result;
}

// Prints notes, each once if it is the same for several solvers.
void print_notes(const SideBySide& all) {
    const auto other = [](const SolverRow& a, const SolverRow& b) {
        return a.result.verdict != b.result.verdict || a.result.why != b.result.why;
    };
    for (std::size_t i = 0; i < all.rows.size(); ++i) {
        const SolverRow& row = all.rows[i];
        if (row.result.verdict == Verdict::converged) continue;
        std::string who;
        bool is_reported = false;
        for (std::size_t k = 0; k < all.rows.size(); ++k) {
            if (other(row, all.rows[k])) continue;
            is_reported = is_reported || k < i;
            who += (who.empty() ? "" : "; ") + all.rows[k].title;
        }
        if (!is_reported)
            fmt::print("{}\n", wrapped(fmt::format("{} ({}): {}.", who, name(row.result.verdict), row.result.why), 4));
    }
    if (all.interrupted) fmt::print("Interrupted: the other solvers were not run.\n");
}

void print_table(const PatchScene& scene, const SolveRequest& request, const ChosenChannel& chosen, const SideBySide& all) {
    fmt::print("{}\n", scene.title());
    fmt::print("Channel {}: {}. Spectral radius {:.6f}, found with {} applications of K.\n",
               scene.system().channel_name(chosen.channel), chosen.why, chosen.radius, applications_text(chosen.applications));
    if (chosen.traps_light)
        fmt::print(
            "Light that total reflection keeps within glass has the eigenvalue 1. Where none gets there, the series converges\n"
            "all the same: residuals alone are looked at.\n");
    if (scene.system().samples_lights())
        fmt::print("b = K Le is sampled on the lights, which the rays hardly meet: L − Le = b + K (L − Le) is solved for.\n");
    if (!all.no_reference.empty())
        fmt::print("{}\n",
                   wrapped(all.reference + " is no reference, and errors are estimates only: " + all.no_reference + ".", 4));
    fmt::print("\n{:<33}{:>13}{:>11}{:>12}{:>16}   {}\n", "solver", "applications", "seconds", "estimate",
               "error to " + all.reference, "verdict");
    for (const SolverRow& row : all.rows)
        fmt::print("{:<33}{:>13}{:>11.4f}{:>12}{:>16}   {}\n", row.title, applications_text(row.result.applications), row.seconds,
                   short_number(row.estimate()),
                   is_reference(row) && all.no_reference.empty() ? "reference" : short_number(row.error), name(row.result.verdict));
    fmt::print(
        "\nApplications are of K, setup included; at most {} were allowed. Errors are relative, in the\n"
        "largest value; {:g} was asked for.\n",
        request.most, request.tolerance);
    print_notes(all);
}

void print_csv(const SideBySide& all) {
    fmt::print("solver,applications,estimate,error,seconds\n");
    const auto cell = [](double x) { return std::isnan(x) ? std::string() : fmt::format("{:.9g}", x); };
    for (const SolverRow& row : all.rows)
        for (const SolverStep& step : row.result.history)
            fmt::print("{},{:.9g},{},{},{:.6f}\n", row.name, step.applications, cell(step.estimate), cell(step.error),
                       step.seconds);
}

}  // namespace

nlohmann::ordered_json solve_json(const PatchScene& scene, const SolveRequest& request, const SolvedScene& solved) {
    const ChosenChannel& chosen = solved.chosen;
    const SideBySide& all = solved.all;
    using Json = nlohmann::ordered_json;
    Json json = scene.json();
    json["channel"] = {{"name", scene.system().channel_name(chosen.channel)}, {"why", chosen.why}};
    json["spectral_radius"] = json_number(chosen.radius);
    json["unknown"] = scene.system().samples_lights() ? "L - Le" : "L";
    json["tolerance"] = request.tolerance;
    json["most_applications"] = request.most;
    json["reference"] = all.no_reference.empty() ? Json(all.reference == "LU" ? "lu" : "gmres") : Json(nullptr);
    if (!all.no_reference.empty()) json["no_reference"] = all.no_reference;
    json["interrupted"] = all.interrupted;
    json["solvers"] = Json::array();
    for (const SolverRow& row : all.rows) {
        Json solver = {{"name", row.name},
                       {"title", row.title},
                       {"verdict", name(row.result.verdict)},
                       {"why", row.result.why},
                       {"applications", row.result.applications},
                       {"setup_applications", row.result.setup},
                       {"seconds", row.seconds},
                       {"estimate", json_number(row.estimate())},
                       {"error", json_number(row.error)},
                       {"history", Json::array()}};
        for (const SolverStep& step : row.result.history)
            solver["history"].push_back({{"applications", step.applications},
                                         {"estimate", json_number(step.estimate)},
                                         {"error", json_number(step.error)},
                                         {"seconds", step.seconds}});
        json["solvers"].push_back(solver);
    }
    return json;
}

SolvedScene solve_scene(const PatchScene& scene, const SolveRequest& request, bool histories, bool shared) {
    const MatrixSystem& system = scene.system();
    SolvedScene solved{choose_channel(system, channel_number(request.channel), {.stop = interrupted}), {}};
    const ChosenChannel& chosen = solved.chosen;
    const std::unique_ptr<ChannelOperator> K = system.reflected(chosen.channel);

    Problem problem;
    problem.K = K.get();
    problem.Le = system.samples_lights() ? system.direct(chosen.channel) : system.emitted(chosen.channel);
    problem.tolerance = request.tolerance;
    problem.most = request.most;
    if (std::isfinite(chosen.radius) && !chosen.traps_light) problem.radius = chosen.radius;
    const Watch watch{.stop = interrupted};
    if (shared) {
        solved.all = solve_shared(problem, petsc_options(request.petsc.value_or("")), histories, watch, solved.warnings);
        return solved;
    }
    if (const auto* const traced = dynamic_cast<const TracedChannel*>(K.get())) problem.reflectance = &traced->reflectance();
    solved.all = solve_side_by_side(problem, histories, watch);
    if (request.petsc) solved.warnings = add_petsc_rows(problem, petsc_options(*request.petsc), histories, watch, solved.all);
    return solved;
}

namespace {

int solve_and_print(const SolveRequest& request, Processes* processes) {
    // This throws before anything is read.
    if (request.petsc) require_petsc();
    catch_interrupts();
    const PatchScene scene = processes ? PatchScene(request.patches, *processes, "") : PatchScene(request.patches);
    const SolvedScene solved = solve_scene(scene, request, request.csv || request.patches.json, processes != nullptr);

    print_warnings(scene.warnings(), request.patches.quiet);
    print_warnings(solved.warnings, request.patches.quiet);
    if (request.patches.json)
        fmt::print("{}\n", json_text(solve_json(scene, request, solved), 2));
    else if (request.csv)
        print_csv(solved.all);
    else
        print_table(scene, request, solved.chosen, solved.all);
    return 0;
}

}  // namespace

int solve_command(const SolveRequest& request) { return run_by_all(request, solve_and_print); }

}  // namespace neumann
