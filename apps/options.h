// What the options of several commands share. Validators have no description of their own, which CLI11 would put into the help.
#pragma once

#include <oneapi/tbb/global_control.h>
#include <CLI/CLI.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace neumann {

CLI::Validator above_zero();
CLI::Validator whole_from(std::uint64_t low, std::uint64_t high);

// SCENE, --seed N and -t THREADS.
void add_scene(CLI::App& command, std::string& scene);
void add_seed(CLI::App& command, std::uint64_t& seed, const std::string& meaning = "Seed of the random numbers");
void add_threads(CLI::App& command, int& threads);

// --memory, in GiB; without it half of what there is.
void add_memory(CLI::App& command, std::optional<double>& gibibytes);
// Bytes that may be taken.
double memory_limit(const std::optional<double>& gibibytes);

// While it lives there are at most so many threads; all with 0.
class ThreadLimit {
public:
    explicit ThreadLimit(int threads);

private:
    std::optional<oneapi::tbb::global_control> limit_;
};

// -D name=value, repeatable; parse_definitions throws InputError for what is not of this form.
void add_definitions(CLI::App& command, std::vector<std::string>& texts);
std::map<std::string, std::string> parse_definitions(const std::vector<std::string>& texts);

}  // namespace neumann
