#include "apps/python/job.h"

#include "core/base/error.h"
#include "core/base/interrupt.h"
#include "core/base/limits.h"

#include <chrono>

namespace neumann {

namespace {

std::mutex one_at_a_time;

}  // namespace

Job::Job(int threads, Work work) : thread_([this, threads, work = std::move(work)] { run(threads, work); }) {}

Job::~Job() {
    stop();
    const pybind11::gil_scoped_release release;
    thread_.join();
}

void Job::run(int threads, const Work& work) {
    Finish finish;
    std::exception_ptr error;
    {
        const std::lock_guard turn(one_at_a_time);
        try {
            {
                const std::lock_guard lock(mutex_);
                if (stopped_) throw RunError("interrupted before it began");
                set_interrupted(false);
                working_ = true;
            }
            const ThreadLimit limit(threads);
            finish = work(*this);
        } catch (...) {
            error = std::current_exception();
        }
        const std::lock_guard lock(mutex_);
        working_ = false;
    }
    const std::lock_guard lock(mutex_);
    finish_ = std::move(finish);
    error_ = error;
    done_ = true;
    ended_.notify_all();
}

bool Job::wait(double seconds) {
    std::unique_lock lock(mutex_);
    return ended_.wait_for(lock, std::chrono::duration<double>(seconds), [this] { return done_; });
}

void Job::stop() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    if (working_) set_interrupted(true);
}

void Job::tell(std::string text, std::optional<double> fraction) {
    const std::lock_guard lock(mutex_);
    status_ = {std::move(text), fraction};
}

Job::Status Job::status() const {
    const std::lock_guard lock(mutex_);
    return status_;
}

pybind11::object Job::result() const {
    if (error_) std::rethrow_exception(error_);
    return finish_();
}

}  // namespace neumann
