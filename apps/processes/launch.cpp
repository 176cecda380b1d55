#include "apps/processes/launch.h"

#include "apps/processes/helper.h"
#include "apps/processes/process_crew.h"

#include <oneapi/tbb/info.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <thread>

namespace neumann {

namespace {

Processes* of_this_launch = nullptr;

}  // namespace

Launch::Launch() : processes_(launched_processes()) { of_this_launch = processes_.get(); }

Launch::~Launch() {
    of_this_launch = nullptr;
    if (!processes_ || is_helper()) return;
    for (int other = 1; other < processes_->size(); ++other) processes_->send(other, R"({"do": "end"})");
    // The messages that they are sending must be received first.
    for (int left = processes_->size() - 1; left > 0;) {
        const auto message = processes_->receive();
        if (!message)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        else if (nlohmann::json::parse(message->text).contains("ended"))
            --left;
    }
}

int Launch::help() { return neumann::help(*processes_); }

Processes* launched() { return of_this_launch; }

int threads_of_process(int threads) {
    if (threads > 0 || !launched()) return threads;
    // The launcher may have bound a process to fewer.
    return std::min(oneapi::tbb::info::default_concurrency(),
                    std::max(static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN)) / launched()->on_this_machine(), 1));
}

std::unique_ptr<Crew> launched_crew(const SceneFile& file, const Scene& scene, int threads) {
    if (!launched()) return nullptr;
    SceneFile there = file;
    there.path = std::filesystem::absolute(file.path).string();
    return std::make_unique<ProcessCrew>(*launched(), SceneOnDisk{std::move(there), scene.hash}, threads);
}

}  // namespace neumann
