#include "apps/commands/stress_command.h"

#include "apps/output/files/json_text.h"
#include "apps/output/files/stress_files.h"
#include "core/base/error.h"
#include "core/base/interrupt.h"
#include "core/base/limits.h"
#include "core/base/stopwatch.h"

#include <fmt/format.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace neumann {

namespace {

using known::Case;
using known::Figure;
using Json = nlohmann::ordered_json;

struct CaseOutcome {
    const Case* known;
    std::vector<Figure> figures;
    double seconds;

    bool passed() const {
        return std::all_of(figures.begin(), figures.end(), [](const Figure& f) { return f.passed; });
    }
};

constexpr std::size_t quantity_width = 43, value_width = 17, number_width = 11;

std::string text(const Figure::Value& value) {
    if (const auto* words = std::get_if<std::string>(&value)) return *words;
    return fmt::format("{:.10g}", std::get<double>(value));
}
std::string expected(const Figure& f) {
    constexpr const char* marks[] = {"", "<= ", ">= "};
    return marks[static_cast<std::size_t>(f.relation)] + text(f.expected);
}
// The size of an error; empty for errors without a size, such as those of messages.
std::string size(double x) { return std::isnan(x) ? "" : fmt::format("{:.2g}", x); }

void print_figure(const Figure& f) {
    std::string wanted = expected(f), found = text(f.measured);
    const bool is_long = std::max(wanted.size(), found.size()) >= value_width;
    fmt::print("{} {:<{}} {:>{}} {:>{}} {:>{}} {:>{}}  {}\n", f.passed ? ' ' : '!', f.quantity, quantity_width,
               is_long ? "" : wanted, value_width, is_long ? "" : found, value_width, size(f.error), number_width,
               size(f.tolerance), number_width, f.passed ? "ok" : "FAILED");
    if (is_long) fmt::print("      expected: {}\n      measured: {}\n", wanted, found);
    if (!f.why.empty()) fmt::print("      {}\n", f.why);
}

void print_case(const CaseOutcome& outcome) {
    fmt::print("\n{}  ({}; {:.2f} s)\n", outcome.known->name, outcome.known->source, outcome.seconds);
    for (const Figure& f : outcome.figures) print_figure(f);
    std::fflush(stdout);
}

std::size_t failures(const std::vector<CaseOutcome>& outcomes) {
    std::size_t count = 0;
    for (const CaseOutcome& outcome : outcomes)
        count += static_cast<std::size_t>(
            std::count_if(outcome.figures.begin(), outcome.figures.end(), [](const Figure& f) { return !f.passed; }));
    return count;
}

void print_summary(const std::vector<CaseOutcome>& outcomes, std::size_t cases, double seconds) {
    std::size_t figures = 0;
    for (const CaseOutcome& outcome : outcomes) figures += outcome.figures.size();
    const std::size_t failed = failures(outcomes);
    if (failed > 0) {
        fmt::print("\nFailed:\n");
        for (const CaseOutcome& outcome : outcomes)
            if (!outcome.passed()) fmt::print("  {}\n", outcome.known->name);
    }
    fmt::print("\n{} figures of {} cases: {} ok, {} FAILED; {:.1f} s\n", figures, outcomes.size(), figures - failed, failed,
               seconds);
    if (outcomes.size() < cases) fmt::print("Interrupted: {} cases were not reached\n", cases - outcomes.size());
}

Json as_json(const Figure::Value& value) {
    if (const auto* words = std::get_if<std::string>(&value)) return *words;
    return std::get<double>(value);
}

Json as_json(const CaseOutcome& outcome) {
    constexpr const char* relations[] = {"equal", "at most", "at least"};
    Json figures = Json::array();
    for (const Figure& f : outcome.figures) {
        figures.push_back({{"quantity", f.quantity},
                           {"expected", as_json(f.expected)},
                           {"relation", relations[static_cast<std::size_t>(f.relation)]},
                           {"measured", as_json(f.measured)},
                           {"error", f.error},
                           {"tolerance", f.tolerance},
                           {"passed", f.passed}});
        if (f.standard_error) figures.back()["standard_error"] = *f.standard_error;
        if (!f.why.empty()) figures.back()["why"] = f.why;
    }
    return {{"case", outcome.known->name},
            {"source", outcome.known->source},
            {"seconds", outcome.seconds},
            {"passed", outcome.passed()},
            {"figures", std::move(figures)}};
}

// A progress line. If line and table go to the same terminal, the line is erased before the table continues.
class CaseLine {
public:
    CaseLine() : active_(isatty(STDERR_FILENO)) {}
    void show(std::size_t done, std::size_t all, const std::string& name) const {
        if (!active_) return;
        fmt::print(stderr, "\r\033[K{} of {} cases done   {}", done, all, name);
        std::fflush(stderr);
    }
    void clear() const {
        if (!active_) return;
        fmt::print(stderr, "\r\033[K");
        std::fflush(stderr);
    }

private:
    bool active_;
};

std::vector<const Case*> chosen(const known::Cases& all, const std::string& only) {
    std::vector<const Case*> cases;
    for (const Case& known : all)
        if (only.empty() || known::matches(known.name, only)) cases.push_back(&known);
    if (!cases.empty()) return cases;
    std::string groups;
    for (const Case& known : all)
        if (const std::string group = known.group(); !groups.ends_with(group)) groups += (groups.empty() ? "" : ", ") + group;
    throw OptionError(
        "only", fmt::format("{}: no case has such a name; there are the groups {}, and --list shows all names", only, groups));
}

}  // namespace

known::Cases stress_cases() {
    known::Cases cases = known::all_cases();
    for (Case& known : stress_file_cases()) cases.push_back(std::move(known));
    return cases;
}

int stress_command(const StressRequest& request) {
    const ThreadLimit threads(request.threads);
    const known::Cases all = stress_cases();
    const std::vector<const Case*> cases = chosen(all, request.only);
    if (request.list) {
        for (const Case* known : cases) fmt::print("{:<52} {}\n", known->name, known->source);
        return 0;
    }
    catch_interrupts();
    const Stopwatch watch;
    if (!request.json)
        fmt::print("  {:<{}} {:>{}} {:>{}} {:>{}} {:>{}}  verdict\n", "case, quantity", quantity_width, "expected", value_width,
                   "measured", value_width, "error", number_width, "tolerance", number_width);
    std::vector<CaseOutcome> outcomes;
    const CaseLine line;
    for (const Case* known : cases) {
        if (interrupted()) break;
        line.show(outcomes.size(), cases.size(), known->name);
        const Stopwatch of_case;
        std::vector<Figure> figures = known::run(*known, request.seed);
        outcomes.push_back({known, std::move(figures), of_case.seconds()});
        line.clear();
        if (!request.json) print_case(outcomes.back());
    }
    if (request.json) {
        Json j = {{"version", NEUMANN_VERSION}, {"seed", request.seed}, {"cases", Json::array()}};
        for (const CaseOutcome& outcome : outcomes) j["cases"].push_back(as_json(outcome));
        j["failed_figures"] = failures(outcomes);
        j["cases_not_reached"] = cases.size() - outcomes.size();
        j["seconds"] = watch.seconds();
        fmt::print("{}\n", json_text(j, 2));
    } else {
        print_summary(outcomes, cases.size(), watch.seconds());
    }
    return failures(outcomes) > 0 || outcomes.size() < cases.size() ? 1 : 0;
}

}  // namespace neumann
