// The processes of this program that were started together: the first one executes the command line, the others help it.
#pragma once

#include "apps/processes/scene_on_disk.h"
#include "core/base/processes/processes.h"
#include "operators/render/methods/crew.h"

#include <memory>

namespace neumann {

// There is one object for the whole program, in main().
class Launch {
public:
    // Throws RunError if several processes were started and this program cannot communicate with them.
    Launch();
    // In the first process: ends the others.
    ~Launch();

    // Whether this is one of the other processes, which must only call help(). It returns the exit code.
    bool is_helper() const { return processes_ && processes_->rank() > 0; }
    int help();

private:
    std::unique_ptr<Processes> processes_;
};

// The processes of this launch; null if this one was started alone.
Processes* launched();

// The number of threads of this process if the user asks for `threads` (0: all): those of the machine are shared with
// the other processes on it.
int threads_of_process(int threads);

// The processes that render with this one, each with this number of threads; null if this one was started alone.
std::unique_ptr<Crew> launched_crew(const SceneFile& file, const Scene& scene, int threads);

}  // namespace neumann
