// Options that several commands share. The validators have no description, because CLI11 would print it in the help.
#pragma once

#include "operators/render/methods/goal.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace neumann {

struct PatchOptions;

CLI::Validator above_zero();
CLI::Validator whole_from(std::uint64_t low, std::uint64_t high);

// SCENE, --seed N and -t THREADS.
void add_scene(CLI::App& command, std::string& scene);
void add_seed(CLI::App& command, std::uint64_t& seed, const std::string& meaning = "Seed of the random numbers");
void add_threads(CLI::App& command, int& threads);
// `what` is written to disk.
CLI::Option* add_checkpoint(CLI::App& command, std::optional<double>& seconds, const std::string& what);

// --memory, in GiB; by default half of the memory.
void add_memory(CLI::App& command, std::optional<double>& gibibytes);
// "3/16": K from 1 to N.
CLI::Validator whole_part();
PartOfSamples part_of(const std::string& text);
// --files: what is written beside run.json; --theme: what sheets and strips are on.
void add_files(CLI::App& command, std::vector<std::string>& files, std::string& theme);
// --paths X,Y and named, repeatable.
void add_paths(CLI::App& command, std::vector<std::string>& paths);
// -D name=value, repeatable.
void add_definitions(CLI::App& command, std::vector<std::string>& texts);
// --petsc, with or without a value.
void add_petsc(CLI::App& command, std::optional<std::string>& options, const std::string& meaning);
// --lenient.
void add_lenient(CLI::App& command, bool& lenient);

// The command line with "--petsc" and a value that looks like an option, "-ksp_type gmres", as one argument, and "--live" as
// "--live=0" where what follows is no port.
std::vector<std::string> joined_arguments(int argc, char** argv);

// SCENE and the options of all commands that treat it as matrices.
void add_patch_options(CLI::App& command, PatchOptions& options);

}  // namespace neumann
