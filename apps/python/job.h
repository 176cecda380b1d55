// Work that goes on in a thread of its own while Python does something else: waits, shows how far it is, answers Ctrl-C.
//
// The thread never takes the interpreter's lock. One job works at a time, for each uses all processors; others wait for it.
#pragma once

#include <pybind11/pybind11.h>

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace neumann {

class Job {
public:
    // Makes the Python object that comes out; holds nothing of Python's before it is called.
    using Finish = std::function<pybind11::object()>;
    using Work = std::function<Finish(Job&)>;

    // Begins at once, on so many threads; 0: all.
    Job(int threads, Work work);
    // Stops it and waits, and lets go of the interpreter's lock meanwhile.
    ~Job();
    Job(const Job&) = delete;
    Job& operator=(const Job&) = delete;

    // Whether it is done, after so many seconds at most.
    bool wait(double seconds);
    // As Ctrl-C does with the command: asks for an orderly end.
    void stop();

    // From the work, on any thread: what is being done, and which part of it is.
    void tell(std::string text, std::optional<double> fraction = std::nullopt);
    struct Progress {
        std::string text;
        std::optional<double> fraction;
    };
    Progress progress() const;

    // Once it is done, with the interpreter's lock. Throws what the work threw.
    pybind11::object result() const;

private:
    void run(int threads, const Work& work);

    mutable std::mutex mutex_;  // of all below
    std::condition_variable ended_;
    Progress progress_;
    bool stopped_ = false, working_ = false, done_ = false;
    Finish finish_;
    std::exception_ptr error_;
    std::thread thread_;
};

}  // namespace neumann
