// The options of `neumann replay`.
#include "apps/command_line/commands.h"
#include "apps/command_line/options.h"
#include "apps/commands/replay_command.h"

namespace neumann {

CLI::App* add_replay(CLI::App& app, ReplayRequest& request) {
    auto* replay = app.add_subcommand("replay", "Trace one sample of a render again, and show its path");
    replay->add_option("DIR", request.folder, "Folder of a render")->required();
    auto* number = replay->add_option("N", request.number, "Number of a sample in the health report in run.json, counted from 1")
                       ->check(whole_from(1, 1'000'000));
    auto* pixel = replay->add_option("--pixel", request.pixel, "For any other sample: its pixel")
                      ->type_name("X,Y")
                      ->delimiter(',')
                      ->expected(2)
                      ->excludes(number);
    auto* sample = replay->add_option("--sample", request.sample, "Number of the sample in its pixel, counted from 0")
                       ->type_name("S")
                       ->check(whole_from(0, std::uint64_t{1} << 40));
    sample->needs(pixel);
    pixel->needs(sample);
    replay->add_flag("--json", request.json, "Print JSON");
    return replay;
}

}  // namespace neumann
