// Work in a process of its own, so that a crash or a hang is an answer and not the end.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace neumann::search {

class Words {
public:
    explicit Words(int file) : file_(file) {}
    // A line for who waits; written at once, so that it is there whatever happens next.
    void say(std::string line);

private:
    int file_;
};

struct Ended {
    std::vector<std::string> lines;  // that were said
    std::string how;                 // "" if the work came to its end; otherwise what stopped it, in words
};

// Ends the work after this many seconds of the processor from now.
void limit_time(unsigned seconds);

// Calls `work` in a child process. The caller must not have started threads.
Ended run_apart(const std::function<void(Words&)>& work);

}  // namespace neumann::search
