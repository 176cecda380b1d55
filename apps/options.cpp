#include "apps/options.h"

#include "core/base/error.h"
#include "core/base/memory.h"

#include <fmt/format.h>
#include <charconv>
#include <cmath>

namespace neumann {

CLI::Validator above_zero() {
    return CLI::Validator(
        [](std::string& text) {
            double value = 0.0;
            const bool good = CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value > 0.0;
            return good ? std::string() : "'" + text + "' is not a number above 0";
        },
        "", "above_zero");
}

CLI::Validator whole_from(std::uint64_t low, std::uint64_t high) {
    return CLI::Validator(
        [=](std::string& text) {
            std::uint64_t value = 0;
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
            const bool good = error == std::errc() && end == text.data() + text.size() && value >= low && value <= high;
            return good ? std::string() : fmt::format("'{}' is not a whole number from {} to {}", text, low, high);
        },
        "", "whole");
}

void add_scene(CLI::App& command, std::string& scene) { command.add_option("SCENE", scene, "Mitsuba 3 scene file")->required(); }

void add_seed(CLI::App& command, std::uint64_t& seed, const std::string& meaning) {
    command.add_option("--seed", seed, meaning)->type_name("N")->check(whole_from(0, ~std::uint64_t{0}))->capture_default_str();
}

void add_threads(CLI::App& command, int& threads) {
    command.add_option("-t", threads, "Threads; all without it")->type_name("THREADS")->check(whole_from(1, 4096));
}

void add_memory(CLI::App& command, std::optional<double>& gibibytes) {
    command.add_option("--memory", gibibytes, "Memory that may be taken, about, in GiB; half of the machine's without it")
        ->type_name("GIB")
        ->check(above_zero());
}

double memory_limit(const std::optional<double>& gibibytes) { return gibibytes ? *gibibytes * 0x1p30 : default_memory(); }

ThreadLimit::ThreadLimit(int threads) {
    if (threads > 0) limit_.emplace(oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
}

void add_definitions(CLI::App& command, std::vector<std::string>& texts) {
    command.add_option("-D", texts, "Define $name in the scene file")->type_name("name=value")->allow_extra_args(false)->take_all();
}

std::map<std::string, std::string> parse_definitions(const std::vector<std::string>& texts) {
    std::map<std::string, std::string> definitions;
    for (const std::string& text : texts) {
        const auto equals = text.find('=');
        if (equals == std::string::npos || equals == 0) throw InputError("-D " + text + ": expected name=value");
        if (!definitions.emplace(text.substr(0, equals), text.substr(equals + 1)).second)
            throw InputError("-D " + text + ": '" + text.substr(0, equals) + "' is given twice");
    }
    return definitions;
}

}  // namespace neumann
