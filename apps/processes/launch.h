// The processes of this program that were started together: the first one does what the command line says, and the others help it.
#pragma once

#include "apps/processes/scene_on_disk.h"
#include "core/base/processes/processes.h"
#include "operators/render/methods/crew.h"

#include <memory>

namespace neumann {

// One for the whole program, in main().
class Launch {
public:
    // Throws RunError if several were started and this program cannot talk to them.
    Launch();
    // Of the first process: ends the others.
    ~Launch();

    // Whether this is one of the others, for which help() is all that there is to do. It returns the exit code.
    bool is_helper() const { return processes_ && processes_->rank() > 0; }
    int help();

private:
    std::unique_ptr<Processes> processes_;
};

// The processes of this launch; null if this one was started alone.
Processes* launched();

// The threads that this process is to use if the user asks for `threads` of them (0: all): those of the machine are shared with the
// other processes on it.
int threads_of_process(int threads);

// Those that render a scene together with this process, each with so many threads; null if it was started alone.
std::unique_ptr<Crew> launched_crew(const SceneFile& file, const Scene& scene, int threads);

}  // namespace neumann
