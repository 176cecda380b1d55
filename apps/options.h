// What the options of several commands share. Validators have no description of their own, which CLI11 would put into the help.
#pragma once

#include <CLI/CLI.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace neumann {

CLI::Validator above_zero();
CLI::Validator whole_from(std::uint64_t low, std::uint64_t high);

// -D name=value, repeatable; parse_definitions throws InputError for what is not of this form.
void add_definitions(CLI::App& command, std::vector<std::string>& texts);
std::map<std::string, std::string> parse_definitions(const std::vector<std::string>& texts);

}  // namespace neumann
