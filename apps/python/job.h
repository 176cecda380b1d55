// Work in a thread of its own, while Python waits, shows progress and handles Ctrl-C.
//
// The thread takes the interpreter's lock only to call a function that the work was given. Only one job runs at a time, because
// each uses all processors; others wait.
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
    // Makes the Python object of the result. It must not hold Python objects before it is called.
    using Finish = std::function<pybind11::object()>;
    using Work = std::function<Finish(Job&)>;

    // Starts at once, with this many threads; 0: all.
    Job(int threads, Work work);
    // Stops the work and waits for it, without holding the interpreter's lock.
    ~Job();
    Job(const Job&) = delete;
    Job& operator=(const Job&) = delete;

    // Waits at most this many seconds; returns whether the work is done.
    bool wait(double seconds);
    // Requests an orderly end, like Ctrl-C in the command.
    void stop();

    // Called by the work, on any thread: a description of the present work, and the finished fraction.
    void tell(std::string text, std::optional<double> fraction = std::nullopt);
    struct Status {
        std::string text;
        std::optional<double> fraction;
    };
    Status status() const;

    // Call it when the work is done, with the interpreter's lock. Rethrows the exception of the work.
    pybind11::object result() const;

private:
    void run(int threads, const Work& work);

    mutable std::mutex mutex_;  // protects all members below
    std::condition_variable ended_;
    Status status_;
    bool stopped_ = false, working_ = false, done_ = false;
    Finish finish_;
    std::exception_ptr error_;
    std::thread thread_;
};

}  // namespace neumann
