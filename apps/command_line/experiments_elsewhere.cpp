#include "apps/command_line/experiments.h"

#include "apps/requests/blame_request.h"
#include "apps/requests/patch_request.h"
#include "apps/requests/requests_of_scenes.h"
#include "apps/requests/study_request.h"
#include "apps/requests/unbounce_request.h"
#include "core/base/error.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>

namespace neumann {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 8> there{"blame", "conform", "export", "solve", "spectrum", "stress", "study", "unbounce"};

[[noreturn]] void is_not_there() {
    throw RunError(
        "the program neumann-experiments, which runs this command, is not there; where neumann was built, ./run COMMAND builds it, "
        "and so does cmake --build build/release");
}

}  // namespace

void go_on_where_experiments_are(char** argv) {
    if (!argv[0] || !argv[1] || std::ranges::find(there, argv[1]) == there.end()) return;
    std::error_code error;
    const fs::path own = fs::read_symlink("/proc/self/exe", error).parent_path();
    for (const char* const place : {"neumann-experiments", NEUMANN_EXPERIMENTS})
        if (const fs::path other = own / place; fs::exists(other, error)) {
            ::execv(other.c_str(), argv);
            throw RunError(fmt::format("{}: {}", other.string(), std::strerror(errno)));
        }
}

int blame_command(const BlameRequest&) { is_not_there(); }
int conform_command(const ConformRequest&) { is_not_there(); }
int export_command(const ExportRequest&) { is_not_there(); }
int solve_command(const SolveRequest&) { is_not_there(); }
int spectrum_command(const SpectrumRequest&) { is_not_there(); }
int stress_command(const StressRequest&) { is_not_there(); }
int study_command(const StudyRequest&) { is_not_there(); }
int unbounce_command(const UnbounceRequest&) { is_not_there(); }

}  // namespace neumann
