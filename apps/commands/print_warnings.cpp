#include "apps/commands/print_warnings.h"

#include <fmt/format.h>

#include <cstdio>

namespace neumann {

std::vector<std::string> texts(const Warnings& warnings) {
    std::vector<std::string> result;
    for (const auto& [text, count] : warnings.counts())
        result.push_back(text + (count > 1 ? fmt::format(" ({} times)", count) : ""));
    return result;
}

void print_warnings(const std::vector<std::string>& warnings, bool quiet) {
    for (const std::string& text : warnings) {
        if (!quiet) fmt::print(stderr, "warning: {}\n", text);
    }
}

}  // namespace neumann
